# SPDX-License-Identifier: GPL-3.0-or-later
"""Convergence to exactly known medial axes: a Markdown table and the fitted orders in the sample spacing.

    python3 lab/benchmarks/convergence.py [--output table.md] [--sizes 2000 8000 ...] [--shapes ellipsoid ...]

o->t: from area-weighted points of the output to the true axis; t->o: from points of the true axis to the output.
h: median over the samples of the largest circumradius in the umbrella. All sizes up to 64,000 take about ten minutes.
"""

import sys

import _module
import numpy as np

medial = _module.load()

from support import measure  # noqa: E402  (found through _module)
from support.shapes import SHAPES  # noqa: E402

SIZES = (1000, 2000, 4000, 8000, 16000, 32000, 64000)
HEADER = ["shape", "limit set", "n", "h", "facets", "o->t mean", "p99", "max", "t->o mean", "max"]


def measured(
    name: str, sizes: list[int], seed: int
) -> list[tuple[bool, int, float, int, list[float]]]:
    """limit_set, n, h, inner facets and the five distances of every run of one shape."""
    runs = []
    for size in sizes:
        points = SHAPES[name].sample(size, seed)
        analysis = medial.MedialAnalysis(points)
        for limit_set in (False, True):
            mesh = analysis.extract(limit_set=limit_set)
            facets = int(measure.inner_facets(mesh, SHAPES[name]).sum())
            distances = measure.errors(mesh, SHAPES[name]).row()
            runs.append(
                (limit_set, len(points), measure.spacing(medial, points), facets, distances)
            )
            print(name, runs[-1], file=sys.stderr, flush=True)
    return runs


def orders(runs: list) -> list[float]:
    """Slopes of log distance over log h, least squares."""
    h = np.log([run[2] for run in runs])
    return [float(np.polyfit(h, np.log([run[4][i] for run in runs]), 1)[0]) for i in range(5)]


def table(names: list[str], sizes: list[int], seed: int) -> str:
    rows = []
    for name in names:
        runs = measured(name, sizes, seed)
        for limit_set in (False, True):
            chosen = [run for run in runs if run[0] == limit_set]
            option = "on" if limit_set else "off"
            for _, n, h, facets, distances in chosen:
                rows.append(
                    [
                        name,
                        option,
                        str(n),
                        f"{h:.4f}",
                        str(facets),
                        *(f"{d:.1e}" for d in distances),
                    ]
                )
            if len(chosen) > 1:
                rows.append(
                    [name, option, "order in h", "", "", *(f"**{o:.2f}**" for o in orders(chosen))]
                )
    return _module.markdown(HEADER, rows)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--shapes", nargs="+", default=list(SHAPES), choices=list(SHAPES))
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    text = table(options.shapes, options.sizes, options.seed)
    _module.publish(text, options.output)


if __name__ == "__main__":
    main()
