# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes triangles as `.stl`, `.ply`, `.obj` and `.off`; a file appears whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..arrays import Floats, Ints
from ..shape.triangles import unit_normals
from ..small_matrices import placed
from .rounding import check_stl
from .writing import extension_of, ply_places, write_ply, write_rows, write_whole


def export_triangles(
    points: Floats, triangles: Ints, path: str | os.PathLike[str], frame: Floats, length: float
) -> Path:
    """Write triangles, and return the path of the file; the extension of `path` chooses the format.

    Parameters
    ----------
    points : (v, 3) float64
    triangles : (t, 3) int32
    path : path of the file; its folder must exist. A file of that name is replaced.
    frame : (4, 4) float64
        From the points to the world.
    length : float
        The wall, or what else the triangles have to show, in the units of the points.

    Raises
    ------
    ExportError
        The extension is unknown, `.stl` is too coarse so far from the origin, or the system refused to write; an old
        file is then unchanged.
    """
    suffix = extension_of(path, TRIANGLE_FORMATS)
    write, world = TRIANGLE_FORMATS[suffix], placed(points, frame)
    if suffix == ".stl":
        check_stl(world, frame, length)
    return write_whole(path, lambda stream: write(world, triangles, stream))


def write_stl(points: Floats, triangles: Ints, stream: BinaryIO) -> None:
    """Write a binary `.stl`."""
    corners = points[triangles]
    facets = np.zeros(
        len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("n", "<u2")]
    )
    facets["normal"], facets["corners"] = unit_normals(corners)[0], corners
    stream.write(b"triangles".ljust(80))
    stream.write(np.uint32(len(facets)).astype("<u4").tobytes())
    stream.write(facets.tobytes())


def write_obj(points: Floats, triangles: Ints, stream: BinaryIO) -> None:
    write_rows(stream, "v %.17g %.17g %.17g\n", points)
    write_rows(stream, "f %d %d %d\n", triangles + 1)  # OBJ counts from 1


def write_off(points: Floats, triangles: Ints, stream: BinaryIO) -> None:
    stream.write(b"OFF\n%d %d 0\n" % (len(points), len(triangles)))
    write_rows(stream, "%.17g %.17g %.17g\n", points)
    write_rows(stream, "3 %d %d %d\n", triangles)


def _write_ply(points: Floats, triangles: Ints, stream: BinaryIO) -> None:
    write_ply(stream, ply_places(points), triangles, {})


TRIANGLE_FORMATS: dict[str, Callable[[Floats, Ints, BinaryIO], None]] = {
    ".stl": write_stl,
    ".ply": _write_ply,
    ".obj": write_obj,
    ".off": write_off,
}
