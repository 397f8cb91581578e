# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads `.xyz` and `.xyzn` files: each line has a point, x y z, then nx ny nz (docs/formats.md)."""

from __future__ import annotations

import os
import re

from ..arrays import Floats
from ..errors import ReadError
from .imported_points import ImportedPoints, are_normals, left_out
from .text import Lines, is_number, open_lines


def read_xyz(path: str | os.PathLike) -> ImportedPoints:
    """Read points; columns 4 to 6 are normals if `are_normals` accepts them, for some files have colours there."""
    table = _read_table(path, 3, "x y z")
    normals = table[:, 3:6] if table.shape[1] >= 6 and are_normals(table[:, 3:6]) else None
    return _found(table, normals)


def read_xyzn(path: str | os.PathLike) -> ImportedPoints:
    """Read points; columns 4 to 6 are normals, because the extension says so."""
    table = _read_table(path, 6, "x y z nx ny nz")
    return _found(table, table[:, 3:6])


def _read_table(path: str | os.PathLike, least: int, what: str) -> Floats:
    """Return the points, (n, k); a count and a title may precede them."""
    with open_lines(path) as lines:
        stated = _skip_count(lines)
        _skip_title(lines, stated)
        rows = lines.rows(delimiter=next((mark for mark in ";," if mark in lines.line), ""))
    if len(rows) == 0:
        raise ReadError(f"Expected points, found none in '{rows.name}'; choose another file")
    if stated is not None and stated != len(rows):
        raise ReadError(
            f"Expected {stated} points, as '{rows.name}' says in its first line, found {len(rows)}; "
            "take the file from its source again, or remove that line"
        )
    return rows.table(least, what)


def _skip_count(lines: Lines) -> int | None:
    """Return the number of points if the first line has only that, otherwise None."""
    word = lines.line.strip()
    if not re.fullmatch("[0-9]{1,18}", word):
        return None
    lines.advance()
    return int(word)


def _skip_title(lines: Lines, stated: int | None) -> None:
    """Skip a line of column names; after a count, as in files of molecules, the line may have any words."""
    words = re.findall(r"[^\s,;]+", lines.line)
    numbers = sum(map(is_number, words))
    if words and (numbers == 0 if stated is None else numbers < len(words)):
        lines.advance()


def _found(table: Floats, normals: Floats | None) -> ImportedPoints:
    columns = table.shape[1]
    if normals is None and columns >= 6:
        why = (
            "columns 4 to 6 are not all of length 1, with negative numbers too, so that they may be "
            "colours; name the file .xyzn if they are normals"
        )
        warnings = left_out(columns, normals, why)
    else:
        warnings = left_out(columns, normals)
    return ImportedPoints(table[:, :3], normals, warnings=tuple(warnings))
