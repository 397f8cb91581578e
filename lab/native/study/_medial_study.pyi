# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests and the laboratory study next to the product: the stages by themselves, and the methods of others.

The module has everything that `_medial` has, but its types are its own: no object passes from one to the other. It is
not shipped. Ids, angles and lengths are as in `_medial`.
"""

import numpy as np
from _medial import *
from _medial import CoconeOptions, MedialAnalysis, MedialMesh, Progress, Rule, Side
from numpy.typing import NDArray

def delaunay(
    points: NDArray[np.float64],
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
    """Delaunay triangulation of the distinct rows.

    Returns
    -------
    cells : (c, 4) int32
        Rows of the corners, positively oriented; -1 is the infinite vertex. Infinite cells included.
    neighbors : (c, 4) int32
        Cell across the facet opposite to each corner.
    circumcentres : (c, 3) float64
        Voronoi vertex of a finite cell, relative error below 2^-24 of its radius; of an infinite cell the outward
        unit normal of its hull triangle: the direction of its Voronoi ray.
    """

def poles(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Pole vectors (Definition 1) of the distinct rows in ascending order.

    Returns
    -------
    vectors : (k, 3) float64
        v_p = p+ - p; for an unbounded cell the mean of the unit directions of its distinct infinite edges.
    unbounded : (k,) bool
        The pole is at infinity.
    """

def umbrellas(points: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Umbrellas U_p (Definition 3) of the distinct rows in ascending order.

    Returns
    -------
    offsets : (k + 1,) int64
    triangles : (t, 3) int32
        Rows (p, a, b), a < b, sorted; U_p of the i-th sample is `triangles[offsets[i] : offsets[i + 1]]`.
    """

def power_shape(
    centres: NDArray[np.float64],
    radii: NDArray[np.float64],
    wanted: NDArray[np.bool_],
    *,
    progress: Progress | None = None,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]:
    """The power shape (Amenta, Choi & Kolluri 2001): where the power cells of balls meet.

    Parameters
    ----------
    centres : (n, 3) float64
    radii : (n,) float64
        At least 0.
    wanted : (n,) bool
        The balls of the shape, say the inner poles; the others take their cells of space.
    progress : Progress, optional

    Returns
    -------
    balls : (k,) int32
        Rows, ascending, of the wanted balls that have a cell. Of equal balls the first has it.
    triangles : (t, 3) int32
        Rows of three wanted balls whose cells meet, ascending, in lexicographic order.
    edges : (e, 2) int32
        Of two, in no such triangle.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def cocone(
    points: NDArray[np.float64], options: CoconeOptions | None = None
) -> tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.int32]]:
    """Cocone's flat samples and candidate triangles; samples are the distinct rows in ascending order.

    With v_p the pole vector and C_p the points y whose line p y is within `cocone_angle` of the plane through p
    normal to v_p, the cocone neighbours of p are the samples of the triangles at p whose dual Voronoi edge
    meets C_p.

    Returns
    -------
    thin : (k,) bool
        `flatness_ratio` times the distance of the farthest crossing of V_p's edges with that plane is at most the
        distance of p to its pole and to its second pole: the farthest Voronoi vertex on the other side of the plane.
    flat : (k,) bool
        Thin, and its pole line is within `flatness_angle` of that of every cocone neighbour; or, grown from those:
        thin, and within it of that of one flat cocone neighbour.
    candidates : (t, 3) int32
        Rows, ascending, sorted: triangles with a flat corner, whose dual Voronoi edge meets the cocone of every
        flat corner.
    """

class Against:
    """What theta and rho at a sample are measured against (Dey & Zhao, the Remark in sect. 3.2)."""

    UMBRELLA: Against  # 0
    """The normals and the circumradii of its umbrella."""
    POLE: Against  # 1
    """The pole vector in place of the normals; edges of umbrellas are tried, too."""
    POLYGON: Against  # 2
    """The farthest corner of the tangent polygon in place of the circumradii."""
    POLE_AND_POLYGON: Against  # 3
    """Both."""

class SizeCondition:
    """Which facets other methods select by the length of pq and the size of balls."""

    ANGLE_AND_LENGTH: SizeCondition  # 0
    """After Attali & Lachaud (2001): every ball of the facet sees pq under at least twice theta, and |pq| is at least
    `length`."""
    LAMBDA: SizeCondition  # 1
    """Chazal & Lieutier (2005): the nearest samples fit in no ball with a diameter below `length`, twice their lambda.
    Edges are selected, too."""

def axis_by_remark(
    analysis: MedialAnalysis,
    against: Against,
    theta: float = ...,
    rho: float = 8.0,
    side: Side = ...,
    rule: Rule = ...,
    *,
    progress: Progress | None = None,
) -> MedialMesh:
    """The facets that MEDIAL selects when it measures edges as the Remark in sect. 3.2 does.

    Parameters
    ----------
    analysis : MedialAnalysis
    against : Against
    theta, rho, side, rule
        As in `MedialAnalysis.extract`.
    progress : Progress, optional

    Raises
    ------
    InvalidInputError, DegenerateInputError, Cancelled
    """

def axis_by_size(
    analysis: MedialAnalysis,
    condition: SizeCondition,
    length: float = 0.05,
    theta: float = ...,
    side: Side = ...,
    *,
    progress: Progress | None = None,
) -> MedialMesh:
    """The facets that a condition on sizes selects; by LAMBDA the edges without a facet, too.

    Parameters
    ----------
    analysis : MedialAnalysis
    condition : SizeCondition
    length : float
        A share of the diagonal of the samples' box, at least 0; default 0.05. It is reached, not exceeded.
    theta : float
        For ANGLE_AND_LENGTH, radians in [0, pi/2]; default pi/8.
    side : Side
        BOTH (default), INNER or OUTER.
    progress : Progress, optional

    Raises
    ------
    InvalidInputError, DegenerateInputError, Cancelled
    """

def select_by_size(
    analysis: MedialAnalysis,
    condition: SizeCondition,
    length: float = 0.05,
    theta: float = ...,
    side: Side = ...,
) -> NDArray[np.int32]:
    """The rows of `MedialAnalysis.edges`, ascending, whose facets a condition on sizes selects.

    The parameters are those of `axis_by_size`.

    Returns
    -------
    ids : (s,) int32
    """

def pole_axis(
    analysis: MedialAnalysis, side: Side = ..., *, progress: Progress | None = None
) -> MedialMesh:
    """The poles as balls: a MedialMesh of vertices without facets (Amenta & Bern 1998; Boissonnat & Cazals 2001).

    They are the farthest Voronoi vertex of each cell and the farthest against it, on one side or on both, where they
    are finite. In the order of `MedialAnalysis.samples`.

    Raises
    ------
    InvalidInputError, Cancelled
    DegenerateInputError
        INNER or OUTER, and `TightCocone.encloses` is false.
    """
