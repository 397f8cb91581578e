# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in a Blender of its own: the peak memory of one run of the operator, and its forecast.

    blender ... --python tests/addon/memory_at_peak.py -- MODULE faces|bare SIDE FORM

prints bytes and bytes, both of the whole process above its start.
"""

import importlib
import re
import sys
from pathlib import Path

import bpy
import numpy as np

RINGS, ROUND = 320, 600


def wavy(side):
    """A ball with waves: (n, 3) places, and the corners and sizes of its faces: quads, and a cap at both ends.

    Where the outer side is wanted the waves are short, so that most of the samples have an outer facet.
    """
    up = np.cos(np.linspace(0.02, np.pi - 0.02, RINGS))[:, None]
    angle = np.linspace(0.0, 2 * np.pi, ROUND, endpoint=False)
    flat = np.sqrt(1 - up * up)
    x, y, z = flat * np.cos(angle), flat * np.sin(angle), up + 0 * angle
    waves = 0.25 * np.sin(5 * x) * np.cos(4 * y)
    if side != "INNER":
        waves = 0.3 * np.sin(8 * x + 1) * np.sin(8 * y + 2) * np.sin(8 * z + 3)
    places = ((1 + waves) * (x, y, z)).reshape(3, -1).T
    ring, step = np.divmod(np.arange((RINGS - 1) * ROUND), ROUND)
    here, on = ring * ROUND + step, ring * ROUND + (step + 1) % ROUND
    quads = np.column_stack((here, here + ROUND, on + ROUND, on)).ravel()
    caps = np.arange(ROUND), np.arange(ROUND)[::-1] + (RINGS - 1) * ROUND
    return places, np.concatenate((quads, *caps)), np.append(np.full(len(here), 4), [ROUND, ROUND])


def link(faces, side):
    """The only object, active and selected. Made without lists, whose memory would stay and be used again."""
    bpy.data.batch_remove(list(bpy.data.objects))
    mesh = bpy.data.meshes.new("Wavy")
    places, corners, sizes = wavy(side)
    mesh.vertices.add(len(places))
    mesh.vertices.foreach_set("co", places.astype(np.float32).ravel())
    if faces:
        mesh.loops.add(len(corners))
        mesh.loops.foreach_set("vertex_index", corners.astype(np.int32))
        mesh.polygons.add(len(sizes))
        mesh.polygons.foreach_set("loop_start", (np.cumsum(sizes) - sizes).astype(np.int32))
        if bpy.app.version < (4, 1, 0):
            mesh.polygons.foreach_set("loop_total", sizes.astype(np.int32))
    mesh.update(calc_edges=True)
    thing = bpy.data.objects.new("Wavy", mesh)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    bpy.context.view_layer.update()
    return len(places)


def resident(name):
    """Bytes: VmRSS now, VmHWM at the most since it was last cleared."""
    status = Path("/proc/self/status").read_text()
    return 1024 * int(re.search(rf"{name}:\s+(\d+)", status)[1])


def main():
    module, faces, side, form = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.preferences.addon_enable(module=module)
    importlib.import_module(f"{module}.core.machine.native").load()
    memory = importlib.import_module(f"{module}.core.machine.memory_limit")
    settings = importlib.import_module(f"{module}.core.settings")
    points = link(faces == "faces", side)
    Path("/proc/self/clear_refs").write_text("5")
    before = resident("VmRSS")
    bpy.ops.object.medial_axis("EXEC_DEFAULT", sampling="VERTICES", side=side, form=form)
    peak = resident("VmHWM") - before
    use = memory.Use(
        faces=faces == "faces",
        side=settings.Side[side],
        levels=form != "PUBLISHED",
        output=memory.CURVE if form == "CURVE" else memory.OBJECT,
        triangles=2 * points - 4 if faces == "faces" and form != "PUBLISHED" else 0,
    )
    print("PEAK", peak, memory.memory_needed(points, use))


main()
