# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads `.off` files: points and polygons, as text or binary (docs/formats.md).

The header is OFF, NOFF, COFF, STOFF or a combination of these.
"""

from __future__ import annotations

import os
import re

import numpy as np

from ..arrays import Floats, Ints
from ..errors import ReadError
from .imported_points import ImportedPoints, are_normals, left_out
from .off_binary import read_off_binary
from .text import Lines, Rows, open_lines

_HEADER = re.compile(r"(?:ST|C|N)*OFF")


def read_off(path: str | os.PathLike) -> ImportedPoints:
    """Read points, normals and polygons; colours and texture coordinates are ignored."""
    with open_lines(path) as lines:
        kind = _read_header(lines)
        if lines.line.split()[:1] != ["BINARY"]:
            return _read_text(lines, kind)
    return read_off_binary(path, kind)


def _read_text(lines: Lines, kind: str) -> ImportedPoints:
    points, faces = _read_counts(lines)
    rows = lines.rows()
    if points == 0:
        raise ReadError(f"Expected points, found none in '{lines.name}'; choose another file")
    if len(rows) != points + faces:
        raise ReadError(
            f"Expected {points} lines of points and {faces} of faces in '{lines.name}', as its header "
            f"says, found {len(rows)} lines; take the file from its source again"
        )
    least, what = (6, "x y z nx ny nz") if "N" in kind else (3, "x y z")
    table = rows.part(0, points).table(least, what)
    normals = _normals(table, "C" in kind, lines.name) if "N" in kind else None
    offsets, corners, small = _read_faces(rows.part(points, points + faces), points)
    warnings = left_out(table.shape[1], normals)
    if small:
        warnings.append(f"Left out faces of fewer than three corners: {small:,}")
    return ImportedPoints(table[:, :3], normals, offsets, corners, tuple(warnings))


def _read_header(lines: Lines) -> str:
    """Return the letters before OFF, such as CN; the rest of the line stays to be read."""
    keyword, *rest = lines.line.split() or [""]
    if not _HEADER.fullmatch(keyword):
        raise ReadError(
            f"Expected OFF, NOFF, COFF or STOFF in {lines.place()}, found {keyword[:24]!a}; "
            "only OFF files in three dimensions are read"
        )
    lines.line = " ".join(rest)
    if not rest:
        lines.advance()
    return keyword.removesuffix("OFF")


def _read_counts(lines: Lines) -> tuple[int, int]:
    """Return the numbers of points and faces; the number of edges is not used."""
    words = lines.line.split()
    if len(words) not in (2, 3) or not all(re.fullmatch("[0-9]{1,18}", word) for word in words):
        raise ReadError(
            f"Expected the numbers of points, faces and edges in {lines.place()}, "
            f"found {lines.line.strip()[:24]!a}; mend that line"
        )
    lines.advance()
    return int(words[0]), int(words[1])


def _normals(table: Floats, coloured: bool, name: str) -> Floats:
    """Return columns 4 to 6. If there are colours, Geomview writes the normals before them and MeshLab after them."""
    if not coloured:
        return table[:, 3:6]
    places = (table[:, first : first + 3] for first in (3, 6, 7))
    found = next((x for x in places if x.shape[1] == 3 and are_normals(x)), None)
    if found is None:
        raise ReadError(
            f"Expected normals of length 1 beside the colours in '{name}', found none; "
            "save it without colours"
        )
    return found


def _read_faces(rows: Rows, points: int) -> tuple[Ints, Ints, int]:
    """Return offsets and corners of the polygons, and the number of faces left out for fewer than three corners.

    A line holds the number of corners, the corners, and perhaps a colour.
    """
    sizes, corners = rows.lists()
    kept = np.flatnonzero(sizes >= 3)
    corners = corners[np.repeat(sizes >= 3, sizes)]
    offsets = np.concatenate([[0], np.cumsum(sizes[kept])])
    bad = np.flatnonzero((corners != np.floor(corners)) | (corners < 0) | (corners >= points))
    if len(bad):
        face = kept[np.searchsorted(offsets, bad[0], side="right") - 1]
        raise ReadError(
            f"Expected corners from 0 to {points - 1} in {rows.place(face)}, "
            f"found {corners[bad[0]]:.17g}; mend that line"
        )
    return offsets.astype(np.int32), corners.astype(np.int32), len(rows) - len(kept)
