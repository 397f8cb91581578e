# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis as arrays."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from .slider_range import SliderRange
from .structure import Structure

# Values of `LevelValues.place`. A vertex is on the Voronoi diagram because no faces are known there or the samples are
# very dense, or because the ball of the faces was not empty or too far away; or it is where the ball touches the faces,
# on a smooth rim, on a sharp convex edge or in a corner.
VORONOI, REFUSED, TOUCHING, ON_RIM, ON_CREASE, IN_CORNER = range(6)
INNER, OUTER = 1, 2  # values of `MedialAxis.side`


@dataclass(frozen=True, eq=False)
class LevelValues:
    """The values of an axis that is a level of a hierarchy (docs/hierarchy.md)."""

    # (v, 3) The Voronoi vertices; `MedialAxis.vertices` are moved from them to where balls touch the faces, and where
    # that shows rims and curves better
    exact: Floats
    exact_radius: Floats  # (v,) The radius of the empty ball round each Voronoi vertex
    # (f,) The largest Simplify and Trim Rims at which the facet stays, in percent of the diagonal; infinite: always
    sheet: NDArray[np.float32]
    erosion: NDArray[np.float32]
    # (w,) The largest Shortest Limb at which the edge stays, in percent of the diagonal; infinite: always
    limb: NDArray[np.float32]
    betti: tuple[int, int, int]  # Pieces, loops and cavities, counted on this level
    # (v,) How each vertex was placed: VORONOI, REFUSED, TOUCHING, ON_RIM, ON_CREASE or IN_CORNER. Without crisp places,
    # and on curves, all are VORONOI.
    place: Ints
    # (v,) The size of the piece of each vertex in spacings of the samples, infinite where it is no crumb (`crumbs.py`);
    # None where it is not known
    crumb: NDArray[np.float32] | None = None
    # The ranges of Simplify, Trim Rims and Shortest Limb, by the names of the settings; empty: not known
    ranges: dict[str, SliderRange] = field(default_factory=dict)
    # The value of Simplify in a clear gap between thin sheets and others; None where there is none (`slider_range.py`)
    gap: float | None = None
    # The number of loops that the samples show, and that a curve with less Detail does not have
    loops_left_out: int = 0
    # How many loops and branches of a curve Detail can leave out; None where the axis is no curve
    removals: int | None = None

    @property
    def is_crisp(self) -> Flags:
        """(v,) whether the ball of each vertex ends at the faces; else it ends at the samples."""
        return self.place >= TOUCHING

    @property
    def refused(self) -> int:
        """The number of vertices that stayed on the Voronoi diagram because no ball fits the faces there."""
        return int(np.count_nonzero(self.place == REFUSED))

    @property
    def places(self) -> str:
        """A sentence about the places of the vertices."""
        crisp, balls = int(np.count_nonzero(self.is_crisp)), len(self.place)
        if not crisp:
            return "All balls end at the samples"
        if crisp == balls:
            return "All balls end at the faces"
        return f"{crisp:,} of {balls:,} balls end at the faces, the others at the samples"


def no_edges() -> Ints:
    return np.zeros((0, 2), np.int32)


@dataclass(frozen=True, eq=False)
class MedialAxis:
    """Facets as convex polygons that share vertices; edges without a facet, and vertices without an edge.

    As published there are facets only, which are planar.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
        The radius of the empty ball round each vertex, in the unit of the input.
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    theta : (f,) float64, radians
    rho : (f,) float64
    side : (f,) int32
        0 unknown, 1 inner, 2 outer, 3 crossing.
    generators : (f, 2) int32
        The rows of the two samples of each facet; where only some points of a cloud were analysed, rows of
        the whole cloud.
    unbounded, zero_area : int
        The numbers of selected facets that reach infinity, and that cannot be distinguished from a point or a segment
        (docs/stage_delaunay.md); neither are among the polygons.
    edges : (w, 2) int32
        The ends of the edges that belong to no facet.
    level : LevelValues or None
        None: the axis is as published.
    structure : Structure or None
        Sheets, seams, rims, junctions and corners; only of levels, and None where they are not known.
    """

    vertices: Floats
    radius: Floats
    face_offsets: Ints
    face_vertices: Ints
    theta: Floats
    rho: Floats
    side: Ints
    generators: Ints
    unbounded: int
    zero_area: int
    edges: Ints = field(default_factory=no_edges)
    level: LevelValues | None = None
    structure: Structure | None = None

    def moved(self, by: Floats) -> MedialAxis:
        """The axis, moved; the same bytes where it stays."""
        if not by.any():
            return self
        level = self.level and replace(self.level, exact=self.level.exact + by)
        return replace(self, vertices=self.vertices + by, level=level)

    @property
    def facets(self) -> int:
        """Number of polygons."""
        return len(self.face_offsets) - 1

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing at all: no facet, no edge, no vertex."""
        return len(self.vertices) == 0


# The fields of an axis as published, which `_medial.MedialMesh` has, too.
AS_PUBLISHED = tuple(
    name for name in MedialAxis.__dataclass_fields__ if name not in ("level", "structure")
)


def without_samples(
    vertices: Floats, radius: Floats, face_offsets: Ints, face_vertices: Ints, edges: Ints
) -> MedialAxis:
    """Return an inner axis whose facets have no samples: `generators` are -1, `theta` and `rho` are infinite."""
    count = len(face_offsets) - 1
    always = np.full(count, np.inf)
    return MedialAxis(
        vertices=vertices,
        radius=radius,
        face_offsets=face_offsets,
        face_vertices=face_vertices,
        theta=always,
        rho=always,
        side=np.full(count, INNER, np.int32),
        generators=np.full((count, 2), -1, np.int32),
        unbounded=0,
        zero_area=0,
        edges=edges,
    )
