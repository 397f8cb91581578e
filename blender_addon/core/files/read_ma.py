# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads medial axes of balls, triangles and edges from `.ma` files of any tool (docs/formats.md)."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..axis.medial_axis import MedialAxis, without_samples
from ..errors import ReadError
from .text import open_file, skip_mark

_WIDTHS = {b"v": 4, b"e": 2, b"f": 3}


def read_ma(path: str | os.PathLike) -> MedialAxis:
    """Read vertices, radii, triangles, and the edges that are on no triangle.

    The file has no other values of an axis: `generators` are -1, `theta` and `rho` are infinite.

    Raises
    ------
    ReadError
        The file is not a `.ma` file, or contradicts itself.
    """
    name = Path(path).name
    with open_file(path) as stream:
        skip_mark(stream)
        header, *lines = _lines(stream.read()) or [(1, [])]
    counts = _counts(header, name)
    if len(lines) != sum(counts):
        raise ReadError(
            f"Expected {sum(counts)} lines after the header of '{name}', found {len(lines)}; "
            "take the file from its source again"
        )
    ends = np.cumsum(counts)
    vertices, edges, triangles = (
        _table(lines[end - count : end], kind, name)
        for kind, count, end in zip(_WIDTHS, counts, ends, strict=True)
    )
    pairs, corners = _ids(edges, counts[0], name), _ids(triangles, counts[0], name)
    if (vertices[:, 3] < 0).any():
        raise ReadError(f"Expected radii of 0 or more in '{name}', found a negative one; mend it")
    offsets = np.arange(0, 3 * len(corners) + 1, 3, dtype=np.int32)
    places, radius = (np.ascontiguousarray(part) for part in (vertices[:, :3], vertices[:, 3]))
    return without_samples(places, radius, offsets, corners.reshape(-1), _alone(pairs, corners))


def _lines(content: bytes) -> list[tuple[int, list[bytes]]]:
    """Return the words of lines that are neither blank nor comment, with their numbers."""
    split = ((i + 1, line.split()) for i, line in enumerate(content.splitlines()))
    return [(i, words) for i, words in split if words and not words[0].startswith(b"#")]


def _counts(header: tuple[int, list[bytes]], name: str) -> list[int]:
    number, words = header
    if len(words) != 3 or not all(word.isdigit() for word in words):
        raise ReadError(
            f"Expected the numbers of vertices, edges and triangles in line {number} of '{name}', "
            f"found {b' '.join(words)[:24]!a}; choose a .ma file as Q-MAT writes it"
        )
    return [int(word) for word in words]


def _table(lines: list[tuple[int, list[bytes]]], kind: bytes, name: str) -> Floats:
    width = _WIDTHS[kind]
    rows = [_row(words, kind, width) for _, words in lines]
    if None in rows:
        raise ReadError(
            f"Expected '{kind.decode()}' and {width} finite numbers in line "
            f"{lines[rows.index(None)][0]} of '{name}', found something else; take the file from its source again"
        )
    return np.array(rows, np.float64).reshape(-1, width)


def _row(words: list[bytes], kind: bytes, width: int) -> list[float] | None:
    """Return the numbers of a line, or None if the line is invalid."""
    if len(words) <= width or words[0] != kind:
        return None
    try:
        row = [float(word) for word in words[1 : width + 1]]
    except ValueError:
        return None
    return row if all(map(math.isfinite, row)) else None


def _ids(rows: Floats, vertices: int, name: str) -> Ints:
    inside = (rows >= 0) & (rows < vertices) & (rows == np.floor(rows))
    if not inside.all():
        raise ReadError(
            f"Expected edges and triangles between {vertices} vertices in '{name}', found "
            f"{rows[~inside][0]:g}; vertices count from 0"
        )
    return rows.astype(np.int32)


def _alone(pairs: Ints, corners: Ints) -> Ints:
    """Return the edges that are on no triangle, i < j, each once, ascending, (w, 2)."""
    sides = np.sort(corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    found = set(map(tuple, sides.tolist()))
    alone = sorted({tuple(sorted(pair)) for pair in pairs.tolist()} - found)
    return np.array(alone, np.int32).reshape(-1, 2)
