# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes skeletons as `.swc`, `.obj` and `.json` files (docs/skeleton.md), whole or not at all."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from ..skeleton.skeleton import Skeleton
from .extensions import extension_of
from .whole_file import write_whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..skeleton.parts import Parts


def export_skeleton(skeleton: Skeleton, parts: Parts, path: str | os.PathLike) -> Path:
    """Write a skeleton; the extension of `path` chooses the format.

    Parameters
    ----------
    skeleton : Skeleton
    parts : Parts
        Only `.json` files hold them.
    path : path of the file; its folder must exist. A file of that name is replaced.

    Returns
    -------
    path : Path
        The file that was written, with links resolved.

    Raises
    ------
    ExportError
        The extension is unknown, or the system refused to write; an old file is then unchanged.
    """
    write = SKELETON_FORMATS[extension_of(path, SKELETON_FORMATS)]
    return write_whole(path, lambda stream: write(skeleton, parts, stream))


def _write_swc(skeleton: Skeleton, _parts: Parts, stream: BinaryIO) -> None:
    """Write `id type x y z radius parent`, parents first. SWC has only trees: comments name edges that close loops."""
    parent, order = _tree(skeleton)
    number = np.empty(len(order), np.int64)
    number[order] = np.arange(1, len(order) + 1)
    stream.write(b"# id type x y z radius parent\n")
    in_tree = {(min(p, row), max(p, row)) for row, p in enumerate(parent.tolist()) if p >= 0}
    for a, b in skeleton.edges.tolist():
        if (min(a, b), max(a, b)) not in in_tree:
            stream.write(b"# closes a loop: %d %d\n" % (number[a], number[b]))
    for row in order.tolist():
        above = number[parent[row]] if parent[row] >= 0 else -1
        x, y, z = skeleton.points[row].tolist()
        text = f"{number[row]} 0 {x:.17g} {y:.17g} {z:.17g} {skeleton.radius[row]:.17g} {above}\n"
        stream.write(text.encode("ascii"))


def _tree(skeleton: Skeleton) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
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


def _write_obj(skeleton: Skeleton, _parts: Parts, stream: BinaryIO) -> None:
    """Write vertices, a line for each branch, and a point for each node without a branch."""
    for x, y, z in skeleton.points.tolist():
        stream.write(f"v {x:.17g} {y:.17g} {z:.17g}\n".encode("ascii"))
    for branch in skeleton.branches:
        stream.write(
            ("l " + " ".join(str(row + 1) for row in branch.tolist()) + "\n").encode("ascii")
        )
    for row in np.setdiff1d(skeleton.nodes, skeleton.branch_points).tolist():
        stream.write(b"p %d\n" % (row + 1))


def _write_json(skeleton: Skeleton, parts: Parts, stream: BinaryIO) -> None:
    """Write points with radii, edges, and for each branch its points and the triangles that belong to it."""
    rows = zip(skeleton.points.tolist(), skeleton.radius.tolist(), strict=True)
    found = {
        "nodes": [{"position": position, "radius": radius} for position, radius in rows],
        "edges": skeleton.edges.tolist(),
        "parts": [
            {"nodes": branch.tolist(), "faces": np.flatnonzero(parts.faces == number).tolist()}
            for number, branch in enumerate(skeleton.branches)
        ],
    }
    stream.write(json.dumps(found, separators=(",", ":"), allow_nan=False).encode("ascii"))
    stream.write(b"\n")


SKELETON_FORMATS: dict[str, Callable[[Skeleton, Parts, BinaryIO], None]] = {
    ".swc": _write_swc,
    ".obj": _write_obj,
    ".json": _write_json,
}
