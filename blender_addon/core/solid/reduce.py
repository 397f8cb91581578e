# SPDX-License-Identifier: GPL-3.0-or-later
"""Few spheres with edges and triangles instead of a whole medial axis: a small medial mesh (docs/small_mesh.md)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..axis.facet_triangles import triangulate_facets
from ..axis.medial_axis import MedialAxis
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..machine.progress import Progress
from .solid_difference import PointDifference, difference_of_points

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..axis.compute import Computation
    from ..samples.shape import Shape
    from ..settings import Settings

_INNER = 1  # value of `_medial.Side`
_SPACING = 1 / 400  # the distance of points on the solid, as a share of the diagonal


@dataclass(frozen=True)
class SphereMesh:
    """The arrays that the compiled module takes, in its order."""

    vertices: NDArray[np.float64]
    radius: NDArray[np.float64]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]

    @property
    def arrays(self) -> tuple[NDArray[Any], ...]:
        return self.vertices, self.radius, self.triangles, self.edges


def reduce_axis(axis: MedialAxis, vertices: int, progress: Progress | None = None) -> MedialAxis:
    """Represent the same solid by few vertices with triangles and edges of the same topology.

    Edges collapse in the order in which they change the surface of the solid least, as long as the link condition
    holds. Then the spheres are fitted to that surface.

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
        Triangles and edges, with radii. Facets have no samples of their own: `generators` are -1, and `theta` and
        `rho` are infinite, so that all thresholds keep them.

    Raises
    ------
    InvalidInputError
        Less than one vertex is wanted, or the axis is not an inner one.
    NativeModuleError, OutOfMemoryError, Cancelled
    """
    if (axis.side != _INNER).any():
        raise InvalidInputError(
            "Expected a medial axis of the inside, found one of another side; compute it with side Inner"
        )
    whole = sphere_mesh(axis)
    with own_errors() as module:
        found = module.reduce_sphere_mesh(
            *whole.arrays, vertices, progress=progress and progress.part()
        )
    return _as_axis(SphereMesh(*found))


def reducible(settings: Settings) -> Settings:
    """Return the settings of an axis that reduces well: slabs that taper to an edge of the solid collapse badly."""
    return replace(settings, crisp=False)


def reduced(found: Computation, vertices: int, progress: Progress | None = None) -> Computation:
    """Return a computation with its axis reduced."""
    return replace(found, axis=reduce_axis(found.axis, vertices, progress))


def sphere_mesh(axis: MedialAxis) -> SphereMesh:
    """Convert an axis to spheres with triangles and edges."""
    triangles = triangulate_facets(axis.vertices, axis.face_offsets, axis.face_vertices)
    return SphereMesh(
        np.ascontiguousarray(axis.vertices),
        np.ascontiguousarray(axis.radius),
        triangles,
        np.ascontiguousarray(axis.edges, np.int32).reshape(-1, 2),
    )


def reduced_difference(axis: MedialAxis, shape: Shape) -> PointDifference:
    """Measure the distance between a surface and the solid of a reduced axis, its balls, cones and slabs.

    It is measured in both directions between points of both surfaces; those on the solid are a 400th of the diagonal
    apart.

    Parameters
    ----------
    axis : MedialAxis
    shape : Shape
        In the same coordinates.

    Raises
    ------
    InvalidInputError
        The shape has no faces.
    NativeModuleError, OutOfMemoryError
    """
    mesh = sphere_mesh(axis)
    used = shape.points[np.unique(shape.triangles)] if len(shape.triangles) else shape.points
    diagonal = float(np.linalg.norm(np.ptp(used, axis=0)))

    def signed(queries: NDArray[np.float64]) -> NDArray[np.float64]:
        with own_errors() as module:
            return np.asarray(module.solid_distances(queries, *mesh.arrays))

    with own_errors() as module:
        points = np.asarray(module.solid_surface(*mesh.arrays, _SPACING * diagonal))
    return difference_of_points(shape, points, signed)


def _as_axis(mesh: SphereMesh) -> MedialAxis:
    count = len(mesh.triangles)
    always = np.full(count, np.inf)
    return MedialAxis(
        vertices=mesh.vertices,
        radius=mesh.radius,
        face_offsets=np.arange(0, 3 * count + 1, 3, dtype=np.int32),
        face_vertices=mesh.triangles.reshape(-1),
        theta=always,
        rho=always,
        side=np.full(count, _INNER, np.int32),
        generators=np.full((count, 2), -1, np.int32),
        unbounded=0,
        zero_area=0,
        edges=mesh.edges,
    )
