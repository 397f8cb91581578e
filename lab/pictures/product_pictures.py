# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of four products: few balls, thickness, skeletons and rebuilt solids.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/product_pictures.py -- \\
        dist/medial_axis-VERSION.zip FOLDER_OF_MESHES docs/pictures [balls|thickness|skeleton|rebuild ...]

ImageMagick's `montage` puts the panes of a picture side by side.
"""

import importlib
import subprocess
import sys
from pathlib import Path

import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

PANE = (420, 460)
CLAY, SAND = (0.55, 0.53, 0.5, 1.0), (0.72, 0.45, 0.2, 1.0)
HAND, WOMAN = "hand_closed.obj", "human_woman.obj"
FRONT, SIDE = Vector((0.3, -1.0, 0.25)), Vector((0.9, -0.75, 0.25))


class Panes:
    """Renders one pane after the other."""

    def __init__(self, meshes, picture):
        self.meshes, self.picture, self.files = meshes, picture, []

    def body(self, name, y_up=False):
        """The only object of the scene, active."""
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        mesh = name if name == "bracket" else str(self.meshes / name)
        source = blender_demo.load(mesh, 0, y_up)
        bpy.context.view_layer.objects.active = source
        source.select_set(True)
        return source

    def add(self, shown, view=FRONT, inside=None):
        """A pane of an object as large as it is, or as the one that it is inside."""
        for thing in bpy.data.objects:
            thing.hide_render = thing is not shown
        blender_scene.PIXELS, blender_scene.VIEW = PANE, view
        blender_scene.show_whole(inside or shown)
        self.render()

    def render(self):
        file = self.picture.with_suffix(f".{len(self.files)}.png")
        blender_scene.render(file)
        self.files.append(file)

    def join(self):
        subprocess.run(
            ["montage", *self.files, "-geometry", "+0+0", "-tile", "x1", self.picture],
            check=True,
        )
        for file in self.files:
            file.unlink()


def paint(thing, colour):
    """A material of one colour, or of the attribute of this name."""
    material = bpy.data.materials.new("Shown")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    if isinstance(colour, str):
        attribute = nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = colour
        material.node_tree.links.new(attribute.outputs["Color"], surface.inputs["Base Color"])
    else:
        surface.inputs["Base Color"].default_value = colour
    thing.data.materials.clear()
    thing.data.materials.append(material)
    return thing


def balls(panes):
    panes.add(paint(panes.body(HAND), CLAY))
    for count, mode in ((16, "INSIDE"), (64, "INSIDE"), (256, "INSIDE"), (64, "AROUND")):
        panes.body(HAND)
        bpy.ops.object.medial_axis_balls(count=count, mode=mode)
        panes.add(bpy.context.object)


def thickness(panes):
    for name, y_up, view in (
        (HAND, False, FRONT),
        ("rocker-arm.off", False, SIDE),
        ("club.off", True, SIDE),
        ("bracket", False, FRONT),
    ):
        source = panes.body(name, y_up)
        bpy.context.scene.medial_axis_thickness.limit = 0.05 * max(source.dimensions)
        bpy.ops.object.medial_axis_thickness()
        carrier = next(
            o for o in bpy.data.objects if o.type == "MESH" and "ma_color" in o.data.attributes
        )
        panes.add(paint(carrier, "ma_color"), view)


def skeleton(panes):
    for name in (HAND, WOMAN):
        source = panes.body(name)
        bpy.ops.object.medial_axis_skeleton()
        bpy.context.object.data.bevel_depth = 0.2
        blender_scene.PIXELS, blender_scene.VIEW = PANE, FRONT
        blender_scene.arrange(source, paint(bpy.context.object, SAND))
        panes.render()


def rebuild(panes):
    rebuilt_object = importlib.import_module("medial_axis.bridge.rebuilt_object")
    inputs = importlib.import_module("medial_axis.bridge.nodes.inputs")
    size = max(panes.body(HAND).dimensions)
    for values in ({}, {"Factor": 0.6}, {"Offset": 0.02 * size}, {"Min Radius": 0.07 * size}):
        source = panes.body(HAND)
        bpy.ops.object.medial_axis()
        bpy.ops.object.medial_axis_rebuild()
        made = next(o for o in bpy.data.objects if rebuilt_object.modifier_of(o))
        inputs.set_inputs(rebuilt_object.modifier_of(made), values)
        panes.add(made, inside=source)


def main():
    archive, meshes, pictures, *wanted = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    for make in (balls, thickness, skeleton, rebuild):
        if wanted and make.__name__ not in wanted:
            continue
        panes = Panes(Path(meshes), Path(pictures) / f"{make.__name__}.png")
        make(panes)
        panes.join()


main()
