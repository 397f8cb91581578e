# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads points from files, with normals and polygons if a file has them (docs/formats.md)."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from ..errors import OutOfMemoryError, ReadError
from .dae import read_dae
from .imported_points import ImportedPoints
from .numpy_arrays import read_npy, read_npz
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .stl import read_stl
from .xyz import read_xyz, read_xyzn

READERS: dict[str, Callable[[Path], ImportedPoints]] = {
    ".xyz": read_xyz,
    ".xyzn": read_xyzn,
    ".off": read_off,
    ".ply": read_ply,
    ".obj": read_obj,
    ".stl": read_stl,
    ".dae": read_dae,
    ".npy": read_npy,
    ".npz": read_npz,
}


def import_points(path: str | os.PathLike) -> ImportedPoints:
    """Read points, and normals and polygons if the file has them; the extension chooses the format.

    Raises
    ------
    ReadError
        The extension is unknown, the system refuses, or the content is invalid; all or nothing is read.
    OutOfMemoryError
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise ReadError(
            f"Expected a file name that ends in {', '.join(READERS)}, found '{path.name or path}'; "
            "choose another file"
        )
    try:
        return READERS[suffix](path)
    except MemoryError as error:
        raise OutOfMemoryError(
            f"Expected enough memory for the points of '{path.name}', found too little; "
            "close other programs or use fewer points"
        ) from error
