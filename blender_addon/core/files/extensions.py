# SPDX-License-Identifier: GPL-3.0-or-later
"""Extensions of file names, by which formats are chosen."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from ..errors import ExportError


def extension_of(path: str | os.PathLike, known: Iterable[str]) -> str:
    """The extension of `path` in small letters, one of those that are known.

    Raises
    ------
    ExportError
    """
    suffix = Path(path).suffix.lower()
    if suffix not in known:
        raise ExportError(
            f"Expected a file name that ends in {listed(known)}, found '{Path(path).name}'; "
            "add one of these extensions"
        )
    return suffix


def listed(extensions: Iterable[str]) -> str:
    """'.ma, .ply, ... or .npz', for messages."""
    *first, last = extensions
    return f"{', '.join(first)} or {last}"
