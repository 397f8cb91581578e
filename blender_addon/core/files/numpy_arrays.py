# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads `.npy` and `.npz` files, which hold arrays of NumPy (docs/formats.md)."""

from __future__ import annotations

import os
import tokenize
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from ..errors import ReadError
from .imported_points import ImportedPoints, checked
from .text import open_file

_UNFIT = (ValueError, ArithmeticError, EOFError, LookupError, RuntimeError, SyntaxError)
_BROKEN = (*_UNFIT, tokenize.TokenError, zipfile.BadZipFile, zlib.error)


def read_npy(path: str | os.PathLike) -> ImportedPoints:
    """Read points from an (n, 3) array, or points and normals from an (n, 6) array."""
    name = Path(path).name
    with open_file(path) as stream, refusing(name):
        table = np.lib.format.read_array(stream, allow_pickle=False)
    if table.ndim != 2 or table.shape[1] not in (3, 6) or table.dtype.kind not in "fiu":
        raise ReadError(
            f"Expected an array of numbers (n, 3) or (n, 6) in '{name}', found {table.shape} "
            f"of {table.dtype}; save points, or points and normals"
        )
    return checked(name, table[:, :3], table[:, 3:] if table.shape[1] == 6 else None)


def read_npz(path: str | os.PathLike) -> ImportedPoints:
    """Read the array `points`, and the arrays `triangles` and `normals` if they exist."""
    name = Path(path).name
    arrays = read_arrays(path, ("points", "triangles", "normals"))
    if "points" not in arrays:
        raise ReadError(f"Expected an array 'points' in '{name}', found none; save one, (n, 3)")
    for key, array in arrays.items():
        kinds = "iu" if key == "triangles" else "fiu"
        if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in kinds:
            raise ReadError(
                f"Expected {key} (n, 3) in '{name}', found {array.shape} of {array.dtype}; "
                "save it in that shape"
            )
    points, triangles, normals = arrays["points"], arrays.get("triangles"), arrays.get("normals")
    if normals is not None and normals.shape != points.shape:
        raise ReadError(
            f"Expected as many normals as points in '{name}', found {len(normals)} and "
            f"{len(points)}; save one for each"
        )
    triangles = np.zeros((0, 3), np.int64) if triangles is None else triangles
    return checked(name, points, normals, np.full(len(triangles), 3), triangles.ravel())


def points_of_cloud(path: str | os.PathLike) -> int:
    """Return the number of points that the header of a NumPy file without faces states; nothing is unpacked.

    It is 0 for other files and for broken ones: reading them reports the error.
    """
    path = Path(path)
    try:
        if path.suffix.lower() == ".npy":
            with open(path, "rb") as stream:
                return _rows(stream)
        if path.suffix.lower() == ".npz":
            with zipfile.ZipFile(path) as archive:
                if "triangles.npy" not in archive.namelist():
                    with archive.open("points.npy") as entry:
                        return _rows(entry)
    except (OSError, *_BROKEN):
        pass
    return 0


def _rows(stream: IO[bytes]) -> int:
    """Return the number of rows that the header of a two-dimensional array states, otherwise 0."""
    major = np.lib.format.read_magic(stream)[0]
    read = (
        np.lib.format.read_array_header_1_0 if major == 1 else np.lib.format.read_array_header_2_0
    )
    shape, _, _ = read(stream)
    return shape[0] if len(shape) == 2 else 0


def read_arrays(path: str | os.PathLike, names: Iterable[str]) -> dict[str, NDArray]:
    """Return the arrays of an archive that have one of the names; missing names are left out."""
    with open_file(path) as stream, refusing(Path(path).name):
        archive = np.load(stream, allow_pickle=False)
        if not isinstance(archive, np.lib.npyio.NpzFile):
            raise ValueError("this is a single array")
        with archive:
            return {name: archive[name] for name in names if name in archive}


@contextmanager
def refusing(name: str, what: str = "arrays of NumPy") -> Iterator[None]:
    """Turn an error that Python or NumPy raises for a broken file into a ReadError."""
    try:
        yield
    except _BROKEN as error:
        said = (str(error) or type(error).__name__).splitlines()[0][:99]
        raise ReadError(f"Expected {what} in '{name}', found '{said}'; save it again") from error
