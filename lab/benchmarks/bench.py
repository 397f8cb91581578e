# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the cost of a medial axis relative to the bare Delaunay triangulation of the same points.

    python3 build_addon.py bench [--quick] [--largest N] [--repeats K] [--only WORD ...] [--output FOLDER]
        [--table PAGE]

builds everything and calls this. CGAL alone (bare_triangulation.cpp, compiled as the product is) and ours take turns,
each in a process of its own; figures are medians of the turns, ratios medians of the ratios of neighbours. With
--table the page gets the short tables, and CSV files next to it the long ones.

All: the analysis and the first extract. Own: of that all but CGAL's part. Again: a later extract, as a slider wants
it. CPU: all / bare in processor time, of all threads together. Others: how many cores other processes kept busy
meanwhile; where that is not about 0, trust only the ratio of CPU of one thread.

Meshes are taken from the folder that MEDIAL_AXIS_TEST_DATA names, when it exists.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import platform
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import _module
import blender_bench
import measuring
import numpy as np
from measuring import DELAUNAY, Input, median
from support import meshes
from support.shapes import SHAPES

NO_TRIANGLES = np.empty((0, 3), np.int32)
ELLIPSOIDS = (10_000, 121_723, 500_000, 1_000_000, 2_000_000, 5_000_000)
FILES = ("igea.ply", "engine_skin_large.ply", "lion_scan.ply")
LARGEST_COCONE = 1_000_000
LARGEST_QHULL = 500_000
# Dey & Zhao, Table 1: FEMALE, Delaunay and filter on a 933 MHz PC.
PAPER_POINTS, PAPER_SECONDS = 121_723, 292.85 + 24.95
MARK = "<!-- written by build_addon.py bench: do not edit below -->"


# --- inputs


def ladder(largest: int, wanted: list[str]) -> Iterator[Input]:
    """The inputs, each made when it is first needed."""
    for name, count, make in _makers():
        if count <= largest and (not wanted or any(word in name for word in wanted)):
            work = Input(name, *make(count))
            if len(work.points) <= largest:
                yield work


def _makers() -> Iterator[tuple[str, int, Callable[[int], meshes.Mesh]]]:
    """Name, number of points (0: as a file has them), and what makes so many."""
    for count in ELLIPSOIDS:
        yield f"ellipsoid {count}", count, partial(_random, "ellipsoid")
    yield "torus 500000", 500_000, partial(_random, "torus")
    yield "noisy scan 200000", 200_000, _noisy
    for file in FILES:
        if (_module.DATA / file).is_file():
            yield file, 0, lambda _, file=file: meshes.read(_module.DATA / file)


def _random(shape: str, count: int) -> meshes.Mesh:
    """Uniformly random, so in no order that helps, and uneven."""
    return SHAPES[shape].random_sample(count, 0), NO_TRIANGLES


def _noisy(count: int) -> meshes.Mesh:
    """Moved by a normal deviate of a quarter of the mean spacing along each axis."""
    points, _ = _random("ellipsoid", count)
    noise = np.random.default_rng(1).normal(size=points.shape)
    return points + 0.25 * np.sqrt(SHAPES["ellipsoid"].area / count) * noise, NO_TRIANGLES


# --- measuring


def measured(work: Input, options: argparse.Namespace) -> dict:
    """Turns of CGAL alone and each of ours; then Qhull."""
    with tempfile.TemporaryDirectory(prefix="medial_axis_bench_") as name:
        folder = Path(name)
        work.write(folder)
        turns: dict[tuple[str, int], list[dict]] = {case: [] for case in cases(work)}
        qhull = []
        for _ in range(options.repeats):
            for (sides, threads), done in turns.items():
                alone = measuring.bare(options.bare, folder)
                done.append({"bare": alone, **measuring.ours(folder, sides, threads)})
            if len(work.points) <= LARGEST_QHULL:
                qhull.append(measuring.qhull(folder))
    rows = [summary(*case, done) for case, done in turns.items()]
    return {
        "input": work.name,
        "points": len(work.points),
        "triangles": len(work.triangles),
        "rows": [{**row, "speed-up": speed_up(row, rows)} for row in rows],
        "qhull": median(qhull) if qhull else None,
    }


def cases(work: Input) -> list[tuple[str, int]]:
    """Pairs of the source of inside and outside, and the number of threads."""
    sides = ["NONE"]
    if len(work.triangles):
        sides.append("SURFACE")
    elif len(work.points) <= LARGEST_COCONE:
        sides.append("TIGHT_COCONE")
    threads = sorted({1, len(os.sched_getaffinity(0))})
    return [(s, t) for s in sides for t in threads]


def summary(sides: str, threads: int, turns: list[dict]) -> dict:
    """Medians of the turns, and of their ratios."""
    for turn in turns:
        seconds, alone = turn["seconds"], turn["bare"]["seconds"]
        delaunay = next(turn["stages"][stage] for stage in DELAUNAY if stage in turn["stages"])
        seconds["own"] = seconds["analysis"] - delaunay + seconds["extract"]
        seconds["all"] = seconds["analysis"] + seconds["extract"]
        turn["ratios"] = {name: value / alone for name, value in seconds.items()}
        turn["ratios"]["cpu"] = turn["cpu"] / turn["bare"]["cpu"]
    return {"sides": sides, "threads": threads, **median(turns)}


def speed_up(row: dict, rows: list[dict]) -> float:
    """The speed-up of all but CGAL's part from one thread to the threads of this row."""
    one = next(r for r in rows if (r["sides"], r["threads"]) == (row["sides"], 1))
    return one["seconds"]["own"] / row["seconds"]["own"]


# --- tables


Table = tuple[list[str], list[list[str]]]
"""A header and rows."""


def beside_bare(results: list[dict]) -> Table:
    header = ["input", "points", "inside from", "threads", "bare s", "all s", "all / bare"]
    header += ["CPU", "own s", "own / bare", "speed-up", "extract / bare", "again / bare", "facets"]
    header += ["peak B / point", "kept B / point", "bare B / point", "others"]
    rows = []
    for result, row in each_row(results):
        seconds, ratios, count = row["seconds"], row["ratios"], result["points"]
        sizes = (row["bytes"]["with extract"], row["bytes"]["kept"], row["bare"]["bytes"])
        cells = [*label(result, row), f"{row['bare']['seconds']:.3f}", f"{seconds['all']:.3f}"]
        cells += [f"{ratios['all']:.2f}", f"{ratios['cpu']:.2f}"]
        cells += [f"{seconds['own']:.3f}", f"{ratios['own']:.2f}"]
        cells += [f"{row['speed-up']:.2f}", f"{ratios['extract']:.2f}", f"{ratios['again']:.2f}"]
        cells += [f"{row['facets']:.0f}", *(f"{size / count:.0f}" for size in sizes)]
        rows.append([*cells, f"{row['others']:.1f}"])
    return header, rows


def stages(results: list[dict]) -> Table:
    names = list(dict.fromkeys(name for _, row in each_row(results) for name in row["stages"]))
    rows = []
    for result, row in each_row(results):
        cells = [f"{row['stages'][name]:.3f}" if name in row["stages"] else "" for name in names]
        seconds = (row["seconds"]["extract"], row["seconds"]["again"])
        rows.append([*label(result, row), *cells, *(f"{x:.3f}" for x in seconds)])
    return ["input", "points", "inside from", "threads", *names, "extract", "again"], rows


def beside_others(results: list[dict]) -> str:
    """Without inside and outside, on all threads."""
    rows = []
    for result in results:
        row = [row for row in result["rows"] if row["sides"] == "NONE"][-1]
        seconds, cells = row["seconds"]["all"], [result["input"], str(result["points"])]
        found = [result["qhull"] and result["qhull"]["seconds"]]
        found.append(PAPER_SECONDS if result["points"] == PAPER_POINTS else None)
        cells.append(f"{seconds:.3f}")
        for other in found:
            cells += [f"{other:.2f}", f"{other / seconds:.1f}"] if other else ["", ""]
        rows.append(cells)
    header = ["input", "points", "all s", "Qhull s", "Qhull / all", "paper s", "paper / all"]
    return _module.markdown(header, rows)


def each_row(results: list[dict]) -> Iterator[tuple[dict, dict]]:
    for result in results:
        for row in result["rows"]:
            yield result, row


def label(result: dict, row: dict) -> list[str]:
    inside = row["sides"].replace("_", " ").title()
    return [result["input"], str(result["points"]), inside, str(row["threads"])]


# --- the machine


def machine() -> dict:
    model = [x for x in Path("/proc/cpuinfo").read_text().split("\n") if x.startswith("model name")]
    pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return {
        "processor": model[0].split(":")[1].strip() if model else platform.machine(),
        "cores": len(os.sched_getaffinity(0)),
        "memory": pages,
        "system": platform.system() + " " + platform.release(),
        "module": _module.load().__version__,
        "time": time.strftime("%Y-%m-%d %H:%M"),
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--bare", type=Path, required=True, help="the compiled bare_triangulation")
    parser.add_argument("--largest", type=int, required=True, help="leave larger inputs out")
    parser.add_argument("--repeats", type=int, required=True, help="turns of each")
    parser.add_argument("--only", nargs="*", default=[], help="inputs whose name has such a word")
    parser.add_argument("--blender", required=True, help="the Blender whose operator is measured")
    parser.add_argument("--output", type=Path, required=True, help="a folder")
    parser.add_argument("--table", type=Path, help="put the tables below the mark in this page")
    options = parser.parse_args()
    found = {"machine": {**machine(), "turns": options.repeats}, "native": [], "blender": []}
    for work in ladder(options.largest, options.only):
        found["native"].append(measured(work, options))
        print(_module.markdown(*beside_bare(found["native"][-1:])), file=sys.stderr, flush=True)
        write(found, options.output)
    for work in blender_bench.ladder(options.largest, options.only):
        found["blender"].append(
            blender_bench.measured(work, options.bare, options.blender, options.repeats)
        )
        print(blender_bench.table(found["blender"][-1:]), file=sys.stderr, flush=True)
        write(found, options.output)
    if not (found["native"] or found["blender"]):
        raise SystemExit("Expected an input to measure, found none; see --only and --largest")
    if options.table:
        publish(found, options.table)
    print((options.output / "bench.md").read_text())


def write(found: dict, folder: Path) -> None:
    """All that was found so far."""
    tables = []
    if found["native"]:
        tables += [_module.markdown(*table(found["native"])) for table in LONG.values()]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "bench.json").write_text(json.dumps(found, indent=1))
    (folder / "bench.md").write_text("\n".join([described(found), *tables, *short(found)]))


LONG = {"bare": beside_bare, "stages": stages}
"""The tables that are CSV files next to the page, `performance_bare.csv` and so on."""


def short(found: dict) -> list[str]:
    """The tables that the page shows."""
    tables = [beside_others(found["native"])] if found["native"] else []
    return tables + ([blender_bench.table(found["blender"])] if found["blender"] else [])


def publish(found: dict, page: Path) -> None:
    put_below_mark("\n".join([described(found), *short(found)]), page)
    for name, table in LONG.items() if found["native"] else ():
        path = page.with_name(f"{page.stem}_{name}.csv")
        with path.open("w", newline="", encoding="utf-8") as file:
            header, rows = table(found["native"])
            csv.writer(file, lineterminator="\n").writerows([header, *rows])


def described(found: dict) -> str:
    on = found["machine"]
    return (
        f"{on['processor']}, {on['cores']} cores, {on['memory'] / 2**30:.0f} GiB, {on['system']}; "
        f"medians of {on['turns']} turns, {on['time']}.\n"
    )


def put_below_mark(tables: str, page: Path) -> None:
    above = page.read_text(encoding="utf-8").partition(MARK)[0]
    page.write_text(f"{above}{MARK}\n\n{tables}", encoding="utf-8")


if __name__ == "__main__":
    main()
