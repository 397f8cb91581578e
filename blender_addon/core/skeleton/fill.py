# SPDX-License-Identifier: GPL-3.0-or-later
"""This module fills hollow solids: cavities, bores, and the insides of vessels and cups become part of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..curves.depth import ASIDE
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..shape.nearness import same_place
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from ..shape.triangles import equal_pairs, side_keys, unit_normals
from ..small_matrices import length_of
from ..united import united

_INSIDE = 0.5  # of a winding number, from which on a place is inside; derived: the winding number of the surface
_LOOKED_AT = 64  # faces of a patch, at most


@dataclass(frozen=True, eq=False)
class Filled:
    """A filled shape."""

    shape: Shape  # The faces outside, with a lid on each opening
    # (k, 3) The faces inside, rows of the points that the shape had; none where it is not hollow
    inner: Ints
    share: float  # Their share of the area


def filled(shape: Shape) -> Filled:
    """Fill a shape: a patch of its faces is inside where the winding number of the faces outside is above one half.

    Patches are bounded by where a face has, or has not, an opposite wall straight before it. So the wall of a bore is
    a patch, and the bottom of a cup is another one, both inside of the outer wall.

    Raises
    ------
    InvalidInputError
        There are no faces.
    """
    if not len(shape.triangles):
        raise InvalidInputError(
            "Expected faces for Fill, found points only; switch Fill off, or choose a mesh"
        )
    read = outward_shape(shape)
    points, faces = read.points, read.triangles
    place = same_place(points)
    normals, twice = unit_normals(points[faces])
    diagonal = length_of(np.ptp(points, axis=0))
    looks = points[faces].mean(axis=1) + ASIDE * diagonal * normals
    hidden = _has_opposite_wall(points, faces, normals, diagonal) & (twice > 0.0)
    for faced in (False, True):  # bottoms first, which stand before the walls round them
        patch = _patches(place[faces], hidden)
        for number in np.unique(patch[hidden == faced]):
            rows = np.flatnonzero(patch == number)
            rest = ~hidden
            rest[rows] = False
            hidden[rows] = _is_inside(looks[rows], points, faces[rest])
    if not hidden.any():
        return Filled(shape, faces[:0], 0.0)
    share = float(twice[hidden].sum() / twice.sum())
    return Filled(_lidded(read, faces[~hidden], place), faces[hidden], share)


def _has_opposite_wall(points: Floats, faces: Ints, normals: Floats, diagonal: float) -> Flags:
    """Return whether a wall faces each face, straight before one of four places; one alone may look along an edge."""
    corners = points[faces]
    middles = corners.mean(axis=1)
    places = [middles, *(0.5 * middles + 0.5 * corners[:, corner] for corner in range(3))]
    with own_errors() as module:
        gap = module.wall_distances(
            np.concatenate(places),
            np.tile(-normals, (4, 1)),
            np.full(4 * len(faces), diagonal),
            points,
            np.ascontiguousarray(faces[:, ::-1]),
        )
    return np.isfinite(gap).reshape(4, -1).any(axis=0)


def _patches(faces: Longs, label: Flags) -> Longs:
    """Return the number of the patch of each face: faces of one label that share edges are of one patch."""
    keys = side_keys(faces, int(faces.max(initial=0)) + 1).ravel()
    pairs = np.column_stack(equal_pairs(keys)) // 3
    return united(len(faces), pairs[label[pairs[:, 0]] == label[pairs[:, 1]]].astype(np.int32))


def _is_inside(looks: Floats, points: Floats, faces: Ints) -> bool:
    """Return whether the median winding number of some places is that of places inside."""
    some = np.unique(np.linspace(0, len(looks) - 1, min(len(looks), _LOOKED_AT)).astype(np.intp))
    if not len(faces):
        return False
    with own_errors() as module:
        found = module.winding_number(looks[some], points, np.ascontiguousarray(faces))
    return bool(np.median(found) > _INSIDE)


def _lidded(shape: Shape, faces: Ints, place: Longs) -> Shape:
    """Return a shape of some faces, and a lid of triangles round the middle of each of their openings."""
    used, corner = np.unique(place[faces], return_inverse=True)
    corner = corner.reshape(-1, 3)
    points = shape.points[np.unique(place, return_index=True)[1][used]]
    lids: list[Ints] = []
    middles: list[Floats] = []
    for loop in _openings(corner):
        apex = np.full(len(loop), len(points) + len(middles))
        lids.append(np.column_stack((np.roll(loop, -1), loop, apex)))
        middles.append(points[loop].mean(axis=0))
    return replace(
        shape,
        points=np.concatenate([points, np.reshape(middles, (-1, 3))]),
        triangles=np.concatenate([corner, *lids]).astype(np.int32),
        normals=None,
        sharp_edges=None,
        rows=None,
        reading=None,
        of_samples=False,
    )


def _openings(corners: Longs) -> list[Longs]:
    """Return the loops of edges that only one face has, in its direction; one that meets itself is divided there."""
    edges = corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    twins = {(b, a) for a, b in edges.tolist()}
    after: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        if (a, b) not in twins:
            after.setdefault(a, []).append(b)
    loops = []
    for start in sorted(after):
        way = [start]
        while after.get(way[-1]):
            following = after[way[-1]].pop()
            if following in way:
                begin = way.index(following)
                loops.append(np.array(way[begin:]))
                del way[begin + 1 :]
            else:
                way.append(following)
    return [loop for loop in loops if len(loop) > 2]
