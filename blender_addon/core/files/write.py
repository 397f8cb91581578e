# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes medial axes as `.ma`, `.ply`, `.obj`, `.off` and `.npz` files (docs/formats.md).

A file appears whole or not at all: it is written next to its target and renamed. Numbers in text have 17
significant digits, so that reading them back gives the same float64. Lines end in LF on every system.
"""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Longs
from ..axis.medial_axis import MedialAxis
from ..axis.polygon_triangles import axis_triangles
from ..axis.structure_table import COLUMNS, rows_of
from ..axis.turning import turned_corners
from ..errors import ExportError
from ..small_matrices import determinant, times
from . import plain_triangles
from .axis_arrays import as_arrays, exact_balls
from .placing import is_identity, parts_of
from .writing import (
    CHUNK,
    Columns,
    extension_of,
    ply_places,
    ply_properties,
    ply_rows,
    write_rows,
    write_whole,
)


@dataclass(frozen=True)
class Format:
    """A format describes one kind of file."""

    label: str  # The name that menus and file dialogs show
    write: Callable[[Any, BinaryIO], None]  # It takes the axis and a binary stream
    # It writes the axis as triangles in text; it is None if the format has no such variant
    write_triangles: Callable[[Any, BinaryIO], None] | None = None
    holds_edges: bool = True  # Whether triangles in text include edges without a facet


def export_axis(
    axis: MedialAxis,
    path: str | os.PathLike,
    transform: NDArray | None = None,
    triangles: bool = False,
) -> Path:
    """Write a medial axis, and return the path of the file; the extension of `path` chooses the format.

    Parameters
    ----------
    axis : MedialAxis
    path : path of the file; its folder must exist. A file of that name is replaced.
    transform : (3, 4) or (4, 4) float64, optional
        The world matrix of the axis. It may move, turn, mirror and scale evenly, for only then balls
        stay balls; the radii are scaled with it.
    triangles : bool
        Write .ply, .obj and .off as triangles in text, which more programs read; other formats do not change.
        Such .ply and .off files omit edges without a facet: `left_out` reports their number.

    Raises
    ------
    ExportError
        The extension is unknown, the transform does not fit, the axis has only edges and the file holds none, or
        the system refused to write; an old file is then unchanged.
    """
    known = format_of(path)
    write = (triangles and known.write_triangles) or known.write
    placed = axis if transform is None else _placed(axis, np.asarray(transform, np.float64))
    return write_whole(path, lambda stream: write(placed, stream))


def left_out(axis: MedialAxis, path: str | os.PathLike, triangles: bool) -> str:
    """Return a sentence about the parts of an axis that `export_axis` does not write; "" where it writes all."""
    known = format_of(path)
    left = triangles and known.write_triangles and not known.holds_edges
    return plain_triangles.left_out(axis) if left else ""


def format_of(path: str | os.PathLike) -> Format:
    """Return the format that the extension of `path` names."""
    return FORMATS[extension_of(path, FORMATS)]


# --- placing


def _placed(axis: MedialAxis, transform: Floats) -> MedialAxis:
    """Return the axis in world coordinates."""
    if is_identity(transform):
        return axis
    linear, offset, scale = parts_of(transform)
    corners = axis.face_vertices
    if determinant(linear) < 0:
        corners = turned_corners(axis.face_offsets, corners)
    placed = replace(
        axis,
        vertices=times(axis.vertices, linear) + offset,
        radius=axis.radius if scale == 1.0 else axis.radius * scale,
        face_vertices=corners,
        structure=axis.structure and axis.structure.scaled(scale),
    )
    if (level := axis.level) is None:
        return placed
    radius = level.exact_radius if scale == 1.0 else level.exact_radius * scale
    exact = times(level.exact, linear) + offset
    return replace(placed, level=replace(level, exact=exact, exact_radius=radius))


# --- formats


def _write_polygons(
    axis: MedialAxis, stream: BinaryIO, row_of: Callable[[int], str], least: int = 0
) -> None:
    """Write a line per facet; `row_of(count)` is its %-format for `count` corners, which count from `least`."""
    counts, tokens = np.diff(axis.face_offsets), axis.face_vertices + least
    rows = {int(count): row_of(int(count)) for count in np.unique(counts)}
    ends = np.concatenate([[0], np.cumsum(counts, dtype=np.int64)])
    for start in range(0, len(counts), CHUNK):
        chunk = counts[start : start + CHUNK].tolist()
        text = "".join([rows[count] for count in chunk])
        values = tokens[ends[start] : ends[start + len(chunk)]]
        stream.write((text % tuple(values.tolist())).encode("ascii"))


def _write_ma(axis: MedialAxis, stream: BinaryIO) -> None:
    """Write Q-MAT's plain variant: `nv ne nf`, then `v x y z r`, every edge once, and triangles."""
    vertices, radius = exact_balls(axis)
    triangles = axis_triangles(replace(axis, vertices=vertices))
    edges = _edges(triangles, axis.edges, len(vertices))
    stream.write(b"%d %d %d\n" % (len(vertices), len(edges), len(triangles)))
    write_rows(stream, "v %.17g %.17g %.17g %.17g\n", vertices, radius)
    write_rows(stream, "e %d %d\n", edges)
    write_rows(stream, "f %d %d %d\n", triangles)


def _edges(triangles: Ints, alone: Ints, vertex_count: int) -> Longs:
    """Return the edges of triangles and those without one, (e, 2), each once, i < j, in lexicographic order."""
    all_ends = np.concatenate([triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), alone])
    ends = np.sort(all_ends, axis=1).astype(np.int64)
    keys = np.unique(ends[:, 0] * vertex_count + ends[:, 1])
    return np.stack(np.divmod(keys, max(vertex_count, 1)), axis=1)


def _write_obj(axis: MedialAxis, stream: BinaryIO) -> None:
    stream.write(plain_triangles.comment_of(axis, "#").encode("ascii"))
    write_rows(stream, "v %.17g %.17g %.17g\n", axis.vertices)
    _write_polygons(axis, stream, lambda count: "f" + " %d" * count + "\n", least=1)
    plain_triangles.write_lines(axis, stream)


def _write_off(axis: MedialAxis, stream: BinaryIO) -> None:
    faces = axis.facets + len(axis.edges)
    stream.write(b"OFF\n%d %d 0\n" % (len(axis.vertices), faces))
    write_rows(stream, "%.17g %.17g %.17g\n", axis.vertices)
    _write_polygons(axis, stream, lambda count: str(count) + " %d" * count + "\n")
    write_rows(stream, "2 %d %d\n", axis.edges)  # OFF has no other edges


def _write_ply(axis: MedialAxis, stream: BinaryIO) -> None:
    counts = np.diff(axis.face_offsets)
    count_type, of_numpy = ("uchar", "u1") if counts.max(initial=0) < 256 else ("int", "<i4")
    vertices, faces, edges = _ply_columns(axis)
    header = f"""ply
format binary_little_endian 1.0
comment medial axis: radius of the empty ball per vertex, angles in radians
{plain_triangles.comment_of(axis, "comment")}element vertex {len(axis.vertices)}
{ply_properties(vertices)}element face {len(counts)}
property list {count_type} int vertex_indices
{ply_properties(faces)}element edge {len(axis.edges)}
{ply_properties(edges)}end_header
"""
    stream.write(header.encode("ascii"))
    stream.write(ply_rows(vertices).tobytes())
    for piece in _ply_faces(axis, counts, of_numpy, faces):
        stream.write(piece)
    stream.write(ply_rows(edges).tobytes())


def _ply_columns(axis: MedialAxis) -> tuple[Columns, Columns, Columns]:
    """Return the values of vertices, of faces beside their corners, and of edges."""
    vertices: Columns = {**ply_places(axis.vertices), "radius": ("<f8", axis.radius)}
    faces: Columns = {
        "theta": ("<f8", axis.theta),
        "rho": ("<f8", axis.rho),
        "side": ("<i4", axis.side),
    }
    faces |= {f"generator_{name}": ("<i4", axis.generators[:, i]) for i, name in enumerate("pq")}
    edges: Columns = {f"vertex{end + 1}": ("<i4", axis.edges[:, end]) for end in range(2)}
    if (level := axis.level) is not None:
        faces |= {"sheet": ("<f4", level.sheet), "erosion": ("<f4", level.erosion)}
        edges["limb"] = "<f4", level.limb
    if (structure := axis.structure) is not None:
        vertices["kind"], faces["part"] = ("<i4", structure.kind), ("<i4", structure.part)
    if level is not None:
        vertices["place"] = "<i4", level.place
    return vertices, faces, edges


def _ply_faces(
    axis: MedialAxis, counts: Ints, count_type: str, columns: Columns
) -> Iterator[bytes]:
    """Yield the face element in pieces: rows of one length are packed together and scattered to their places."""
    fixed = [(name, kind) for name, (kind, _) in columns.items()]
    for start in range(0, len(counts), CHUNK):
        chunk = counts[start : start + CHUNK]
        row_sizes = np.dtype([("count", count_type), *fixed]).itemsize + 4 * chunk.astype(np.int64)
        row_ends = np.cumsum(row_sizes)
        row_starts = row_ends - row_sizes
        piece = np.empty(row_ends[-1], np.uint8)
        for count in np.unique(chunk):
            local = np.flatnonzero(chunk == count)
            ids = start + local
            rows = np.empty(
                len(ids), [("count", count_type), ("corners", "<i4", (int(count),)), *fixed]
            )
            rows["count"] = count
            rows["corners"] = axis.face_vertices[axis.face_offsets[ids][:, None] + np.arange(count)]
            for name, (_, column) in columns.items():
                rows[name] = column[ids]
            places = row_starts[local][:, None] + np.arange(rows.itemsize)
            piece[places] = rows.view(np.uint8).reshape(len(rows), -1)
        yield piece.tobytes()


def _write_npz(axis: MedialAxis, stream: BinaryIO) -> None:
    """Write the archive that np.savez would write; np.savez itself leaves it open when the disk is full."""
    with zipfile.ZipFile(stream, "w") as archive:
        for name, array in as_arrays(axis).items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                np.lib.format.write_array(entry, array, allow_pickle=False)


def _write_csv(axis: MedialAxis, stream: BinaryIO) -> None:
    """Write a row for each part; lists of numbers are separated by spaces. An axis as published or a curve has none."""
    structure = axis.structure
    if structure is None:
        raise ExportError(
            "Expected a medial axis with sheets for a table of parts, found one without; "
            "compute the form Clean of the inner axis"
        )
    stream.write((",".join(COLUMNS) + "\n").encode("ascii"))
    for row in rows_of(structure):
        stream.write((",".join(_text(row[name]) for name in COLUMNS) + "\n").encode("ascii"))


def _text(value: Any) -> str:
    if isinstance(value, list):
        return " ".join(map(str, value))
    return f"{value:.17g}" if isinstance(value, float) else str(value)


FORMATS: dict[str, Format] = {
    ".ma": Format("Medial axis, triangles and radii", _write_ma),
    ".ply": Format(
        "PLY, polygons with radius, theta, rho, side and generators",
        _write_ply,
        plain_triangles.write_ply,
        holds_edges=False,
    ),
    ".obj": Format("Wavefront OBJ, polygons and lines", _write_obj, plain_triangles.write_obj),
    ".off": Format(
        "OFF, polygons and lines", _write_off, plain_triangles.write_off, holds_edges=False
    ),
    ".npz": Format("NumPy arrays, everything", _write_npz),
    ".csv": Format("Table of parts", _write_csv),
}
