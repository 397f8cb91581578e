# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes and renders the medial axis of some models, each in a Blender of its own, and prints what they report."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import tempfile
from pathlib import Path
from typing import Union

from tools.packaging import paths
from tools.packaging.blender import Blender
from tools.packaging.terminal import Failure, say

EXAMPLES = [("suzanne", ["--subdivide", "3"]), ("bracket", [])]  # with options of the demo script
Model = Union[Path, str]  # a file, or the name of an example


def existing(names: list[str]) -> list[Path]:
    """The mesh files with these names; Failure when one is not there."""
    meshes = [Path(name).resolve() for name in names]
    for mesh in meshes:
        if not mesh.is_file():
            raise Failure(f"Expected mesh files, found no file {mesh}; check the path")
    return meshes


def show_models(blender: Path, archive: Path, meshes: list[Path], output: Path) -> None:
    """A .blend, .ply, .ma and .png of each mesh, or of two examples, in the folder `output`."""
    output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="medial_axis_demo_") as name:
        folder = Path(name)
        models = [(mesh, []) for mesh in meshes] or EXAMPLES
        reports = [show_model(blender, archive, *model, output, folder) for model in models]
    print_table(reports)


def show_model(
    program: Path, archive: Path, model: Model, extra: list[str], output: Path, folder: Path
) -> dict:
    """Compute and render one model; returns what its Blender reports."""
    say(f"Medial axis of {model if isinstance(model, str) else model.name}")
    report = folder / "report.json"
    report.unlink(missing_ok=True)
    blender = Blender([str(program)], folder / "profile")
    script = Path(__file__).with_name("blender_demo.py")
    options = ["--zip", archive, "--model", model, *extra, "--output", output, "--report", report]
    run_rendering(blender.command("--python", script, "--", *options), blender.environment)
    return json.loads(report.read_text(encoding="utf-8"))


def run_rendering(command: list[str], environment: dict[str, str]) -> None:
    """As `run`, with Blender's many lines about a rendering as one line about every tenth part of it."""
    print("$ " + " ".join(map(shlex.quote, command)), flush=True)
    pipe = {"stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, cwd=paths.ROOT, env=environment, **pipe) as blender:
        shown = ""
        for line in blender.stdout:
            samples = re.search(r"Sample (\d+)/(\d+)", line)
            part = f"{10 * int(samples[1]) // int(samples[2])}0 %" if samples else shown
            if not line.startswith("Fra:"):
                print(line, end="", flush=True)
            elif part != shown:
                shown = part
                print(f"rendering, {part}", flush=True)
    if blender.returncode != 0:
        raise Failure(f"Blender ended with exit code {blender.returncode}; its output is above")


def print_table(reports: list[dict]) -> None:
    columns = list(reports[0])
    rows = [columns, *([str(report[column]) for column in columns] for report in reports)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(columns))]
    say("Results")
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
