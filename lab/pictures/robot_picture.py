# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of a robot: the links of an arm, a capsule round each, and sixteen balls round each.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/robot_picture.py -- \\
        dist/medial_axis-VERSION.zip docs/pictures/robot.png
"""

import sys
from math import cos, pi, sin
from pathlib import Path

import bmesh
import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

# Each link is the convex hull of discs across the plane of the arm: x, z, radius and half of the width.
LINKS = (
    ((-0.45, 0.05, 0.05, 0.4), (0.45, 0.05, 0.05, 0.4), (0.0, 0.66, 0.24, 0.3)),
    ((0.0, 0.66, 0.26, 0.14), (0.75, 2.1, 0.2, 0.12)),
    ((0.75, 2.1, 0.17, 0.24), (1.95, 1.75, 0.12, 0.12)),
    ((1.95, 1.75, 0.1, 0.2), (2.2, 1.5, 0.13, 0.24)),
    ((2.14, 1.48, 0.05, 0.06), (2.22, 0.98, 0.03, 0.05)),
    ((2.36, 1.52, 0.05, 0.06), (2.44, 1.02, 0.03, 0.05)),
)
COVERS = (("CAPSULES", 1), ("BALLS", 16))
SIDES, APART = 48, 3.1


def main():
    archive, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    steel = blender_scene.painted("Steel", (0.85, 0.4, 0.08, 1.0))
    shown = []
    for place in range(1 + len(COVERS)):
        links = [link(ends, place * APART, steel) for ends in LINKS]
        shown += [cover(each, *COVERS[place - 1]) for each in links] if place else links
    render(shown, picture)


def link(ends, place, material):
    corners = bmesh.new()
    for x, z, radius, half in ends:
        for k in range(SIDES):
            turn = 2 * pi * k / SIDES
            for y in (-half, half):
                corners.verts.new((x + place + radius * cos(turn), y, z + radius * sin(turn)))
    hull = bmesh.ops.convex_hull(corners, input=corners.verts)
    bmesh.ops.delete(corners, geom=hull["geom_interior"], context="VERTS")
    mesh = bpy.data.meshes.new("Link")
    corners.to_mesh(mesh)
    corners.free()
    mesh.materials.append(material)
    thing = bpy.data.objects.new("Link", mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def cover(each, shapes, count):
    """The balls or capsules round a link, which they hide: the flat faces that draw them cut its edges."""
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = each
    each.select_set(True)
    bpy.ops.object.medial_axis_balls(mode="AROUND", shapes=shapes, count=count)
    each.hide_render = True
    return bpy.context.object


def render(things, picture):
    bpy.context.view_layer.update()
    blender_scene.PIXELS, blender_scene.SAMPLES = (1000, 380), 48
    blender_scene.VIEW = Vector((0.25, -1.0, 0.2))
    blender_scene.show_whole(*things)
    blender_scene.render(picture)


main()
