# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of solid sheets: a folded and rolled ribbon, by a Solidify modifier and by Solidify.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/solidify_picture.py -- \\
        dist/medial_axis-VERSION.zip docs/pictures/solidify.png
"""

import sys
from math import cos, pi, radians, sin
from pathlib import Path

import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

WALL, STEP, WIDTH = 0.2, 0.05, 0.9
STRAIGHT, FLAP, ANGLE = 0.9, 1.7, 20  # between roll and folds, and of these
GAP, TURNS = 0.17, 2.25  # of the roll
APART = 3.4


def main():
    archive, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    first, source = ribbon("Modifier", 0.0), ribbon("Ribbon", APART)
    modifier = first.modifiers.new("Solidify", "SOLIDIFY")
    modifier.thickness, modifier.offset, modifier.use_even_offset = WALL, 0.0, True
    bpy.context.view_layer.objects.active = source
    source.select_set(True)
    bpy.ops.object.medial_axis_solidify(thickness=WALL)
    made = bpy.context.object
    print(made["ma_solid_least"], made["ma_warnings"])
    bpy.data.objects.remove(source)
    for thing, colour in ((first, (0.85, 0.4, 0.08, 1.0)), (made, (0.1, 0.32, 0.62, 1.0))):
        thing.data.materials.clear()
        thing.data.materials.append(blender_scene.painted(thing.name, colour))
    render([first, made], picture)


def profile():
    """Places (x, z) along a roll that goes on as folds."""
    inner, grow = GAP, GAP / (2 * pi)
    count = round(TURNS * 2 * pi * (inner + GAP * TURNS / 2) / STEP)
    turns = [2 * pi * TURNS * k / count for k in range(count + 1)]
    end = 2 * pi * TURNS
    found = [
        ((inner + grow * t) * cos(t - end - pi / 2), (inner + grow * t) * sin(t - end - pi / 2))
        for t in turns
    ]
    half = radians(ANGLE / 2)
    place, steps = Vector(found[-1]), round(FLAP / STEP)
    for _ in range(round(STRAIGHT / STEP)):
        place = place + STEP * Vector((1.0, 0.0))
        found.append(tuple(place))
    for up in (1, -1, 1, -1):
        for _ in range(steps):
            place = place + STEP * Vector((sin(half), up * cos(half)))
            found.append(tuple(place))
    return found


def ribbon(name, place):
    line, across = profile(), round(WIDTH / 0.1)
    points = [(x + place, WIDTH * k / across, z) for x, z in line for k in range(across + 1)]
    faces = [
        (a, a + across + 1, a + across + 2, a + 1)
        for row in range(len(line) - 1)
        for a in range(row * (across + 1), row * (across + 1) + across)
    ]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def render(things, picture):
    bpy.context.view_layer.update()
    blender_scene.PIXELS, blender_scene.VIEW = (1000, 440), Vector((0.12, -1.0, 0.2))
    blender_scene.show_whole(*things)
    blender_scene.render(picture)


main()
