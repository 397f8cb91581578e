# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes rows of numbers as lines of text."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

CHUNK = 1 << 16  # this many rows are formatted at once, which bounds the memory of one write


def write_rows(stream: BinaryIO, row: str, *columns: NDArray) -> None:
    """Write one line per row of `columns`, (n,) or (n, k) arrays; `row` is the %-format of one line."""
    for start in range(0, len(columns[0]), CHUNK):
        parts = [column[start : start + CHUNK] for column in columns]
        table = np.column_stack(parts)
        stream.write(((row * len(table)) % tuple(table.ravel().tolist())).encode("ascii"))
