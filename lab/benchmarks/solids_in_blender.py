# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: the solids that its Solidify modifier makes of a sheet, for `solidify_table.py`.

    blender --background --factory-startup --python-exit-code 1 \
        --python lab/benchmarks/solids_in_blender.py -- SHEET.npz ANSWER.npz

The sheet has `points`, `triangles` and `wall`. The answer has vertices and triangles of each solid.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from offsets_in_blender import made, shown


def main() -> None:
    sheet, answer = sys.argv[sys.argv.index("--") + 1 :]
    given, found = np.load(sheet), {}
    for name in ("simple", "complex"):
        found[f"{name}_points"], found[f"{name}_triangles"] = solidified(given, name)
    np.savez(answer, **found)


def solidified(given, mode: str) -> tuple[np.ndarray, np.ndarray]:
    thing = made(given["points"], given["triangles"])
    modifier = thing.modifiers.new("Solidify", "SOLIDIFY")
    modifier.thickness, modifier.offset = float(given["wall"]), 0.0
    if mode == "simple":
        modifier.use_even_offset = modifier.use_quality_normals = True
    else:
        modifier.solidify_mode = "NON_MANIFOLD"
        modifier.nonmanifold_thickness_mode = "CONSTRAINTS"
    return shown(thing)


main()
