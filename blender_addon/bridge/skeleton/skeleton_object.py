# SPDX-License-Identifier: GPL-3.0-or-later
"""Skeletons as curve objects: how they are found, made and updated; on the source selected ends, and parts as an
attribute."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Floats, Ints, Longs
from ...core.curves.spread import groups_of
from ...core.errors import InvalidInputError
from ...core.shape.nearness import nearest
from ...core.shape.shape import Shape
from ...core.skeleton.compute import Skeletonization
from ...core.skeleton.skeleton import Skeleton
from ...core.small_matrices import times
from ..mesh import stored
from ..mesh.attributes import set_attribute
from ..mesh.evaluated_rows import only_deforms, row_of_vertices
from ..mesh.mesh_arrays import read_edges, read_polygons, read_positions
from ..objects.output_object import Product, check_mode, new_object, place, remember
from ..objects.read_object import split_transform

PART = "ma_part"


SKELETON = Product(" Skeleton", (stored.ENDS,), type="CURVE")
is_skeleton, skeleton_of, check_skeleton_writable = (
    SKELETON.has,
    SKELETON.of,
    SKELETON.check_writable,
)


def write_skeleton(
    source: bpy.types.Object, found: Skeletonization, frame: np.ndarray
) -> bpy.types.Object:
    """Make the skeleton of a source, or update the existing one, whose bevel and materials stay."""
    thing = skeleton_of(source)
    check_mode(thing)
    check_size(found.skeleton)
    if thing is None:
        thing = new_object(source, SKELETON.suffix, new_curve(source.name + SKELETON.suffix))
        thing.show_in_front = True  # it lies inside the surface
    fill_curve(thing.data, found.skeleton)
    place(thing, frame)
    remember(thing, source, found.points, found.duplicates, found.warnings)
    thing[stored.ENDS], thing[stored.LOOPS] = found.skeleton.tips, found.skeleton.loops
    thing[stored.BRANCHES], thing[stored.MIRRORED] = found.skeleton.count, found.mirrored
    thing.update_tag()
    return thing


def check_size(skeleton: Skeleton) -> None:
    """Raise InvalidInputError when Blender cannot hold a skeleton."""
    largest, limit = np.abs(skeleton.points).max(), np.finfo(np.float32).max
    if largest > limit:
        raise InvalidInputError(
            f"Expected coordinates below {limit:.3g}, which Blender can hold, found {largest:.3g}; "
            "scale the object down"
        )


_SHARE = 0.2  # of the balls: so thick are tubes along the curve, as wires of an axis are at most
_SIDES_OF_QUARTER = 2  # between the four corners of the profile: twelve sides


def new_curve(name: str) -> bpy.types.Curve:
    """A curve that is seen in renders; the radius of each point is that of its ball."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth, curve.bevel_resolution = _SHARE, _SIDES_OF_QUARTER
    curve.use_fill_caps = True
    return curve


def fill_curve(curve: bpy.types.Curve, skeleton: Skeleton) -> None:
    """A poly spline for each branch, cyclic for loops without a fork, and one of a single point for each lone node."""
    curve.splines.clear()
    degree = skeleton.degree
    for rows in skeleton.branches:
        closed = bool(rows[0] == rows[-1] and degree[rows[0]] == 2)
        _add_spline(curve, skeleton, rows[:-1] if closed else rows, closed)
    for row in np.flatnonzero(degree == 0):
        _add_spline(curve, skeleton, np.array([row]), False)


def _add_spline(curve: bpy.types.Curve, skeleton: Skeleton, rows: Ints, closed: bool) -> None:
    spline = curve.splines.new("POLY")
    spline.points.add(len(rows) - 1)
    places = np.column_stack((skeleton.points[rows], np.ones(len(rows))))
    spline.points.foreach_set("co", places.astype(np.float32).ravel())
    spline.points.foreach_set("radius", skeleton.radius[rows].astype(np.float32))
    spline.use_cyclic_u = closed


# --- on the source


def rows_of_vertices(source: bpy.types.Object, shape: Shape) -> Longs:
    """(v,) the point of the shape for each vertex of a mesh: its own, or the nearest where modifiers make others."""
    readable = source.mode != "EDIT" or only_deforms(source)  # there attributes cannot be written
    if readable and shape.has_vertices(len(source.data.vertices)):
        rows = row_of_vertices(source)
        if rows is not None:
            return rows
    _, rest = split_transform(np.array(source.matrix_world, np.float64))
    return nearest(times(read_positions(source.data), rest), shape.points)


def selected_ends(source: bpy.types.Object, shape: Shape) -> Floats:
    """Return an end for each connected group of selected vertices, (e, 3): their mean, in the space of the shape.

    Raises InvalidInputError where fewer than two groups are selected, or the source is no mesh.
    """
    if source.type != "MESH":
        raise InvalidInputError(
            f"Expected a mesh with selected vertices, found '{source.name}', which is none; turn Selected Ends off"
        )
    mesh = source.data
    chosen = np.zeros(len(mesh.vertices), bool)
    mesh.vertices.foreach_get("select", chosen)
    rows = np.flatnonzero(chosen)
    group = groups_of(rows, read_edges(mesh))
    count = int(group.max(initial=-1)) + 1
    if count < 2:
        raise InvalidInputError(
            f"Expected vertices selected at two or more ends, found {count} connected groups on '{source.name}'; "
            "select a vertex at each end in Edit Mode"
        )
    places = shape.points[rows_of_vertices(source, shape)[rows]]
    size = np.bincount(group)
    return np.column_stack([np.bincount(group, places[:, k]) / size for k in range(3)])


def check_parts_writable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when the faces of a source cannot take an attribute now."""
    if source.type != "MESH" or source.data.library is not None or source.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected a mesh of this file in object mode for parts, found '{source.name}', which is not; "
            "turn Parts off"
        )


def write_parts(source: bpy.types.Object, found: Skeletonization) -> None:
    """Give the faces of a source `ma_part`: the branch of most of their corners, -1 for those of single points."""
    mesh = source.data
    part = found.parts.vertices.branch[rows_of_vertices(source, found.shape)]
    offsets, corners = read_polygons(mesh)
    face = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    values = _most_frequent(face, part[corners], len(offsets) - 1)
    set_attribute(mesh, PART, "INT", "FACE", values)
    mesh.update()


def _most_frequent(face: Longs, part: Ints, count: int) -> Ints:
    """Return the part that most corners of each face have, (count,); of several the lowest."""
    pairs, times = np.unique(np.column_stack((face, part)), axis=0, return_counts=True)
    order = np.lexsort((-pairs[:, 1], times, pairs[:, 0]))
    values = np.full(count, -1, np.int32)
    values[pairs[order, 0]] = pairs[order, 1]
    return values
