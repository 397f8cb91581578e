# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads `.stl` files, which hold triangles as text or binary (docs/formats.md).

Binary files may begin with the first word of text, and text with anything, so the content decides.
"""

from __future__ import annotations

import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..arrays import Floats, Longs
from ..errors import ReadError
from .imported_points import ImportedPoints, checked
from .text import open_file

_HEADER = 84  # the triangles of a binary file begin after this many bytes; the last four give their number
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("colour", "<u2")])
_IS_TEXT = re.compile(rb"(?i)\b(?:solid|facet)\b")
_VERTEX = re.compile(rb"(?i)\bvertex\s+(\S+)\s+(\S+)\s+(\S+)")


def read_stl(path: str | os.PathLike) -> ImportedPoints:
    """Read triangles; corners with equal coordinates become one point, in the order of the file."""
    name = Path(path).name
    with open_file(path) as stream:
        data = stream.read()
    count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
    beyond = len(data) - _HEADER - count * _TRIANGLE.itemsize
    # Letters in its place make a count that no text is long enough for.
    if len(data) >= _HEADER and beyond >= 0:
        corners = np.frombuffer(data, _TRIANGLE, count, _HEADER)["corners"].reshape(-1, 3)
    elif _IS_TEXT.search(data) and b"\0" not in data:
        corners, beyond = _read_text(data, name), 0
    else:
        raise ReadError(
            f"Expected 'solid' and facets as text in '{name}', or {count:,} triangles as its header "
            f"says, found {len(data):,} bytes; take the file from its source again"
        )
    points, rows = _merged(corners.astype(np.float64))
    found = checked(name, points, None, np.full(len(rows) // 3, 3), rows)
    left = (f"Left out {beyond:,} bytes after the triangles",) if beyond else ()
    # Its text comes from programs that store float32, too.
    return replace(found, warnings=found.warnings + left, single=True)


def _read_text(data: bytes, name: str) -> Floats:
    words = _VERTEX.findall(data)
    if len(words) % 3 or len(words) != 3 * len(re.findall(rb"(?i)\bendfacet\b", data)):
        raise ReadError(
            f"Expected three corners of each facet in '{name}', found {len(words):,} corners in "
            "all; take the file from its source again"
        )
    try:
        return np.array(words).astype(np.float64).reshape(-1, 3)
    except ValueError as error:
        raise ReadError(
            f"Expected three numbers after each 'vertex' in '{name}', but {error}; mend that line"
        ) from error


def _merged(corners: Floats) -> tuple[Floats, Longs]:
    """Return the distinct rows in the order in which they appear first, and the row of each corner."""
    if len(corners) == 0:
        return corners, np.zeros(0, np.int64)
    corners = corners + 0.0  # -0 is 0
    _, first, inverse = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    return corners[first[order]], place[inverse.ravel()]
