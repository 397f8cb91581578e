# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the cost of the operator in Blender relative to the bare triangulation, and that of a change of a slider.

Used by bench.py. Click: the operator with its defaults, from the mesh object to the evaluated object of the clean
axis. Change: another value of Erode, from the panel's property to the evaluated mesh; rho: another Rho, which needs
another hierarchy; drawn: until it is on the screen, which an X server
without a screen and OpenGL in software take much longer for than people's machines; drawing: that alone. CPU: the
ratio to its left in processor time, of all threads together.
"""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import _module
import measuring
import numpy as np
from measuring import Input, median

sys.path.insert(0, str(_module.ROOT / "tests" / "addon"))
sys.path.insert(0, str(_module.ROOT / "tests" / "addon" / "gui"))
import drive
import run as addon
from scipy.spatial import ConvexHull
from support.shapes import SHAPES

COUNTS = (20_000, 100_000, 1_000_000)
LARGEST_DRAWN = (
    20_000  # larger results are drawn by the thread of a job, after the operator has ended
)
SCRIPT = Path(__file__).resolve().parent / "in_blender.py"
HEADER = [
    "in Blender",
    "points",
    "bare s",
    "analysis s",
    "click s",
    "click / bare",
    "CPU",
    "change s",
    "rho s",
]
HEADER += ["change / click", "CPU", "change drawn s", "drawing s", "facets", "peak B / point"]
HEADER += ["others"]


def ladder(largest: int, wanted: list[str]) -> Iterator[Input]:
    """Random points of an ellipsoid, in the precision of meshes: with the faces of their hull, and bare."""
    for count in COUNTS:
        names = [f"mesh {count}", f"vertices {count}"]
        chosen = [name for name in names if not wanted or any(word in name for word in wanted)]
        if count > largest or not chosen:
            continue
        points = SHAPES["ellipsoid"].random_sample(count, 0)
        for name in chosen:
            faces = _hull(points) if name.startswith("mesh") else np.empty((0, 3), np.int32)
            yield Input(name, points.astype(np.float32).astype(np.float64), faces)


def _hull(points: np.ndarray) -> np.ndarray:
    """(m, 3) outward triangles; all points are corners."""
    hull = ConvexHull(points)
    a, b, c = points[hull.simplices].transpose(1, 0, 2)
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0.0
    return np.where(inward[:, None], hull.simplices[:, ::-1], hull.simplices).astype(np.int32)


def measured(work: Input, bare: Path, program: str, repeats: int) -> dict:
    """Turns of CGAL alone and Blender, without a window and, for small inputs, in one."""
    turns = []
    with tempfile.TemporaryDirectory(prefix="medial_axis_bench_") as name:
        folder = Path(name)
        work.write(folder)
        blender = _with_the_addon(program, folder)
        for _ in range(repeats):
            alone = measuring.bare(bare, folder)
            turns.append({"bare": alone, **_in_blender(blender, folder, "--background")})
            if len(work.points) <= LARGEST_DRAWN and shutil.which("Xvfb"):
                turns[-1]["window"] = _in_window(blender, folder)
    for turn in turns:
        seconds, cpu = turn["seconds"], turn["cpu"]
        turn["ratios"] = {
            "click": seconds["run"] / turn["bare"]["seconds"],
            "click cpu": cpu["run"] / turn["bare"]["cpu"],
            "change": seconds["change"] / seconds["run"],
            "change cpu": cpu["change"] / cpu["run"],
        }
    return {"input": work.name, "points": len(work.points), **median(turns)}


def clicked(folder: Path, program: str = "blender") -> dict:
    """One turn of Blender alone, without a window."""
    return _in_blender(_with_the_addon(program, folder), folder, "--background", only="click")


def _with_the_addon(program: str, folder: Path) -> addon.Blender:
    blender = addon.Blender([program], folder / "profile")
    blender.environment["MEDIAL_AXIS_MODULE"] = blender.install(addon.pack_sources(folder))
    return blender


def _in_window(blender: addon.Blender, folder: Path) -> dict:
    with drive.display(drive.SIZE) as number:
        blender.environment |= {"DISPLAY": number, "LIBGL_ALWAYS_SOFTWARE": "1"}
        return _in_blender(blender, folder, "--window-geometry", "0", "0", *map(str, drive.SIZE))


def _in_blender(blender: addon.Blender, folder: Path, *how: str, only: str = "") -> dict:
    answer = folder / "answer.json"
    answer.unlink(missing_ok=True)
    command = [*blender.program, *how, "--factory-startup", "--python-exit-code", "1"]
    command += ["--python", SCRIPT, "--", folder, answer, *only.split()]
    text, others = measuring.in_child(command, env=blender.environment)
    if not answer.exists():
        raise SystemExit(f"Blender gave no answer:\n{text}")
    return {**json.loads(answer.read_text()), "others": others}


def table(results: list[dict]) -> str:
    rows = []
    for result in results:
        seconds, window = result["seconds"], result.get("window", {}).get("seconds", {})
        cells = [result["input"], str(result["points"]), f"{result['bare']['seconds']:.3f}"]
        cells += [f"{seconds['analysis']:.3f}", f"{seconds['run']:.3f}"]
        cells += [f"{result['ratios'][x]:.2f}" for x in ("click", "click cpu")]
        cells += [f"{seconds[x]:.3f}" for x in ("change", "rho")]
        cells += [f"{result['ratios'][x]:.3f}" for x in ("change", "change cpu")]
        cells += [f"{window[x]:.3f}" if window else "" for x in ("change drawn", "drawing")]
        cells += [f"{result['facets']:.0f}", f"{result['bytes'] / result['points']:.0f}"]
        rows.append([*cells, f"{result['others']:.1f}"])
    return _module.markdown(HEADER, rows)
