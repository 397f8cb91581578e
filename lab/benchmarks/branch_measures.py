# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the measures of branches, on solids with known ones: the table of docs/lab/quality_skeleton.md.

python3 lab/benchmarks/branch_measures.py
"""

import sys
import time
from pathlib import Path

import numpy as np

sys.path[:0] = [
    str(Path(__file__).resolve().parents[2]),
    str(Path(__file__).resolve().parents[2] / "tests"),
]
from medial_axis.core.settings import Settings, SkeletonSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.skeleton.branches import measure_branches  # noqa: E402
from medial_axis.core.skeleton.compute import compute_skeleton  # noqa: E402
from support import meshes, swept  # noqa: E402
from support.package import *  # noqa: E402, F403 - the package of the checkout

A, B, PITCH = 0.3, 0.2, 0.4
H = ((A - B) / (A + B)) ** 2
AROUND = np.pi * (A + B) * (1 + 3 * H / (10 + np.sqrt(4 - 3 * H)))  # Ramanujan


def circle(radius, sides=32):
    """The area and the perimeter of the polygon in it."""
    return sides / 2 * radius**2 * np.sin(2 * np.pi / sides), 2 * sides * radius * np.sin(
        np.pi / sides
    )


# A mesh, and its curvature, torsion, area and perimeter.
SOLIDS = {
    "capsule": (swept.capsule(2.0, 0.2), 0.0, np.nan, *circle(0.2)),
    "torus, 0.3": (meshes.torus(1.0, 0.3, 96, 32), 1.0, 0.0, *circle(0.3)),
    "torus, 0.6": (meshes.torus(1.0, 0.6, 96, 32), 1.0, 0.0, *circle(0.6)),
    "helix": (
        swept.helix(0.2, PITCH),
        1 / (1 + PITCH**2),
        PITCH / (1 + PITCH**2),
        *circle(0.2),
    ),
    "elliptic tube": (swept.elliptic(A, B, 64), 0.0, np.nan, np.pi * A * B, AROUND),
}


def row_of(name, mesh, *expected):
    found = compute_skeleton(Shape(*mesh), Settings(), SkeletonSettings(mirror=False))
    start = time.process_time()
    table = measure_branches(found)
    seconds = time.process_time() - start
    longest = int(np.argmax(table.length))
    columns = "curvature_mean", "curvature_largest", "torsion_mean", "area_mean", "perimeter_mean"
    radius = table.radius_mean[longest]
    cells = []
    for column, true in zip(columns, (expected[0], *expected), strict=True):
        value = getattr(table, column)[longest]
        if true:
            cells.append("-" if np.isnan(true) else f"{100 * (value / true - 1):+.2f} %")
        else:
            cells.append(f"{value * radius:.1e} / radius")
    print(f"| {name} | {' | '.join(cells)} | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    print("| solid | curvature, mean | largest | torsion | area | perimeter | s |")
    print("|---|---|---|---|---|---|---|")
    for name, (mesh, *expected) in SOLIDS.items():
        row_of(name, mesh, *expected)
