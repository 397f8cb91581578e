# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads `.obj` files, which hold points and polygons as text (docs/formats.md)."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..errors import ReadError
from .imported_points import ImportedPoints, checked
from .text import open_text

_MOST = 1 << 31  # a file can have at most this many points


def read_obj(path: str | os.PathLike) -> ImportedPoints:
    """Read points and faces. Normals are read only if there are no faces and one normal for each point, as in scans.

    In files with faces a normal belongs to a corner, and a point has several corners.
    """
    name = Path(path).name
    points: list[list[float]] = []
    normals: list[list[float]] = []
    sizes: list[int] = []
    corners: list[int] = []
    with open_text(path) as stream:
        for number, words in _statements(stream):
            try:
                if words[0] == "v":
                    points.append(_three(words))
                elif words[0] == "vn":
                    normals.append(_three(words))
                elif words[0] == "f":
                    face = [_corner(word, len(points)) for word in words[1:]]
                    sizes.append(len(face))
                    corners += face
            except ValueError:
                raise ReadError(
                    f"Expected numbers after '{words[0]}' in line {number} of '{name}', found "
                    f"{' '.join(words[1:])[:24]!a}; mend that line"
                ) from None
    of_points = bool(points) and len(normals) == len(points) and not sizes
    return checked(
        name,
        np.array(points, np.float64).reshape(-1, 3),
        np.array(normals, np.float64) if of_points else None,
        np.array(sizes, np.int64),
        np.array(corners, np.int64),
    )


def _statements(stream: Iterator[str]) -> Iterator[tuple[int, list[str]]]:
    """Yield the words of every statement with the number of its last line; a backslash continues a line."""
    begun = ""
    for number, line in enumerate(stream, 1):
        begun += line.partition("#")[0].rstrip()
        if begun.endswith("\\"):
            begun = begun[:-1] + " "
            continue
        words = begun.split()
        begun = ""
        if words:
            yield number, words


def _three(words: list[str]) -> list[float]:
    """Return x y z; weights and colours after them are ignored."""
    if len(words) < 4:
        raise ValueError
    return [float(word) for word in words[1:4]]


def _corner(word: str, points: int) -> int:
    """Return the row of the point of a corner: '7/2/3' is the seventh point, '-1' the last one so far."""
    corner = int(word.partition("/")[0])
    if abs(corner) > _MOST:
        raise ValueError
    return corner - 1 if corner > 0 else points + corner if corner < 0 else -1
