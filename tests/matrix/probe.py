# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside any Blender with the installed add-on: one mesh by the operator, the export and the command line,
its picture, and what ran it.

Arguments: the file that the answer is written to, as JSON, and the render engines to try, whose pictures are
written beside it.
"""

import importlib
import json
import os
import platform
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

from egg import command_line, digest, egg

ANSWER, *ENGINES = sys.argv[sys.argv.index("--") + 1 :]
# The names of the engines; EEVEE has changed its name twice.
NAMES = {
    "Cycles": ("CYCLES",),
    "EEVEE": ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT"),
    "Workbench": ("BLENDER_WORKBENCH",),
}


def source():
    mesh = bpy.data.meshes.new("Egg")
    vertices, faces = egg()
    mesh.from_pydata(vertices, [], faces)
    mesh.update()
    thing = bpy.data.objects.new("Egg", mesh)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    return thing


def exported(folder):
    """SHA-256 of the .ma file."""
    path = folder / "egg.ma"
    assert bpy.ops.object.medial_axis(side="INNER") == {"FINISHED"}
    assert bpy.ops.export_scene.medial_axis(filepath=str(path)) == {"FINISHED"}
    return digest(path)


def set_stage():
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = 160, 120
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    camera = scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0, 0, 4)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy = 3
    for thing in (camera, sun):
        scene.collection.objects.link(thing)


def colours(engine, folder):
    """How many colours the picture has that this engine renders."""
    for name in NAMES[engine]:
        try:
            bpy.context.scene.render.engine = name
            break
        except TypeError:
            continue
    bpy.context.scene.render.filepath = str(folder / f"{engine}.png")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(bpy.context.scene.render.filepath)
    pixels = np.array(image.pixels[:], np.float32).reshape(-1, 4)
    return len(np.unique(pixels, axis=0))


def main():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    module = os.environ["MEDIAL_AXIS_MODULE"]
    bpy.ops.preferences.addon_enable(module=module)
    thing = source()
    with tempfile.TemporaryDirectory() as folder:
        answer = {
            "blender": bpy.app.version_string,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "installed": "extension" if module.startswith("bl_ext.") else "legacy add-on",
            "export": exported(Path(folder)),
            "command": command_line(importlib.import_module(f"{module}.cli").main, Path(folder)),
        }
    thing.hide_render = True
    set_stage()
    answer["colours"] = {engine: colours(engine, Path(ANSWER).parent) for engine in ENGINES}
    Path(ANSWER).write_text(json.dumps(answer), encoding="utf-8")


main()
