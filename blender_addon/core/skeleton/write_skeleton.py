# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes skeletons as `.swc`, `.obj`, `.json`, `.csv` and `.vtp` files (docs/skeleton.md).

A file appears whole or not at all.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ..arrays import Longs
from ..curves.smooth_line import marks_of
from ..files.vtp import write_vtp
from ..files.writing import extension_of, known, write_rows, write_whole
from .branches import MEASURES, Branches, branches_of
from .parts import Parts
from .skeleton import Skeleton

_ALONG, _FORK, _END = 0, 5, 6  # types of SWC


@dataclass(frozen=True, eq=False)
class _Content:
    """This is all that a file may hold."""

    skeleton: Skeleton
    parts: Parts
    branches: Branches | None


def export_skeleton(
    skeleton: Skeleton, parts: Parts, path: str | os.PathLike, branches: Branches | None = None
) -> Path:
    """Write a skeleton, and return the path of the file; the extension of `path` chooses the format.

    Parameters
    ----------
    skeleton : Skeleton
    parts : Parts
        Only `.json` files hold them.
    path : path of the file; its folder must exist. A file of that name is replaced.
    branches : Branches, optional
        The measures of its branches, for the formats that hold them; otherwise its points alone are measured.

    Raises
    ------
    ExportError
        The extension is unknown, or the system refused to write; an old file is then unchanged.
    """
    write = SKELETON_FORMATS[extension_of(path, SKELETON_FORMATS)]
    if branches is None and holds_branches(path):
        branches = branches_of(skeleton)
    content = _Content(skeleton, parts, branches)
    return write_whole(path, lambda stream: write(content, stream))


def holds_branches(path: str | os.PathLike) -> bool:
    """Return whether files of that name hold the measures of branches."""
    return Path(path).suffix.lower() in (".json", ".csv", ".vtp")


def _write_swc(content: _Content, stream: BinaryIO) -> None:
    """Write `id type x y z radius parent`, parents first. SWC has only trees: comments name edges that close loops.

    They also name the points between which pieces were joined, with the length of the gap.
    """
    skeleton = content.skeleton
    parent, order = _tree(skeleton)
    number = np.empty(len(order), np.int64)
    number[order] = np.arange(1, len(order) + 1)
    stream.write(b"# id type x y z radius parent\n")
    stream.write(b"# type %d: along a branch, %d: fork, %d: end\n" % (_ALONG, _FORK, _END))
    in_tree = {(min(p, row), max(p, row)) for row, p in enumerate(parent.tolist()) if p >= 0}
    for a, b in skeleton.edges.tolist():
        if (min(a, b), max(a, b)) not in in_tree:
            stream.write(b"# closes a loop: %d %d\n" % (number[a], number[b]))
    for (a, b), length in zip(skeleton.joins.tolist(), skeleton.gaps.tolist(), strict=True):
        text = f"# joins pieces across a gap: {number[a]} {number[b]} {length:.17g}\n"
        stream.write(text.encode("ascii"))
    kind = np.where(skeleton.degree > 2, _FORK, np.where(skeleton.degree == 1, _END, _ALONG))
    above = np.where(parent >= 0, number[parent], -1)
    columns = number, kind, skeleton.points, skeleton.radius, above
    row = "%d %d %.17g %.17g %.17g %.17g %d\n"
    write_rows(stream, row, *(column[order] for column in columns))


def _tree(skeleton: Skeleton) -> tuple[Longs, Longs]:
    """Return the parent of each point, -1 for roots, and all points, parents first; the thickest of a part is root."""
    neighbours: list[list[int]] = [[] for _ in skeleton.points]
    for a, b in skeleton.edges.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    order: list[int] = []
    parent, seen = np.full(len(neighbours), -1, np.int64), np.zeros(len(neighbours), bool)
    for root in np.argsort(-skeleton.radius, kind="stable").tolist():
        if seen[root]:
            continue
        seen[root], first = True, len(order)
        order.append(root)
        while first < len(order):
            for other in neighbours[order[first]]:
                if not seen[other]:
                    seen[other], parent[other] = True, order[first]
                    order.append(other)
            first += 1
    return parent, np.array(order, np.int64)


def _write_obj(content: _Content, stream: BinaryIO) -> None:
    """Write vertices, a line for each branch, and a point for each node without a branch."""
    skeleton = content.skeleton
    write_rows(stream, "v %.17g %.17g %.17g\n", skeleton.points)
    for branch in skeleton.branches:
        stream.write(
            ("l " + " ".join(str(row + 1) for row in branch.tolist()) + "\n").encode("ascii")
        )
    write_rows(stream, "p %d\n", np.setdiff1d(skeleton.nodes, skeleton.branch_points) + 1)


def _write_json(content: _Content, stream: BinaryIO) -> None:
    """Write points with radii, edges, for each branch its points, its triangles and its measures; null is unknown."""
    skeleton, faces = content.skeleton, content.parts.faces
    rows = zip(skeleton.points.tolist(), skeleton.radius.tolist(), strict=True)
    parts = zip(skeleton.branches, _rows_of(content), strict=True)
    found = {
        "nodes": [{"position": position, "radius": radius} for position, radius in rows],
        "edges": skeleton.edges.tolist(),
        "parts": [
            {
                "nodes": branch.tolist(),
                "faces": np.flatnonzero(faces == number).tolist(),
                "measures": {name: known(value) for name, value in row.items()},
            }
            for number, (branch, row) in enumerate(parts)
        ],
    }
    stream.write(json.dumps(found, separators=(",", ":"), allow_nan=False).encode("ascii"))
    stream.write(b"\n")


def _rows_of(content: _Content) -> list[dict[str, Any]]:
    """Return the measures of each branch by name."""
    assert content.branches is not None
    columns = {name: column.tolist() for name, column in content.branches.columns.items()}
    rows = zip(*columns.values(), strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]


def _write_csv(content: _Content, stream: BinaryIO) -> None:
    """Write a row for each branch; an unknown number is an empty cell."""
    assert content.branches is not None
    stream.write((",".join(("branch", *content.branches.columns)) + "\n").encode("ascii"))
    for number, row in enumerate(_rows_of(content)):
        cells = [str(number), *map(_cell, row.values())]
        stream.write((",".join(cells) + "\n").encode("ascii"))


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.17g}" if math.isfinite(value) else ""
    return str(int(value))


def _write_vtp(content: _Content, stream: BinaryIO) -> None:
    """Write lines with the measures along them at points, and those of whole branches at cells; nan is unknown."""
    skeleton, branches = content.skeleton, content.branches
    assert branches is not None
    singles = np.setdiff1d(skeleton.nodes, skeleton.branch_points).astype(np.int32)
    along = np.full((len(skeleton.points), len(MEASURES)), np.nan)
    for chain, profile in zip(skeleton.branches, branches.profiles, strict=True):
        marks = marks_of(skeleton.points[chain])
        if marks[-1] > 0.0:
            found = profile.at(marks / marks[-1])
            inner = slice(0 if chain[0] == chain[-1] else 1, -1)  # forks belong to several branches
            along[chain[inner]] = found[inner]
    of_points = {"radius": skeleton.radius, "degree": skeleton.degree}
    of_points.update(zip(MEASURES, along.T, strict=True))
    blank = {"i": -1, "b": 0, "f": np.nan}
    columns = {"branch": np.arange(skeleton.count, dtype=np.int32), **branches.columns}
    of_cells = {
        name: np.concatenate((np.full(len(singles), blank[column.dtype.kind]), column))
        for name, column in columns.items()
    }
    write_vtp(stream, skeleton.points, singles, skeleton.branches, of_points, of_cells)


SKELETON_FORMATS: dict[str, Callable[[_Content, BinaryIO], None]] = {
    ".swc": _write_swc,
    ".obj": _write_obj,
    ".json": _write_json,
    ".csv": _write_csv,
    ".vtp": _write_vtp,
}
