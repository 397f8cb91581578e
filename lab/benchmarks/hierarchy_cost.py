# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the cost of the hierarchy relative to the bare Delaunay triangulation of the same points: Markdown tables.

    python3 lab/benchmarks/hierarchy_cost.py [--only WORD ...] [--turns K] [--threads N ...] [--largest N]
        [--blender PROGRAM]

wants a build of the release preset with its target `bare_triangulation`. CGAL alone and ours take turns, each in a
process of its own, with the inputs of bench.py; inside is told by the faces where there are some, else by Tight Cocone.
Figures are medians of the turns, ratios medians of the ratios of neighbours.

Wall, CPU: all stages of the hierarchy / bare; CPU is of all threads together, and hardly depends on what else the
machine does. Then the stages, seconds / bare. Level: the level of Clean at the first values of its sliders, and at
eight values of Erode, in bare and CPU likewise. Peak: resident bytes per point beside the input's; of the analysis
alone, and with the hierarchy. Others: how many cores other processes kept busy meanwhile.

With --blender the click and a slider, as blender_bench.py has them, at 100,000 points, and a million where --largest
allows.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import _module
import measuring
from measuring import Input, median

BARE = _module.ROOT / "build/release/lab/benchmarks/bare_triangulation"
STAGES = ("complex", "fringe", "sheets", "fire", "wires", "values")
HEADER = ["input", "points", "threads", "bare s", "wall", "CPU", *STAGES]
HEADER += ["first level", "CPU", "level", "CPU", "peak analysis", "peak", "kept", "others"]
NOTHING = (
    "Expected inputs that have one of the words {} in their names and at most {} points, found "
    "none; see bench.py for the names, and let MEDIAL_AXIS_TEST_DATA name the folder of the meshes."
)


def main() -> None:
    options = _options()
    if options.child:
        print(json.dumps(_measured(Path(options.child), options.threads[0])))
        return
    import bench

    rows = []
    for work in bench.ladder(options.largest, options.only):
        with tempfile.TemporaryDirectory(prefix="medial_axis_bench_") as name:
            work.write(Path(name))
            for threads in options.threads:
                turns = [_turn(Path(name), threads) for _ in range(options.turns)]
                rows.append(_row(work, threads, median(turns)))
                print(rows[-1], file=sys.stderr, flush=True)
    if not rows:
        raise SystemExit(NOTHING.format(" ".join(options.only), options.largest))
    print(_module.markdown(HEADER, rows))
    if options.blender:
        _in_blender(options)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", nargs="+", default=["ellipsoid 121723", "igea", "engine"])
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--largest", type=int, default=500_000)
    parser.add_argument("--blender", default="")
    parser.add_argument("--child", default="", help=argparse.SUPPRESS)
    return parser.parse_args()


def _turn(folder: Path, threads: int) -> dict:
    """CGAL alone, and ours right after it."""
    alone = measuring.bare(BARE, folder)
    command = [sys.executable, __file__, "--child", folder, "--threads", threads]
    text, others = measuring.in_child(command)
    found = json.loads(text)
    seconds = {name: value / alone["seconds"] for name, value in found["seconds"].items()}
    cpu = {name: value / alone["cpu"] for name, value in found["cpu"].items()}
    return {
        "bare": alone["seconds"],
        "seconds": seconds,
        "cpu": cpu,
        "bytes": found["bytes"],
        "others": max(others, alone["others"]),
    }


def _measured(folder: Path, threads: int) -> dict:
    """In a process of its own: seconds, seconds of all threads, and bytes."""
    medial = _module.load()
    work = Input.read(folder)
    faces = work.triangles if len(work.triangles) else None
    memory = measuring.Memory()
    analysis = medial.MedialAnalysis(work.points, faces, threads=threads)
    peak = memory.peak
    hierarchy, seconds, cpu = _timed(analysis.hierarchy)
    held = {"analysis": peak, "peak": memory.peak, "kept": memory.now}
    clean = {"spacings": 1.0, "relaxed": True, "round_limbs": True}
    _, first, first_cpu = _timed(lambda: hierarchy.extract(**clean))
    levels = [
        _timed(lambda erosion=erosion: hierarchy.extract(erosion=erosion, **clean))[1:]
        for erosion in (0.0005 * number for number in range(1, 9))
    ]
    level, level_cpu = (median([each[which] for each in levels]) for which in (0, 1))
    return {
        "seconds": dict(hierarchy.timings) | {"all": seconds, "first": first, "level": level},
        "cpu": {"all": cpu, "first": first_cpu, "level": level_cpu},
        "bytes": held,
    }


def _timed(action) -> tuple:
    start, cpu = time.perf_counter(), time.process_time()
    value = action()
    return value, time.perf_counter() - start, time.process_time() - cpu


def _row(work: Input, threads: int, turn: dict) -> list[str]:
    seconds, cpu = turn["seconds"], turn["cpu"]
    cells = [work.name, str(len(work.points)), str(threads), f"{turn['bare']:.3f}"]
    cells += [f"{seconds['all']:.2f}", f"{cpu['all']:.2f}"]
    cells += [f"{seconds[stage]:.2f}" for stage in STAGES]
    for name in ("first", "level"):
        cells += [f"{seconds[name]:.2f}", f"{cpu[name]:.2f}"]
    cells += [f"{turn['bytes'][name] / len(work.points):.0f}" for name in turn["bytes"]]
    return [*cells, f"{turn['others']:.1f}"]


def _in_blender(options: argparse.Namespace) -> None:
    import blender_bench

    results = [
        blender_bench.measured(work, BARE, options.blender, options.turns)
        for work in blender_bench.ladder(max(options.largest, 100_000), ["mesh"])
    ]
    print(f"\n{blender_bench.table(results)}")


if __name__ == "__main__":
    main()
