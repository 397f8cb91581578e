# SPDX-License-Identifier: GPL-3.0-or-later
"""This module holds and checks the contents of a file of points."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..errors import ReadError


@dataclass(frozen=True, eq=False)
class ImportedPoints:
    """This is the content of a file: points, and its normals, faces and warnings if there are any."""

    vertices: Floats  # (n, 3) They are finite, and in the order of the file; none are merged
    normals: Floats | None = None  # (n, 3) They have any length; a point without a normal has zero
    # (f + 1,) Face i has the corners `face_vertices[face_offsets[i]:face_offsets[i + 1]]`, at least three
    face_offsets: Ints = field(default_factory=lambda: np.zeros(1, np.int32))
    # (c,) Rows of `vertices`
    face_vertices: Ints = field(default_factory=lambda: np.zeros(0, np.int32))
    warnings: tuple[str, ...] = ()  # Each sentence names a part of the file that was not read
    single: bool = False  # The file has the coordinates as float32

    @property
    def faces(self) -> int:
        return len(self.face_offsets) - 1


def checked(
    name: str,
    vertices: NDArray,
    normals: NDArray | None = None,
    sizes: NDArray | None = None,
    corners: NDArray | None = None,
) -> ImportedPoints:
    """Check the content of a file, and return it as points.

    Parameters
    ----------
    name : str
        The name of the file, for messages.
    vertices, normals : (n, 3)
    sizes : (f,)
        The number of corners of each face; faces with fewer than three are left out.
    corners : (sum of sizes,)
        The corners, face after face.
    """
    if len(vertices) == 0:
        raise ReadError(f"Expected points, found none in '{name}'; choose another file")
    vertices, normals = _as_float64(vertices), None if normals is None else _as_float64(normals)
    _check_finite(name, "point", vertices)
    _check_finite(name, "normal", vertices[:0] if normals is None else normals)
    sizes = np.zeros(0, np.int64) if sizes is None else sizes.astype(np.int64)
    corners = np.zeros(0, np.int64) if corners is None else corners
    kept = sizes >= 3
    corners = corners[np.repeat(kept, sizes)]
    bad = np.flatnonzero(~((corners >= 0) & (corners < len(vertices))))  # NaN is bad, too
    if len(bad):
        raise ReadError(
            f"Expected corners from 0 to {len(vertices) - 1} in '{name}', found "
            f"{corners[bad[0]]}; take the file from its source again"
        )
    left = int(np.count_nonzero(~kept))
    return ImportedPoints(
        vertices,
        normals,
        np.concatenate([[0], np.cumsum(sizes[kept])]).astype(np.int32),
        corners.astype(np.int32),
        (f"Left out faces of fewer than three corners: {left:,}",) if left else (),
    )


def _as_float64(rows: NDArray) -> Floats:
    """Return the rows as float64; numbers that are too large for it become infinite."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.ascontiguousarray(rows, np.float64)


def _check_finite(name: str, what: str, rows: NDArray) -> None:
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise ReadError(
            f"Expected finite numbers in '{name}', found {rows[bad[0]].tolist()} as {what} "
            f"{bad[0]}, counted from 0; mend or remove it"
        )


def are_normals(vectors: Floats) -> bool:
    """Return whether vectors look like normals: each has length 1, up to two digits of text, or 0 for no normal.

    At least one component must be negative, as on every closed surface and in no colour.
    """
    if (np.abs(vectors) > 2.0).any():  # squares of large numbers are infinite
        return False
    lengths = np.linalg.norm(vectors, axis=1)
    unit = np.abs(lengths - 1.0) <= 0.01
    return bool((unit | (lengths == 0.0)).all() and (vectors < 0.0).any())


def left_out(
    columns: int, normals: Floats | None, why: str = "only positions and normals are read"
) -> list[str]:
    """Return a warning if a file has more columns than are read, otherwise an empty list."""
    left = columns - (3 if normals is None else 6)
    return [f"Left out {left} of {columns} columns: {why}"] if left else []
