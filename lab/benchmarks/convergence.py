# SPDX-License-Identifier: GPL-3.0-or-later
"""Convergence to exactly known medial axes: a row per run, a plot, and the fitted orders in the sample spacing.

    python3 lab/benchmarks/convergence.py [--sizes 2000 8000 ...] [--shapes ellipsoid ...]
    python3 lab/benchmarks/convergence.py --draw        the plot again, from the rows that are there

Writes docs/lab/convergence.csv and docs/pictures/convergence.svg, or where --rows and --picture say, and prints the
orders. o->t: from area-weighted points of the output to the true axis; t->o: from points of the true axis to the
output. h: median over the samples of the largest circumradius in the umbrella. All sizes up to 64,000 take about ten
minutes.
"""

import argparse
import csv
import sys
from pathlib import Path

import _module
import numpy as np

medial = _module.load()

from support import measure  # noqa: E402
from support.shapes import SHAPES  # noqa: E402

from lab.race import plot  # noqa: E402  (found through _module)

SIZES = (1000, 2000, 4000, 8000, 16000, 32000, 64000)
DISTANCES = ("o->t mean", "o->t p99", "o->t max", "t->o mean", "t->o max")
COLUMNS = ("shape", "limit set", "n", "h", "facets", *DISTANCES)
LINES = {
    "output to axis": ("o->t mean", "off", "#0b57d0"),
    "output to axis, limit set": ("o->t mean", "on", "#6fa8ff"),
    "axis to output": ("t->o mean", "off", "#9a6700"),
    "axis to output, limit set": ("t->o mean", "on", "#e0b060"),
}

Row = dict[str, str]  # a text per column


def measured(name: str, sizes: list[int], seed: int) -> list[Row]:
    """Two rows per size, without and with the limit set."""
    rows = []
    for size in sizes:
        points = SHAPES[name].sample(size, seed)
        analysis = medial.MedialAnalysis(points)
        spacing = measure.spacing(medial, points)
        for option, limit_set in (("off", False), ("on", True)):
            mesh = analysis.extract(limit_set=limit_set)
            facets = int(measure.inner_facets(mesh, SHAPES[name]).sum())
            distances = [f"{d:.3e}" for d in measure.errors(mesh, SHAPES[name]).row()]
            texts = (name, option, str(len(points)), f"{spacing:.4f}", str(facets), *distances)
            rows.append(dict(zip(COLUMNS, texts, strict=True)))
            print(*texts, file=sys.stderr, flush=True)
    return rows


def chosen(rows: list[Row], name: str, option: str) -> list[Row]:
    return [row for row in rows if (row["shape"], row["limit set"]) == (name, option)]


def names_in(rows: list[Row]) -> list[str]:
    return list(dict.fromkeys(row["shape"] for row in rows))


def orders(runs: list[Row]) -> list[float]:
    """Slopes of log distance over log h, least squares, of each kind of distance."""
    h = np.log([float(run["h"]) for run in runs])
    logs = [np.log([float(run[kind]) for run in runs]) for kind in DISTANCES]
    return [float(np.polyfit(h, log, 1)[0]) for log in logs]


def table(rows: list[Row]) -> str:
    """The orders of each shape, without and with the limit set."""
    lines = [
        [name, option, *(f"{order:.2f}" for order in orders(chosen(rows, name, option)))]
        for name in names_in(rows)
        for option in ("off", "on")
    ]
    return _module.markdown(["shape", "limit set", *DISTANCES], lines)


def picture(rows: list[Row]) -> str:
    """Mean distances over the number of samples, a panel for each shape."""
    panels = {
        name: {
            line: [(float(row["n"]), float(row[kind])) for row in chosen(rows, name, option)]
            for line, (kind, option, _) in LINES.items()
        }
        for name in names_in(rows)
    }
    colours = {line: colour for line, (*_, colour) in LINES.items()}
    return plot.panels(panels, "Mean distances over the number of samples", colours)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    docs = _module.ROOT / "docs"
    parser.add_argument("--rows", type=Path, default=docs / "lab" / "convergence.csv")
    parser.add_argument("--picture", type=Path, default=docs / "pictures" / "convergence.svg")
    parser.add_argument("--draw", action="store_true", help="draw the rows, measure nothing")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--shapes", nargs="+", default=list(SHAPES), choices=list(SHAPES))
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    if options.draw:
        with options.rows.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    else:
        rows = [
            row for name in options.shapes for row in measured(name, options.sizes, options.seed)
        ]
        with options.rows.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        if len(options.sizes) > 1:
            print(table(rows))
    options.picture.write_text(picture(rows), encoding="utf-8")


if __name__ == "__main__":
    main()
