# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs programs on samples of solids, each in a process and a folder of its own, and has the judge score them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import ROOT, judge, read_axis
from .recipes import Recipe
from .solids import SOLIDS, samples

Row = dict[str, Any]


@dataclass(frozen=True)
class Case:
    """A solid and how it is sampled."""

    solid: str
    size: int
    noisy: bool

    def __str__(self) -> str:
        return f"{self.solid} {self.size}{' noisy' if self.noisy else ''}"


class Inputs:
    """Files of samples, made when they are first wanted and kept in a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def files(self, case: Case, mesh: bool) -> dict[str, Path]:
        stem = str(case).replace(" ", "_")
        found = {
            "points": self._folder / f"{stem}.xyz",
            "oriented": self._folder / f"{stem}.xyzn",
            "mesh": self._folder / f"{stem}.off",
        }
        if not found["oriented"].exists():
            points, normals = samples(SOLIDS[case.solid], case.size, case.noisy)
            np.savetxt(found["points"], points, fmt="%.17g")
            np.savetxt(found["oriented"], np.hstack((points, normals)), fmt="%.17g")
        if mesh and not found["mesh"].exists():
            _write_mesh(found["points"], found["mesh"])
        return {name: path.resolve() for name, path in found.items()}


def _write_mesh(points: Path, path: Path) -> None:
    """The watertight surface of Tight Cocone through the points."""
    from . import product

    rows = np.loadtxt(points)
    triangles = product.load().TightCocone(np.ascontiguousarray(rows)).triangles
    lines = ["OFF", f"{len(rows)} {len(triangles)} 0", *points.read_text().splitlines()]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    path.write_text("\n".join(lines) + "\n")


def run(recipe: Recipe, case: Case, inputs: Inputs, limit: int = 300, outer: bool = False) -> Row:
    """A row of the table: the case, the scores, seconds and memory; or what went wrong."""
    files = inputs.files(case, recipe.gets == "mesh")
    row: Row = {**asdict(case), "outer": outer, "program": recipe.name, "group": recipe.group}
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder, recipe.output)
        words = recipe.words({**files, "output": output}, outer)
        cost, said = metered(words, Path(folder), limit)
        row |= {name: cost[name] for name in ("cpu", "wall", "bytes")}
        if cost["exit"] != 0 or not output.exists():
            why = "took too long" if cost["wall"] >= limit else f"exit code {cost['exit']}"
            return row | {"failed": why, "said": said[-300:]}
        try:
            found = read_axis.read(output)
            return row | asdict(judge.judge(case.solid, found, case.size, outer))
        except read_axis.UnreadableError as error:
            return row | {"failed": str(error)}


def metered(words: list[str], folder: Path, limit: int) -> tuple[dict[str, Any], str]:
    result = folder / "meter.json"
    paths = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
    meter = [sys.executable, "-S", str(Path(__file__).with_name("meter.py")), result, str(limit)]
    done = subprocess.run(
        [*map(str, meter), *words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        capture_output=True,
        text=True,
        errors="replace",
    )
    if not result.exists():
        raise RuntimeError(f"Expected a command that can be started, found {words}: {done.stderr}")
    return json.loads(result.read_text()), done.stderr
