# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of Fill: the skeleton of a vessel with a wall, without Fill and with it.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/fill_picture.py -- \\
        dist/medial_axis-VERSION.zip aneurysm.stl docs/pictures/fill.png

The open vessel is `aneurysm_data.stl.gz` of Debian's package gmsh-doc, unpacked. Solidify gives it a wall outward.
"""

import sys
from pathlib import Path

import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

WALL = 0.8
OFF, INSIDE = 0.7, 0.25  # the radii of the lines, as shares of those of their balls
APART = 1.25  # widths of a vessel


def main():
    archive, vessel, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.import_mesh.stl(filepath=vessel)
    open_vessel = bpy.context.object
    bpy.ops.object.medial_axis_solidify(thickness=WALL, offset=1.0)
    walled = bpy.context.object
    bpy.data.objects.remove(open_vessel)
    walled.data.polygons.foreach_set("use_smooth", [True] * len(walled.data.polygons))
    walled.data.materials.append(blender_scene.glass())
    walled.visible_shadow = walled.visible_diffuse = walled.visible_glossy = False
    shown = []
    for place, (fill, thick, colour) in enumerate(
        (("OFF", OFF, (0.75, 0.05, 0.03, 1.0)), ("INSIDE", INSIDE, (0.95, 0.35, 0.02, 1.0)))
    ):
        shown += beside(walled, line_of(walled, fill, thick, colour), place)
    bpy.data.objects.remove(walled)
    render(shown, picture)


def line_of(walled, fill, thick, colour):
    """The skeleton as a coloured tube, on a copy: the next result replaces the object."""
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = walled
    walled.select_set(True)
    bpy.ops.object.medial_axis_skeleton(fill=fill)
    found = bpy.context.object
    print(fill, found.get("ma_warnings"))
    line = bpy.data.objects.new(fill, found.data.copy())
    line.matrix_world = found.matrix_world
    bpy.context.collection.objects.link(line)
    found.hide_render = True
    line.data.bevel_depth, line.data.use_fill_caps = thick, True
    line.data.materials.clear()
    line.data.materials.append(blender_scene.painted(fill, colour))
    return line


def beside(walled, line, place):
    """A copy of the vessel and its line, in the next place to the right."""
    shell = walled.copy()
    bpy.context.collection.objects.link(shell)
    for thing in (shell, line):
        thing.location.x += place * APART * walled.dimensions.x
    return [shell, line]


def render(things, picture):
    bpy.context.view_layer.update()
    blender_scene.PIXELS, blender_scene.SAMPLES = (900, 430), 96
    blender_scene.VIEW = Vector((0.1, -1.0, 0.15))
    blender_scene.show_whole(*(thing for thing in things if thing.type == "MESH"))
    blender_scene.render(picture)


main()
