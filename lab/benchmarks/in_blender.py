# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: one run of Compute Medial Axis from object to object, and what sliders cost then.

    MEDIAL_AXIS_MODULE=medial_axis blender --background --factory-startup --python-exit-code 1 \
        --python lab/benchmarks/in_blender.py -- FOLDER ANSWER [click]

The folder holds the input, as `measuring.Input.write` leaves it; the answer is a JSON file. With `click` no slider
moves. In a window the time until the new axis is drawn is measured, too, and that of drawing the same once more.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import time
import traceback
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from measuring import Input, Memory, median

MODULE = os.environ["MEDIAL_AXIS_MODULE"]
CHANGES = 8  # of Trim Rims; the first is not counted
# Far apart, as near ones often select the same; the first is not counted.
RHO = (9.0, 20.0, 10.0, 30.0)


def main() -> None:
    folder, answer, *only = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.preferences.addon_enable(module=MODULE)
    add_object(Input.read(Path(folder)))
    found = run()
    if not only:
        add_changes(found)
    Path(answer).write_text(json.dumps(found))


def add_changes(found: dict) -> None:
    """Add what another value of a slider costs."""
    changes = [change("erode", 0.05 * number) for number in range(1, CHANGES + 1)][1:]
    for kind, values in median(changes).items():
        found[kind] |= values
    change("erode", 0.0)  # trimmed rims hide what Rho changes
    others = [change("rho", rho) for rho in RHO][1:]
    found["seconds"]["rho"] = median(others)["seconds"]["change"]


def add_object(work: Input) -> None:
    """The only object of the scene, active and selected."""
    bpy.data.batch_remove(list(bpy.data.objects))
    mesh = bpy.data.meshes.new("Bench")
    mesh.vertices.add(len(work.points))
    mesh.vertices.foreach_set("co", work.points.astype(np.float32).ravel())
    if len(work.triangles):
        corners = work.triangles.astype(np.uint32).ravel()
        mesh.loops.add(len(corners))
        mesh.polygons.add(len(work.triangles))
        mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, np.uint32))
        if bpy.app.version < (4, 1, 0):
            mesh.polygons.foreach_set("loop_total", np.full(len(work.triangles), 3, np.uint32))
        mesh.loops.foreach_set("vertex_index", corners)
    mesh.update(calc_edges=True)
    thing = bpy.data.objects.new("Bench", mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    bpy.context.view_layer.update()
    show()


def run() -> dict:
    """The operator, as a click runs it but for the thread that it does not start here."""
    memory, start, cpu = Memory(), time.perf_counter(), time.process_time()
    bpy.ops.object.medial_axis("EXEC_DEFAULT", True)
    bpy.context.view_layer.update()
    seconds, cpu = {"run": time.perf_counter() - start}, {"run": time.process_time() - cpu}
    show()
    result = bpy.context.object
    kept = importlib.import_module(f"{MODULE}.core.machine.cache").CACHE.get(result["ma_analysis"])
    seconds["analysis"] = sum(kept.analysis.timings.values())
    facets = len(result.data.polygons)
    return {"seconds": seconds, "cpu": cpu, "bytes": memory.peak, "facets": facets}


def change(slider: str, value: float) -> dict:
    """Another value of a slider of the panel, until the mesh is evaluated; until it is drawn; and drawing alone.
    Theta selects the same facets of an ellipsoid, so it is not taken."""
    before = places()
    times, cpu = [time.perf_counter()], time.process_time()
    setattr(bpy.context.scene.medial_axis, slider, value)
    bpy.context.view_layer.update()
    cpu = {"change": time.process_time() - cpu}
    times.append(time.perf_counter())
    for _ in range(2):
        show()
        times.append(time.perf_counter())
    after = places()
    assert len(after) and not np.array_equal(before, after), f"{slider} {value} shows the same"
    start, changed, drawn, again = times
    seconds = {"change": changed - start, "change drawn": drawn - start, "drawing": again - drawn}
    return {"seconds": seconds, "cpu": cpu}


def places() -> np.ndarray:
    """The coordinates of the vertices of what is shown, one after the other. Two thresholds often leave as many
    facets, but hardly at the same places."""
    vertices = bpy.context.object.data.vertices
    found = np.empty(3 * len(vertices), np.float32)
    vertices.foreach_get("co", found)
    return found


def show() -> None:
    if not bpy.app.background:
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)


def in_window() -> None:
    """There is a window only after Blender's start."""
    try:
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            main()
    except BaseException:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


if bpy.app.background:
    main()
else:
    bpy.app.timers.register(in_window, first_interval=0.5)
