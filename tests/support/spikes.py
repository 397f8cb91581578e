# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a computed axis juts out where nothing of the shape explains it.

A medial ball touches the surface at two places. The angle between the two, seen from the centre, says how firmly the
surface holds the ball there: 180 degrees between parallel walls, 90 along the bisector of a box's edge, 0 at a smooth
rim, and next to nothing in a spike, whose two generators are neighbours on the surface. So the firm vertices are those
where one facet's generators are seen at 45 degrees or more, twice the paper's pi/8, and the length of a spike
is the distance of a vertex that is not firm from the nearest firm one, relative to the radius there. A smooth rim has a
"spike" of this kind, too: it is real and shorter than the radius by far.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]

FIRM = np.pi / 4


def angles(axis: Any, points: Array) -> Array:
    """(v,) widest angle at which a vertex sees the generators of one of its facets."""
    p, q = points[axis.generators[:, 0]], points[axis.generators[:, 1]]
    facet = np.repeat(np.arange(len(p)), np.diff(axis.face_offsets))
    corner = axis.face_vertices
    gap = np.linalg.norm(p - q, axis=1)[facet]
    angle = 2 * np.arcsin(np.clip(gap / (2 * axis.radius[corner]), 0.0, 1.0))
    widest = np.zeros(len(axis.vertices))
    np.maximum.at(widest, corner, angle)
    return widest


def lengths(axis: Any, points: Array) -> Array:
    """(v,) of the spike that ends at each vertex, relative to the radius where it begins; 0 at firm ones."""
    firm = angles(axis, points) >= FIRM
    if not firm.any():
        return np.full(len(axis.vertices), np.inf)
    away, nearest = cKDTree(axis.vertices[firm]).query(axis.vertices)
    return away / axis.radius[firm][nearest]


def worst(axis: Any, points: Array, kinds: NDArray | None, values: Array, count: int = 5) -> str:
    """Where the largest values at vertices are: the facets there, for people."""
    lines = []
    for vertex in np.argsort(-values, kind="stable")[:count]:
        facet = np.searchsorted(
            axis.face_offsets, np.flatnonzero(axis.face_vertices == vertex), side="right"
        ) - 1  # fmt: skip
        x = axis.vertices[vertex].round(4).tolist()
        lines.append(f"vertex at {x}, radius {axis.radius[vertex]:.4g}, value {values[vertex]:.4g}")
        for row in facet:
            p, q = axis.generators[row]
            kind = "" if kinds is None else f", kinds {kinds[p]} {kinds[q]}"
            gap = np.linalg.norm(points[p] - points[q])
            lines.append(
                f"    facet {row}: theta {np.degrees(axis.theta[row]):.1f}, rho {axis.rho[row]:.2f}, "
                f"generators {points[p].round(4).tolist()} {points[q].round(4).tolist()}, "
                f"{gap:.4g} apart{kind}"
            )
    return "\n".join(lines)
