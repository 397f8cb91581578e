#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Who reads our files: this writes an axis in every form, has every reader of tests/support/readers.py
that is installed read it, and prints the table of docs/formats.md. Readers that are absent are named.
"""

import importlib.metadata
import io
import sys
import tempfile
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "python")]

import conftest  # noqa: E402, F401  it makes the package medial_axis of the sources
import medial_axis  # noqa: E402
import numpy as np  # noqa: E402

from tests.support.readers import NAMES, READERS, area_of  # noqa: E402

FORMS = [(suffix, triangles) for suffix in (".ply", ".obj", ".off") for triangles in (False, True)]


def example():
    """An axis with facets of three to eight corners and more."""
    points = np.random.default_rng(4).normal(size=(400, 3)) * (3, 2, 1)
    return medial_axis.compute(
        points / np.linalg.norm(points / (3, 2, 1), axis=1)[:, None], form="published"
    ).axis


def verdict(reader: str, path: Path, vertices: int, area: float) -> str:
    """'whole' where the reader finds all vertices and the whole surface, or what it found or said."""
    try:
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            points, _, found = READERS[reader](path)
    except (Exception, SystemExit) as error:  # meshio ends the program
        return f"refused: {type(error).__name__}"
    if points == vertices and abs(found / area - 1) < 1e-4:
        return "whole"
    return f"{points} of {vertices} vertices, {found / area:.0%} of the area"


def table() -> str:
    axis = example()
    faces = [row.tolist() for row in np.split(axis.face_vertices, axis.face_offsets[1:-1])]
    area = area_of(axis.vertices, faces)
    present = [name for name in NAMES if name in READERS]
    titles = [f"{name} {importlib.metadata.version(name)}" for name in present]
    lines = ["| file | " + " | ".join(titles) + " |", "|---" * (len(titles) + 1) + "|"]
    with tempfile.TemporaryDirectory() as folder:
        for suffix, triangles in FORMS:
            path = medial_axis.write(axis, Path(folder) / f"a{suffix}", triangles=triangles)
            found = [
                "—"
                if name == "plyfile" and suffix != ".ply"
                else verdict(name, path, len(axis.vertices), area)
                for name in present
            ]
            form = f"`{suffix}`" + (" as triangles" if triangles else "")
            lines.append(f"| {form} | " + " | ".join(found) + " |")
    absent = [name for name in NAMES if name not in READERS]
    return "\n".join(lines) + (f"\n\nNot installed: {', '.join(absent)}" if absent else "")


if __name__ == "__main__":
    print(table())
