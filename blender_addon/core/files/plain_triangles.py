# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes medial axes as triangles in text: all common readers read these `.ply`, `.obj` and `.off` alike.

Some readers assume that all faces of a binary PLY are as large as the first, some accept no numbers besides the corners
there, and some tear polygons (docs/formats.md has the table). All of them read triangles in text. In `.ply` a triangle
has the values of its facet and the number of the facet, so the polygons can be put together again.

Edges without a facet are lines of the `.obj`, which all readers read or skip. In `.ply` and `.off` some readers refuse
them and some take them for faces, so these files omit them, and `left_out` reports it.
"""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Longs
from ..axis.polygon_triangles import axis_triangles
from ..errors import ExportError
from . import write_triangles
from .writing import Columns, ply_places, ply_properties, write_rows


def left_out(axis: Any) -> str:
    """Return a warning about the parts of an axis that `.ply` and `.off` do not hold; "" where there are none."""
    edges, alone = len(axis.edges), len(lone_vertices(axis))
    if not edges and not alone:
        return ""
    parts = (
        f"{edges:,} edges without a facet" if edges else "",
        f"{alone:,} lone vertices" if alone else "",
    )
    return (
        f"Triangles in .ply and .off have no place for {' and '.join(filter(None, parts))}, which are left out; "
        "write .obj, or leave out --triangles"
    )


def comment_of(axis: Any, mark: str) -> str:
    """Return a line after a mark that says which places the vertices of a level have; "" for an axis as published."""
    return "" if axis.level is None else f"{mark} {axis.level.places}\n"


def lone_vertices(axis: Any) -> NDArray[np.intp]:
    """Return the vertices without a facet and without an edge, (k,)."""
    alone = np.ones(len(axis.vertices), bool)
    alone[axis.face_vertices] = alone[axis.edges.ravel()] = False
    return np.flatnonzero(alone)


def write_lines(axis: Any, stream: BinaryIO) -> None:
    """Write the parts of an axis that OBJ has besides faces: edges without a facet, and lone vertices."""
    write_rows(stream, "l %d %d\n", axis.edges + 1)
    write_rows(stream, "p %d\n", lone_vertices(axis) + 1)


def write_ply(axis: Any, stream: BinaryIO) -> None:
    _require_facets(axis)
    triangles, facet = _triangles(axis)
    vertices: Columns = {**ply_places(axis.vertices), "radius": ("<f8", axis.radius)}
    faces: Columns = {name: ("<f8", getattr(axis, name)[facet]) for name in ("theta", "rho")}
    p, q = axis.generators[facet].T
    whole = {"side": axis.side[facet], "generator_p": p, "generator_q": q, "facet": facet}
    faces |= {name: ("<i4", column) for name, column in whole.items()}
    header = f"""ply
format ascii 1.0
comment medial axis: radius of the empty ball per vertex, angles in radians
{comment_of(axis, "comment")}element vertex {len(axis.vertices)}
{ply_properties(vertices)}element face {len(triangles)}
property list uchar int vertex_indices
{ply_properties(faces)}end_header
"""
    stream.write(header.encode("ascii"))
    write_rows(stream, "%.17g %.17g %.17g %.17g\n", axis.vertices, axis.radius)
    row = "3 %d %d %d %.17g %.17g %d %d %d %d\n"
    write_rows(stream, row, triangles, *(column for _, column in faces.values()))


def write_obj(axis: Any, stream: BinaryIO) -> None:
    stream.write(comment_of(axis, "#").encode("ascii"))
    write_triangles.write_obj(axis.vertices, _triangles(axis)[0], stream)
    write_lines(axis, stream)


def write_off(axis: Any, stream: BinaryIO) -> None:
    _require_facets(axis)
    write_triangles.write_off(axis.vertices, _triangles(axis)[0], stream)


def _require_facets(axis: Any) -> None:
    if len(axis.face_offsets) == 1 and len(axis.vertices):
        raise ExportError(
            f"Expected facets to write as triangles, found {len(axis.edges):,} edges and "
            f"{len(lone_vertices(axis)):,} lone vertices alone; write .obj, or leave out --triangles"
        )


def _triangles(axis: Any) -> tuple[Ints, Longs]:
    """Return the triangles, (t, 3), and the facet of each, (t,)."""
    triangles = axis_triangles(axis)
    facets = len(axis.face_offsets) - 1
    return triangles, np.repeat(np.arange(facets), np.diff(axis.face_offsets) - 2)
