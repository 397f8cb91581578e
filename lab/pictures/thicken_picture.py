# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of thicker walls: an open box with thin walls, and beside it the same box with walls as thick as a limit.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/thicken_picture.py -- \\
        dist/medial_axis-VERSION.zip docs/pictures/thicken.png
"""

import sys
from pathlib import Path

import bpy
from mathutils import Matrix

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

LIMIT = 0.12
WALL = 0.04


def main():
    archive, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    before = open_box()
    after = before.copy()
    after.data = before.data.copy()
    bpy.context.collection.objects.link(after)
    for thing, act in (
        (before, bpy.ops.object.medial_axis_thickness),
        (after, bpy.ops.object.medial_axis_thicken),
    ):
        bpy.context.view_layer.objects.active = thing
        bpy.ops.object.select_all(action="DESELECT")
        thing.select_set(True)
        act(limit=LIMIT)
    after.location.x = 2.8
    for thing in (before, after):
        paint(thing)
    render(before, after, picture)


def open_box():
    bpy.ops.mesh.primitive_cube_add()
    box = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=11)
    bpy.ops.object.mode_set(mode="OBJECT")
    box.data.transform(Matrix.Diagonal((1.0, 0.7, 0.5, 1.0)))
    top = [face.index for face in box.data.polygons if face.normal.z > 0.5]
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for index in top:
        box.data.polygons[index].select = True
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    solid = box.modifiers.new("Solidify", "SOLIDIFY")
    solid.thickness, solid.use_even_offset = WALL, True
    bpy.ops.object.modifier_apply(modifier=solid.name)
    return box


def paint(thing):
    """A material of the colours of thickness."""
    carrier = next(
        (child for child in thing.children if "ma_color" in child.data.attributes), thing
    )
    for shown in {thing, carrier}:
        shown.hide_render = shown is not carrier
    material = bpy.data.materials.new("Thickness")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    colour = nodes.new("ShaderNodeAttribute")
    colour.attribute_name = "ma_color"
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(colour.outputs["Color"], surface.inputs["Base Color"])
    carrier.data.materials.clear()
    carrier.data.materials.append(material)


def render(before, after, picture):
    bpy.context.view_layer.update()
    blender_scene.PIXELS = (900, 420)
    blender_scene.show_whole(before, after)
    blender_scene.render(picture)


main()
