# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes the parts of a medial axis as a table, `.csv` (docs/formats.md)."""

from __future__ import annotations

from typing import Any, BinaryIO

from ..axis.medial_axis import MedialAxis
from ..axis.structure_table import COLUMNS, rows_of
from ..errors import ExportError


def write_csv(axis: MedialAxis, stream: BinaryIO) -> None:
    """Write a row for each part; lists of numbers are separated by spaces.

    Raises
    ------
    ExportError
        The axis has no parts, as an axis as published or a curve.
    """
    structure = axis.structure
    if structure is None:
        raise ExportError(
            "Expected a medial axis with sheets for a table of parts, found one without; "
            "compute the form Clean of the inner axis"
        )
    stream.write((",".join(COLUMNS) + "\n").encode("ascii"))
    for row in rows_of(structure):
        stream.write((",".join(_text(row[name]) for name in COLUMNS) + "\n").encode("ascii"))


def _text(value: Any) -> str:
    if isinstance(value, list):
        return " ".join(map(str, value))
    return f"{value:.17g}" if isinstance(value, float) else str(value)
