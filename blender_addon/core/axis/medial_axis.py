# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis as arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class LevelValues:
    """What is known of an axis that is a level of a hierarchy (docs/hierarchy.md).

    Parameters
    ----------
    exact : (v, 3) float64
        The Voronoi vertex that each vertex is; `MedialAxis.vertices` are moved where that shows rims and curves better.
    exact_radius : (v,) float64
        Of its empty ball.
    sheet, erosion : (f,) float32
        Up to which Simplify and Erode the facet stays, percent of the diagonal; infinite: always.
    limb : (w,) float32
        Up to which Limbs the edge stays, percent of the diagonal; infinite: always.
    betti : tuple of int
        Pieces, loops and cavities, counted on this level.
    """

    exact: NDArray[np.float64]
    exact_radius: NDArray[np.float64]
    sheet: NDArray[np.float32]
    erosion: NDArray[np.float32]
    limb: NDArray[np.float32]
    betti: tuple[int, int, int]


def no_edges() -> NDArray[np.int32]:
    return np.zeros((0, 2), np.int32)


@dataclass(frozen=True, eq=False)
class MedialAxis:
    """Facets as convex polygons that share vertices; edges without a facet, and vertices without an edge.

    As published there are facets only, which are planar.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
        Of the empty ball round each vertex, in the unit of the input.
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    theta : (f,) float64, radians
    rho : (f,) float64
    side : (f,) int32
        0 not known, 1 inner, 2 outer, 3 crossing.
    generators : (f, 2) int32
        Rows of the two samples of each facet; where only some points of a cloud were analysed, rows of
        the whole cloud.
    unbounded, zero_area : int
        Selected facets that reach infinity, or that cannot be told from a point or a segment (docs/stage_delaunay.md);
        neither is here.
    edges : (w, 2) int32
        Ends of the edges that stand by themselves.
    level : LevelValues or None
        None: the axis is as published.
    """

    vertices: NDArray[np.float64]
    radius: NDArray[np.float64]
    face_offsets: NDArray[np.int32]
    face_vertices: NDArray[np.int32]
    theta: NDArray[np.float64]
    rho: NDArray[np.float64]
    side: NDArray[np.int32]
    generators: NDArray[np.int32]
    unbounded: int
    zero_area: int
    edges: NDArray[np.int32] = field(default_factory=no_edges)
    level: LevelValues | None = None

    @property
    def facets(self) -> int:
        """Number of polygons."""
        return len(self.face_offsets) - 1

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing at all: no facet, no edge, no vertex."""
        return len(self.vertices) == 0
