# SPDX-License-Identifier: GPL-3.0-or-later
"""This module fills hollow solids: cavities, bores, and the insides of vessels and cups become part of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..curves.depth import ASIDE
from ..curves.net import Net
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..portable_angle import cosine
from ..shape.nearness import same_place
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from ..shape.triangles import equal_pairs, side_keys, unit_normals
from ..small_matrices import dot, length_of
from ..united import united
from .middle import AS_FAR

_INSIDE = 0.5  # of a winding number, from which on a place is inside; derived: the winding number of the surface
_LOOKED_AT = 64  # faces of a patch, at most


@dataclass(frozen=True, eq=False)
class Filled:
    """A filled shape."""

    # The faces outside, with a lid on each opening that a fan of triangles closes without a fold; others stay open
    shape: Shape
    lids: Ints  # (l, 3) The triangles of the lids, rows of the points of `shape`
    # (k, 3) The faces inside, rows of the points that the shape had; none where it is not hollow
    inner: Ints
    share: float  # Their share of the area


def filled(shape: Shape, sharp: float) -> Filled:
    """Fill a shape: a patch of its faces is inside where the winding number of the faces outside is above one half.

    Patches are bounded by where a face has, or has not, an opposite wall straight before it. So the wall of a bore is
    a patch, and the bottom of a cup is another one, both inside of the outer wall. Faces at the lip of a slanted mouth
    have no such wall; they continue the wall of the bore without an edge of `sharp` radians.

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
    place = same_place(read.points)
    normals, twice = unit_normals(read.points[read.triangles])
    hidden = _hidden(read, place, normals, twice > 0.0, sharp)
    faces = read.triangles
    if not hidden.any():
        return Filled(shape, faces[:0], faces[:0], 0.0)
    share = float(twice[hidden].sum() / twice.sum())
    return Filled(*_lidded(read, faces[~hidden], place), faces[hidden], share)


def end_at_lids(net: Net, full: Filled) -> None:
    """End limbs at the first ball from which on most touch a lid; the corners between lids and walls are no limbs."""
    for tip in net.tips() if len(full.lids) else ():
        name, chain = net.limb(tip)
        with own_errors() as module:
            room = module.TriangleTree(full.shape.points, full.lids).distances(net.points[chain])
        radius = net.radius[chain]
        first = int(np.argmax(room - radius))  # the ball that is farthest from lids
        touches = room[first:] <= (1.0 + 2.0 * AS_FAR) * radius[first:]
        beyond = np.cumsum(touches[::-1])[::-1]  # how many balls touch a lid, from each one on
        ends = touches & (2 * beyond > np.arange(len(touches), 0, -1))
        last = first + int(np.argmax(ends)) if ends.any() else len(chain) - 1
        if last == 0 and len(net.at[chain[0]]) > 1:
            net.drop_leaf(name)
        else:
            net.shorten(name, chain[: max(last, 1) + 1])


def _hidden(shape: Shape, place: Longs, normals: Floats, proper: Flags, sharp: float) -> Flags:
    """Return which faces lie inside of others."""
    points, faces = shape.points, shape.triangles
    diagonal = length_of(np.ptp(points, axis=0))
    looks = points[faces].mean(axis=1) + ASIDE * diagonal * normals
    hidden = _has_opposite_wall(points, faces, normals, diagonal) & proper
    beside = np.column_stack(equal_pairs(side_keys(place[faces], len(points)).ravel())) // 3
    smooth = beside[dot(normals[beside[:, 0]], normals[beside[:, 1]]) > cosine(sharp)]

    def decide(pairs: Longs, chosen: Flags | Longs) -> None:
        patch = _patches(pairs, hidden)
        for number in np.unique(patch[chosen]):
            rows = np.flatnonzero(patch == number)
            rest = ~hidden
            rest[rows] = False
            hidden[rows] = _is_inside(looks[rows], points, faces[rest])

    decide(beside, ~hidden)  # bottoms first, which stand before the walls round them
    decide(beside, hidden)
    lips = smooth[hidden[smooth[:, 0]] != hidden[smooth[:, 1]]].ravel()
    decide(smooth, lips[~hidden[lips]])
    return hidden


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


def _patches(beside: Longs, label: Flags) -> Longs:
    """Return the number of the patch of each face, where faces with one label that are beside each other are of one."""
    alike = label[beside[:, 0]] == label[beside[:, 1]]
    return united(len(label), beside[alike].astype(np.int32))


def _is_inside(looks: Floats, points: Floats, faces: Ints) -> bool:
    """Return whether the median winding number of some places is that of places inside."""
    some = np.unique(np.linspace(0, len(looks) - 1, min(len(looks), _LOOKED_AT)).astype(np.intp))
    if not len(faces):
        return False
    with own_errors() as module:
        found = module.winding_number(looks[some], points, np.ascontiguousarray(faces))
    return bool(np.median(found) > _INSIDE)


def _lidded(shape: Shape, faces: Ints, place: Longs) -> tuple[Shape, Ints]:
    """Return a shape of some faces, closed by lids round the middles of their openings, and the lids."""
    used, corner = np.unique(place[faces], return_inverse=True)
    corner = corner.reshape(-1, 3)
    points = shape.points[np.unique(place, return_index=True)[1][used]]
    lids: list[Longs] = [corner[:0]]
    middles: list[Floats] = []
    for loop in _openings(corner):
        middle = points[loop].mean(axis=0)
        normals = np.cross(points[np.roll(loop, -1)] - middle, points[loop] - middle)
        if (dot(normals, normals.sum(axis=0)) >= 0.0).all():
            apex = np.full(len(loop), len(points) + len(middles))
            lids.append(np.column_stack((np.roll(loop, -1), loop, apex)))
            middles.append(middle)
    closing = np.concatenate(lids).astype(np.int32)
    closed = replace(
        shape,
        points=np.concatenate([points, np.reshape(middles, (-1, 3))]),
        triangles=np.concatenate([corner.astype(np.int32), closing]),
        normals=None,
        sharp_edges=None,
        rows=None,
        reading=None,
        of_samples=False,
    )
    return closed, closing


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
