# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: the solids that its Solidify modifier makes of a sheet, for `solidify_table.py`.

    blender --background --factory-startup --python-exit-code 1 \
        --python lab/benchmarks/solids_in_blender.py -- SHEET.npz ANSWER.npz

The sheet has `points`, `triangles` and `wall`. The answer has vertices and triangles of each solid.
"""

import sys

import bpy
import numpy as np


def main() -> None:
    sheet, answer = sys.argv[sys.argv.index("--") + 1 :]
    given, found = np.load(sheet), {}
    for name in ("simple", "complex"):
        found[f"{name}_points"], found[f"{name}_triangles"] = solidified(given, name)
    np.savez(answer, **found)


def solidified(given, mode: str) -> tuple[np.ndarray, np.ndarray]:
    mesh = bpy.data.meshes.new("Sheet")
    mesh.from_pydata(given["points"].tolist(), [], given["triangles"].tolist())
    thing = bpy.data.objects.new("Sheet", mesh)
    bpy.context.collection.objects.link(thing)
    modifier = thing.modifiers.new("Solidify", "SOLIDIFY")
    modifier.thickness, modifier.offset = float(given["wall"]), 0.0
    if mode == "simple":
        modifier.use_even_offset = modifier.use_quality_normals = True
    else:
        modifier.solidify_mode = "NON_MANIFOLD"
        modifier.nonmanifold_thickness_mode = "CONSTRAINTS"
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    made = evaluated.to_mesh()
    made.calc_loop_triangles()
    points = np.array([vertex.co[:] for vertex in made.vertices], float).reshape(-1, 3)
    triangles = np.array([t.vertices[:] for t in made.loop_triangles], np.int32).reshape(-1, 3)
    return points, triangles


main()
