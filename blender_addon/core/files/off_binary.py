# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads binary `.off` files, as Geomview, CGAL and pmp write them (docs/formats.md).

After the first line come the numbers of points, faces and edges, the points, and for each face the number of its
corners and the corners. Geomview's format has the most significant byte first, 32 bits, and colours after each face.
Other programs write the bytes as they are in memory, floats of 64 bits, or no colours. Only one of these readings ends
where the file ends.
"""

from __future__ import annotations

import itertools
import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..arrays import Longs
from ..errors import ReadError
from .imported_points import ImportedPoints, checked
from .text import open_file, skip_mark

_COUNTS = 3  # the numbers of points, faces and edges
_COLUMNS = {"N": 3, "C": 4, "ST": 2}  # the numbers of a point besides its position, in this order
_WORD = 4  # bytes of a whole number


def read_off_binary(path: str | os.PathLike, kind: str) -> ImportedPoints:
    """Read points, normals and polygons; `kind` has the letters before OFF, such as CN."""
    name = Path(path).name
    with open_file(path) as stream:
        skip_mark(stream)
        stream.readline()
        data = stream.read()
    columns = 3 + sum(count for letter, count in _COLUMNS.items() if letter in kind)
    for order, size, coloured in itertools.product("><", (4, 8), (True, False)):
        found = _read(data, order, size, columns, coloured)
        if found is not None:
            table, sizes, corners = found
            normals = table[:, 3:6] if "N" in kind else None
            return checked(name, table[:, :3], normals, sizes, corners)
    raise ReadError(
        f"Expected the points and faces that the counts in '{name}' announce, found {len(data):,} bytes, which are "
        "more or less; take the file from its source again, or save it as text"
    )


def _read(
    data: bytes, order: str, size: int, columns: int, coloured: bool
) -> tuple[NDArray, Longs, Longs] | None:
    """Return the points, (n, columns), and the sizes and corners of the faces; None where it is written otherwise."""
    if len(data) < _COUNTS * _WORD:
        return None
    points, faces, _ = np.frombuffer(data, order + "i4", _COUNTS).tolist()
    end = _COUNTS * _WORD + points * columns * size
    if min(points, faces) < 0 or len(data) < end + faces * _WORD or (len(data) - end) % _WORD:
        return None
    table = np.frombuffer(data, f"{order}f{size}", points * columns, _COUNTS * _WORD)
    words = np.frombuffer(data, order + "i4", offset=end).astype(np.int64)
    starts = _starts(words.tolist(), faces, coloured)
    if starts is None:
        return None
    sizes = words[starts]
    first = np.repeat(starts + 1 - (np.cumsum(sizes) - sizes), sizes)
    return table.reshape(points, columns), sizes, words[first + np.arange(len(first))]


def _starts(words: list[int], faces: int, coloured: bool) -> Longs | None:
    """Return where each face begins; None where the last one does not end with the words."""
    starts, at = [], 0
    for _ in range(faces):
        starts.append(at)
        for _ in range(1 + coloured):
            if at >= len(words) or words[at] < 0:
                return None
            at += 1 + words[at]
    return np.array(starts, np.int64) if at == len(words) else None
