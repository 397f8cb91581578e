# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of a rig: the bones in a body, and the body in a pose with weights of the axis and with Blender's.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/rig_picture.py -- \\
        dist/medial_axis-VERSION.zip human_woman.obj docs/pictures/rig.png

Workbench draws it, which needs a display, as that of `xvfb-run`; ImageMagick's `montage` puts the panes side by side.
"""

import math
import subprocess
import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo

PIXELS = (420, 520)
# Bones, turned about an axis of the world by an angle in degrees: a raised thigh, a bent knee, a lowered arm.
POSE = {
    "leg.01.L": ((1, 0, 0), -70),
    "leg.02.L": ((1, 0, 0), 60),
    "arm.01.L": ((0, 1, 0), 45),
}


def main():
    archive, body, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    set_scene()
    panes = []
    for bind in ("AXIS", "AUTOMATIC"):
        source, armature = rigged(body, bind)
        if not panes:
            panes.append(
                render(Path(picture).with_suffix(".bones.png"), bones_of(armature), source)
            )
        pose(armature)
        panes.append(render(Path(picture).with_suffix(f".{bind}.png"), None, source))
    subprocess.run(["montage", *panes, "-tile", "3x1", "-geometry", "+0+0", picture], check=True)
    for pane in panes:
        pane.unlink()


def set_scene():
    scene = bpy.context.scene
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.render.resolution_x, scene.render.resolution_y = PIXELS
    scene.display.shading.color_type = "OBJECT"
    scene.display.shading.show_cavity = True
    scene.world = bpy.data.worlds.new("White")
    scene.world.color = (1.0, 1.0, 1.0)
    scene.view_settings.view_transform = "Standard"
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 0.76
    towards = Vector((0.45, -1.0, 0.1)).normalized()
    scene.camera.location = 3 * towards
    scene.camera.rotation_euler = towards.to_track_quat("Z", "Y").to_euler()


def rigged(body, bind):
    """The body with a diagonal of 1, upright, and its armature."""
    for thing in [thing for thing in bpy.data.objects if thing.type != "CAMERA"]:
        bpy.data.objects.remove(thing)
    bpy.ops.import_scene.obj(filepath=body)
    (source,) = bpy.context.selected_objects
    source.data.transform(source.matrix_world)
    source.matrix_world = Matrix.Identity(4)
    places = [vertex.co for vertex in source.data.vertices]
    low, high = (Vector(map(end, zip(*places, strict=True))) for end in (min, max))
    to_middle = Matrix.Translation(-(low + high) / 2)
    source.data.transform(Matrix.Scale(1 / (high - low).length, 4) @ to_middle)
    source.data.polygons.foreach_set("use_smooth", [True] * len(source.data.polygons))
    bpy.context.view_layer.objects.active = source
    bpy.ops.object.medial_axis_armature(bind=bind, sampling="SURFACE")
    (armature,) = (thing for thing in bpy.data.objects if thing.type == "ARMATURE")
    return source, armature


def pose(armature):
    for name, (axis, angle) in POSE.items():
        bpy.context.view_layer.update()
        bone = armature.pose.bones[name]
        head = Matrix.Translation(armature.matrix_world @ bone.head)
        turn = head @ Matrix.Rotation(math.radians(angle), 4, axis) @ head.inverted()
        bone.matrix = armature.matrix_world.inverted() @ turn @ armature.matrix_world @ bone.matrix
    bpy.context.view_layer.update()


def bones_of(armature):
    """An object that shows the bones as octahedra."""
    corners, faces = [], []
    for bone in armature.data.bones:
        place = armature.matrix_world @ bone.matrix_local
        first, length = len(corners), bone.length
        ring = [
            (x * length, 0.12 * length, z * length)
            for x, z in ((0.1, 0.1), (0.1, -0.1), (-0.1, -0.1), (-0.1, 0.1))
        ]
        corners += [place @ Vector(corner) for corner in ((0, 0, 0), *ring, (0, length, 0))]
        for a, b in ((1, 2), (2, 3), (3, 4), (4, 1)):
            faces += [(first, first + a, first + b), (first + 5, first + b, first + a)]
    mesh = bpy.data.meshes.new("Bones")
    mesh.from_pydata(corners, [], faces)
    shown = bpy.data.objects.new("Bones", mesh)
    bpy.context.scene.collection.objects.link(shown)
    shown.color = (0.85, 0.3, 0.05, 1.0)
    return shown


def render(path, bones, source):
    """A pane: the bones in a translucent body, or the body alone."""
    scene = bpy.context.scene
    scene.display.shading.show_xray_wireframe = False
    scene.display.shading.show_xray = bones is not None
    scene.display.shading.xray_alpha = 0.6
    source.color = (0.7, 0.73, 0.78, 1.0)
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    if bones is not None:
        bpy.data.objects.remove(bones)
    return path


main()
