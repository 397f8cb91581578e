# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures what a click costs for meshes of different kinds: the table from which the README takes its figure.

    MEDIAL_AXIS_TEST_DATA=FOLDER python3 lab/benchmarks/clicks.py docs/lab/performance_clicks.csv

A click is the operator with its defaults, from the mesh object to the evaluated object of the axis, in Blender without
a window. Processor seconds are those of all threads; they hardly depend on what else the machine does, and no click
takes longer on an idle machine. The kinds: random vertices, whose long triangles are the worst case; even ones; a scan.
"""

import csv
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import _module
import blender_bench
from measuring import Input
from support import meshes, thick_meshes

HEADER = ["mesh", "vertices", "seconds", "processor seconds", "cores used by others"]


def inputs() -> Iterator[Input]:
    yield next(blender_bench.ladder(100_000, ["mesh 100000"]))
    yield Input("even ellipsoid", *thick_meshes.ellipsoid(subdivisions=7))
    yield Input("igea.ply", *meshes.read(_module.DATA / "igea.ply"))


def row(work: Input) -> list[object]:
    with tempfile.TemporaryDirectory(prefix="medial_axis_bench_") as name:
        folder = Path(name)
        work.write(folder)
        found = blender_bench.clicked(folder)
    times = found["seconds"]["run"], found["cpu"]["run"], found["others"]
    return [work.name, len(work.points), *(f"{value:.1f}" for value in times)]


if __name__ == "__main__":
    rows = [row(work) for work in inputs()]
    with open(sys.argv[1], "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *rows])
