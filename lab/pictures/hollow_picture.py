# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of hollow solids: a body cut in half, by a Solidify modifier and by Hollow with a drain hole.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/hollow_picture.py -- \\
        dist/medial_axis-VERSION.zip spot_low.obj docs/pictures/hollow_solid.png
"""

import sys
from pathlib import Path

import bmesh
import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

WALL, DRAIN = 0.08, 0.1
APART = 2.0


def main():
    archive, body, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.wm.obj_import(filepath=body)
    source = bpy.context.object
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    bpy.ops.object.medial_axis_hollow(wall=WALL, drain=DRAIN)
    made = bpy.context.object
    print(made["ma_hollow_least"], len(made.data.polygons), made["ma_warnings"])
    modifier = source.modifiers.new("Solidify", "SOLIDIFY")
    modifier.thickness, modifier.use_even_offset = WALL, True
    halves = [half(thing, place) for thing, place in ((source, 0.0), (made, APART))]
    for thing in list(bpy.data.objects):
        if thing not in halves:
            bpy.data.objects.remove(thing)
    render(halves, picture)


def half(thing, place):
    """The part of what is shown of an object that lies at x < 0, with its section filled."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    cut = bmesh.new()
    cut.from_object(thing, depsgraph)
    cut.transform(thing.matrix_world)
    everything = cut.verts[:] + cut.edges[:] + cut.faces[:]
    found = bmesh.ops.bisect_plane(
        cut, geom=everything, plane_co=(1e-4, 0, 0), plane_no=(1, 0, 0), clear_outer=True
    )
    edges = [each for each in found["geom_cut"] if isinstance(each, bmesh.types.BMEdge)]
    filled = bmesh.ops.triangle_fill(cut, edges=edges, use_beauty=True)
    for face in cut.faces:
        face.material_index = 0
    for each in filled["geom"]:
        if isinstance(each, bmesh.types.BMFace):
            each.material_index = 1
    mesh = bpy.data.meshes.new("Half")
    cut.transform(Matrix.Translation((0, place, 0)))
    cut.to_mesh(mesh)
    cut.free()
    for name, colour in (("Wall", (0.35, 0.5, 0.7, 1.0)), ("Section", (0.9, 0.4, 0.05, 1.0))):
        mesh.materials.append(blender_scene.painted(name, colour))
    made = bpy.data.objects.new("Half", mesh)
    bpy.context.collection.objects.link(made)
    return made


def render(halves, picture):
    bpy.context.view_layer.update()
    blender_scene.PIXELS, blender_scene.VIEW = (900, 420), Vector((1.0, -0.2, 0.25))
    blender_scene.show_whole(*halves)
    blender_scene.render(picture)


main()
