# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension of a file name chooses the format."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from ..errors import ExportError


def extension_of(path: str | os.PathLike, known: Iterable[str]) -> str:
    """Return the extension of `path` in lower case, which must be one of the known extensions."""
    suffix = Path(path).suffix.lower()
    if suffix not in known:
        raise ExportError(
            f"Expected a file name that ends in {listed(known)}, found '{Path(path).name}'; "
            "add one of these extensions"
        )
    return suffix


def listed(extensions: Iterable[str]) -> str:
    """Return the extensions as a list for messages, such as '.ma, .ply, ... or .npz'."""
    *first, last = extensions
    return f"{', '.join(first)} or {last}" if first else last
