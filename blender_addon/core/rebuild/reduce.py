# SPDX-License-Identifier: GPL-3.0-or-later
"""Few spheres with edges and triangles instead of a whole medial axis: a small medial mesh (docs/small_mesh.md)."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np

from ..arrays import Floats, Ints
from ..axis.compute import Computation
from ..axis.medial_axis import INNER, LevelValues, MedialAxis, without_samples
from ..axis.polygon_triangles import axis_triangles, polygon_triangles
from ..axis.structure import CREASE, Structure
from ..axis.turning import with_facets_turned
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..shape.shape import Shape
from ..small_matrices import length_of
from .solid_difference import PointDifference, difference_of_points

_SPACING = 1 / 400  # of the diagonal: between points on the solid; chosen: unseen


def reduce_axis(axis: MedialAxis, vertices: int, progress: Progress | None = None) -> MedialAxis:
    """Represent the same solid by few vertices with polygons and edges of the same topology.

    An axis with crisp places that reaches sharp edges of the solid is reduced sheet by sheet (`_sheets`), if there are
    enough vertices for its nodes and curves. Otherwise edges collapse in the order in which they change the surface of
    the solid least, as long as the link condition holds; then the spheres are fitted to that surface.

    All choices are made with coordinates in the precision of a mesh in Blender, so that an axis that is stored there
    becomes the same small mesh.

    Parameters
    ----------
    axis : MedialAxis
        The inner axis.
    vertices : int
        The wanted number of vertices. More stay where no further edge can collapse: a loop keeps three.
    progress : Progress, optional

    Returns
    -------
    reduced : MedialAxis
        Polygons and edges, with radii. Facets have no samples of their own: `generators` are -1, and `theta` and `rho`
        are infinite, so that all thresholds keep them.

    Raises
    ------
    InvalidInputError
        Less than one vertex is wanted, or the axis is not an inner one.
    NativeModuleError, OutOfMemoryError, Cancelled
    """
    if (axis.side != INNER).any():
        raise InvalidInputError(
            "Expected a medial axis of the inside, found one of another side; compute it with side Inner"
        )
    if not _has_crisp_edges(axis):
        return _loose(axis, vertices, progress)
    found = _sheets(axis, vertices, progress)
    return _loose(_on_samples(axis), vertices, progress) if found is None else found


def _has_crisp_edges(axis: MedialAxis) -> bool:
    """Whether sheets taper to sharp edges of the solid."""
    structure, level = axis.structure, axis.level
    if structure is None or level is None or not level.is_crisp.any():
        return False
    return structure.count(CREASE) > 0


def _sheets(axis: MedialAxis, vertices: int, progress: Progress | None) -> MedialAxis | None:
    """Reduce sheet by sheet: nodes stay, flat sheets become polygons; None if more vertices are needed for that.

    Vertices that have not moved keep their places and radii to the last digit.
    """
    structure = cast("Structure", axis.structure)
    turned = with_facets_turned(_single(axis), structure.turned)
    triangles = polygon_triangles(turned.vertices, turned.face_offsets, turned.face_vertices)
    with own_errors() as module:
        found = module.reduce_sheets(
            turned.vertices,
            turned.radius,
            triangles,
            _edges(axis),
            np.repeat(structure.part, np.diff(turned.face_offsets) - 2),
            structure.node_vertex,
            vertices,
            progress=progress and progress.part(),
        )
    if found is None:
        return None
    places, radius, row, face_offsets, face_vertices, _, edges = found
    stays = row >= 0
    places = np.where(stays[:, None], axis.vertices[row], places)
    radius = np.where(stays, axis.radius[row], radius)
    return without_samples(places, radius, face_offsets, face_vertices, edges)


def _loose(axis: MedialAxis, vertices: int, progress: Progress | None) -> MedialAxis:
    """Collapse edges until so many vertices are left, or no edge can collapse."""
    given = sphere_mesh(_single(axis))
    with own_errors() as module:
        places, radius, triangles, edges = module.reduce_sphere_mesh(
            *given, vertices, progress=progress and progress.part()
        )
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int32)
    return without_samples(places, radius, offsets, triangles.reshape(-1), edges)


def _on_samples(axis: MedialAxis) -> MedialAxis:
    """The axis with balls that end at the samples: slabs that taper to an edge of the solid collapse badly."""
    level = cast("LevelValues", axis.level)
    return replace(axis, vertices=level.exact, radius=level.exact_radius)


def _single(axis: MedialAxis) -> MedialAxis:
    """The axis with vertices and radii that have the digits of float32, in its range or not."""
    return replace(axis, vertices=_rounded(axis.vertices), radius=_rounded(axis.radius))


def _rounded(values: Floats) -> Floats:
    share, exponent = np.frexp(np.ascontiguousarray(values))
    return np.ldexp(share.astype(np.float32).astype(np.float64), exponent)


def reduced(found: Computation, vertices: int, progress: Progress | None = None) -> Computation:
    """Return a computation with its axis reduced."""
    return replace(found, axis=reduce_axis(found.axis, vertices, progress))


def sphere_mesh(axis: MedialAxis) -> tuple[Floats, Floats, Ints, Ints]:
    """Convert an axis to spheres with triangles and edges, as the compiled module takes them."""
    return (
        np.ascontiguousarray(axis.vertices),
        np.ascontiguousarray(axis.radius),
        axis_triangles(axis),
        _edges(axis),
    )


def _edges(axis: MedialAxis) -> Ints:
    return np.ascontiguousarray(axis.edges, np.int32).reshape(-1, 2)


def reduced_difference(
    axis: MedialAxis, shape: Shape, progress: Progress | None = None
) -> PointDifference:
    """Measure the distance between a surface and the solid of a reduced axis, its balls, cones and slabs.

    It is measured in both directions between points of both surfaces; those on the solid are a 400th of the diagonal
    apart.

    Parameters
    ----------
    axis : MedialAxis
    shape : Shape
        In the same coordinates.
    progress : Progress, optional

    Raises
    ------
    InvalidInputError
        The shape has no faces.
    NativeModuleError, OutOfMemoryError, Cancelled
    """
    mesh = sphere_mesh(axis)
    used = shape.points[np.unique(shape.triangles)] if len(shape.triangles) else shape.points
    diagonal = length_of(np.ptp(used, axis=0))

    def signed(queries: Floats) -> Floats:
        with own_errors() as module:
            part = progress and progress.part(0.5)
            return np.asarray(module.solid_distances(queries, *mesh, progress=part))

    with own_errors() as module:
        part = progress and progress.part(0.5)
        points = module.solid_surface(*mesh, _SPACING * diagonal, progress=part)
    return difference_of_points(shape, np.asarray(points), signed, progress)
