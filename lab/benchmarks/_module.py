# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets the benchmarks find the compiled module and the shapes of the tests from a plain checkout."""

import argparse
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(os.environ.get("MEDIAL_AXIS_PACKAGE", ROOT / "blender_addon"))

sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from support import study as study_module  # noqa: E402 - found through the line above
from support.data import DATA  # noqa: E402, F401


def load():
    """The compiled module, through the add-on's own loader."""
    if "medial_axis" not in sys.modules:
        _register_package()
    from medial_axis.core.machine import native

    return native.load()


def study():
    """The module that is not shipped: all of the compiled one, the stages by themselves and the methods of others."""
    return study_module.load()


def _register_package():
    spec = importlib.util.spec_from_file_location(
        "medial_axis", PACKAGE / "__init__.py", submodule_search_locations=[str(PACKAGE)]
    )
    sys.modules["medial_axis"] = package = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(package)


def in_blender(script: str, names: dict[str, str], **given: object) -> dict[str, tuple]:
    """The vertices and triangles that a script of this folder makes of arrays inside Blender, by the ways' names."""
    blender = shutil.which("blender")
    if blender is None:
        print("Blender's modifiers are left out: Blender is not installed")
        return {}
    with tempfile.TemporaryDirectory() as folder:
        question, answer = Path(folder, "given.npz"), Path(folder, "answer.npz")
        np.savez(question, **given)
        command = [blender, "--background", "--factory-startup", "--python-exit-code", "1"]
        command += ["--python", str(Path(__file__).with_name(script)), "--"]
        subprocess.run([*command, question, answer], check=True, stdout=subprocess.DEVNULL)
        found = np.load(answer)
        return {names[n]: (found[f"{n}_points"], found[f"{n}_triangles"]) for n in names}


def markdown(header: list[str], rows: list[list[str]]) -> str:
    """A Markdown table with aligned columns."""
    widths = [max(len(row[i]) for row in [header, *rows]) for i in range(len(header))]
    lines = [header, ["-" * width for width in widths], *rows]
    return (
        "\n".join(
            "| " + " | ".join(x.ljust(w) for x, w in zip(row, widths)) + " |" for row in lines
        )
        + "\n"
    )


def tell(header: list[str], found: Iterable[list[str]], output: Path | None) -> None:
    """Print rows as they are found, then their table, which also goes to a file if there is one."""
    rows = []
    for row in found:
        print(" | ".join(row), file=sys.stderr, flush=True)
        rows.append(row)
    text = markdown(header, rows)
    print(text)
    if output:
        output.write_text(text, encoding="utf-8")


def parser(description: str) -> argparse.ArgumentParser:
    """A parser for a script that prints a table, with the option to write the table to a file."""
    made = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    made.add_argument("--output", type=Path, help="also write the table to this file")
    return made


def publish(text: str, output: Path | None) -> None:
    print(text)
    if output:
        output.write_text(text)
