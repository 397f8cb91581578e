# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes of triangle meshes of shapes whose axes are known exactly, by way of the add-on: a Markdown table.

    python3 lab/benchmarks/exact_axes.py [--output table.md] [--shapes box ...] [--turns 3] [--worst]

Each mesh (2,000 to 6,000 triangles, a box 12) is sampled as Sampling Surface does, and its axis computed with the
default thresholds; as it lies, and turned at random and rounded to float32 as in Blender. Distances in percent of
the bounding box' diagonal; o->t: from area-weighted points of all facets of the output to the exact axis; t->o: from
points of the exact axis to the output. Outside: vertices of the output outside the mesh. Spike: the longest distance
of a vertex to the exact axis, relative to the radius there, but to the spacing of samples where that is larger.
Bold: a bar is missed. Smooth shapes: o->t mean 0.1, p99 0.5, t->o mean 0.1, none outside; those with sharp edges:
o->t p99 0.5, t->o mean 0.2, none outside.
"""

import sys

import _module
import numpy as np

medial = _module.load()
sys.path.insert(0, str(_module.ROOT / "tests" / "python"))

from support import axis_bars as judge  # noqa: E402  (found through _module)
from support import (  # noqa: E402
    inputs,
    resampled,
    spikes,
)
from support.shape_meshes import MESHED  # noqa: E402

HEADER = ["shape", "turned", "samples", "facets", "o->t mean %", "p99 %", "max %", "t->o mean %"]
HEADER += ["max %", "outside", "pieces", "spike"]
FIELDS = ["samples", "facets", "output_mean", "output_p99", "output_max", "truth_mean", "truth_max"]
FIELDS += ["outside", "components", "spike"]


def row(name: str, turn: int, samples: int, worst: bool) -> list[str]:
    shape, mesh = MESHED[name]
    frame = inputs.rotation(turn) if turn else np.eye(3)
    mesh = resampled.turned(mesh, frame) if turn else mesh
    result = resampled.of_surface(mesh, samples)
    points, axis = result.chosen.samples.points, result.axis
    found = judge.measured(shape, mesh, frame, axis, len(points))
    missed = found.missed(name)
    print(name, turn, found, "missed", missed, file=sys.stderr, flush=True)
    if worst:
        off = judge.off_axis(shape, axis.vertices @ frame, resampled.spacing(shape.area, samples))
        print(spikes.worst(axis, points, result.chosen.samples.kinds, off), file=sys.stderr)
    return [name, "no" if turn == 0 else str(turn), *(cell(found, x, x in missed) for x in FIELDS)]


def cell(found: judge.Found, field: str, bold: bool) -> str:
    value = getattr(found, field)
    text = f"{value}" if isinstance(value, int) else f"{value:.3f}"
    return f"**{text}**" if bold else text


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--samples", type=int, default=16_000)
    parser.add_argument("--shapes", nargs="+", default=list(MESHED), choices=list(MESHED))
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--worst", action="store_true", help="print where the worst facets are")
    options = parser.parse_args()
    rows = [
        row(name, turn, options.samples, options.worst)
        for name in options.shapes
        for turn in range(options.turns + 1)
    ]
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
