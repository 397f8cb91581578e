# SPDX-License-Identifier: GPL-3.0-or-later
"""All writers share this: formats by extension, whole files, and rows of numbers as text or PLY."""

from __future__ import annotations

import math
import os
import secrets
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..errors import ExportError

CHUNK = 1 << 16  # this many rows are formatted at once, which bounds the memory of one write
Columns = dict[str, tuple[str, NDArray]]  # {property: (its type for NumPy, (n,) values)}
_PLY_TYPES = {"<f8": "double", "<f4": "float", "<i4": "int", "u1": "uchar"}


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


def known(figure: float | None) -> float | None:
    """Return a figure for JSON, or None where there is none, or it is infinite or not a number, which JSON has not."""
    return figure if figure is not None and math.isfinite(figure) else None


def write_whole(path: str | os.PathLike, write: Callable[[BinaryIO], object]) -> Path:
    """Write a file next to its target, and rename it: it appears whole or not at all.

    Parameters
    ----------
    path : path of the file; a link is followed
    write : callable
        It writes the content to the given binary stream.

    Returns
    -------
    path : Path
        The path with links resolved.

    Raises
    ------
    ExportError
        The system refused to write; an old file is then unchanged.
    """
    target = Path(os.path.realpath(path))
    temporary = target.parent / f".medial_axis_{secrets.token_hex(8)}.tmp"
    try:
        if target.exists() and not target.is_file():
            raise ExportError(
                f"Expected the name of a file, found '{path}', which is not one; choose another name"
            )
        try:
            with open(temporary, "xb") as stream:
                write(stream)
                stream.flush()
                os.fsync(stream.fileno())
            os.replace(temporary, target)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except ExportError:
        raise
    except OSError as error:
        raise ExportError(
            f"Expected to write '{path}', but the system says '{error.strerror or error}'; "
            "choose another folder or free some space (no file was changed)"
        ) from error
    return target


def write_rows(stream: BinaryIO, row: str, *columns: NDArray) -> None:
    """Write one line per row of `columns`, (n,) or (n, k) arrays; `row` is the %-format of one line."""
    for start in range(0, len(columns[0]), CHUNK):
        parts = [column[start : start + CHUNK] for column in columns]
        table = np.column_stack(parts)
        stream.write(((row * len(table)) % tuple(table.ravel().tolist())).encode("ascii"))


def write_ply(
    stream: BinaryIO, vertices: Columns, triangles: Ints, of_faces: Columns, comment: str = ""
) -> None:
    """Write triangles, (t, 3), as binary PLY with values of vertices and faces; a comment is a line of the header."""
    corners: Columns = {
        name: ("<i4", column) for name, column in zip("abc", triangles.T, strict=True)
    }
    count, places = ("u1", np.full(len(triangles), 3)), ply_rows(vertices)
    header = f"""ply
format binary_little_endian 1.0
{comment}element vertex {len(places)}
{ply_properties(vertices)}element face {len(triangles)}
property list uchar int vertex_indices
{ply_properties(of_faces)}end_header
"""
    stream.write(header.encode("ascii"))
    stream.write(places.tobytes())
    stream.write(ply_rows({"n": count, **corners, **of_faces}).tobytes())


def ply_places(points: Floats) -> Columns:
    """Return the columns of (n, 3) points."""
    return {name: ("<f8", column) for name, column in zip("xyz", points.T, strict=True)}


def ply_properties(columns: Columns) -> str:
    """Return the lines of a header that announce columns."""
    return "".join(f"property {_PLY_TYPES[kind]} {name}\n" for name, (kind, _) in columns.items())


def ply_rows(columns: Columns) -> NDArray:
    """Return the rows of an element, (n,)."""
    (_, first), *_ = columns.values()
    rows = np.empty(len(first), [(name, kind) for name, (kind, _) in columns.items()])
    for name, (_, column) in columns.items():
        rows[name] = column
    return rows
