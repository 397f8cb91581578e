"""Points from files: `.xyz`, `.xyzn` and `.off` (docs/formats.md)."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from .errors import OutOfMemoryError, ReadError
from .import_off import read_off
from .import_result import ImportedPoints
from .import_text import Lines, open_lines
from .import_xyz import read_xyz, read_xyzn

READERS: dict[str, Callable[[Lines], ImportedPoints]] = {
    ".xyz": read_xyz,
    ".xyzn": read_xyzn,
    ".off": read_off,
}


def import_points(path: str | os.PathLike) -> ImportedPoints:
    """Read points, and normals and polygons where the file has them; the extension says which kind it is.

    Raises
    ------
    ReadError
        Unknown extension, the system refuses, or the file is not what it says; all or nothing is read.
    OutOfMemoryError
    """
    suffix = Path(path).suffix.lower()
    if suffix not in READERS:
        raise ReadError(
            f"Expected a file name that ends in {', '.join(READERS)}, found '{Path(path).name}'; "
            "choose another file"
        )
    try:
        with open_lines(path) as lines:
            return READERS[suffix](lines)
    except MemoryError as error:
        raise OutOfMemoryError(
            f"Expected enough memory for the points of '{Path(path).name}', found too little; "
            "close other programs or use fewer points"
        ) from error
