# SPDX-License-Identifier: GPL-3.0-or-later
"""This module leads the branches of a net through the middle of the solid, along smooth lines.

The nearest place of the surface says in which direction the middle is: a point moves straight away from that place, as
long as no other place becomes nearer. There it is the centre of the largest ball that touches the place. Between such
moves the branches become smooth lines. Tips stay: they are centres of such balls.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..axis.smooth_curve import FARTHEST
from ..curves.depth import Depth
from ..curves.net import Net
from ..curves.smooth_line import Course, at_marks, marks_of, smooth_between
from ..small_matrices import dot

_ROUNDS = 2  # so often branches become smooth lines, and their points move
_AHEAD = 1e-3  # in this many radii the distance is looked at to learn where the nearest place is; derived: rounding
AS_FAR = 1e-3  # a distance that grows by less than this share less than the way is from one place; derived: rounding
_HALVED = 10  # so often the range of a move is halved
_ONE_SIDE = 0.5  # where it grows by a smaller share of the way, nearest places lie on two sides; chosen: skeleton


def inscribe(net: Net, depth: Depth, plane: float | None = None) -> None:
    """Make every radius of a net the distance to the surface.

    If the net is symmetric in X at a plane, its radii remain so: they are those of balls that fit on both sides.
    """
    used = np.unique(np.concatenate([*net.branches.values(), list(net.at)]).astype(np.int64))
    places = net.points[used]
    net.radius[used] = depth(places)
    if plane is not None:
        places[:, 0] = 2.0 * plane - places[:, 0]
        net.radius[used] = np.minimum(net.radius[used], depth(places))


def lead_through_middle(net: Net, depth: Depth) -> None:
    """Move the points of a net to the middle of the solid; every radius becomes the distance to the surface."""
    inscribe(net, depth)
    tips = net.tips()
    rows = np.setdiff1d(np.concatenate([*net.branches.values(), []]).astype(np.int64), tips)
    for _ in range(_ROUNDS):
        _smooth(net)
        net.points[rows] = _middles(net.points[rows], depth)
        inscribe(net, depth)


def _smooth(net: Net) -> None:
    """Make the branches smooth between their ends; a point that would leave the middle half of its ball stays."""
    names = [name for name, chain in net.branches.items() if len(chain) > 2 and net.length(name)]
    chains = [np.array(net.branches[name]) for name in names]
    lines = smooth_between(
        [Course(net.points[rows], net.radius[rows], rows[0] == rows[-1]) for rows in chains]
    )
    for rows, (share, places) in zip(chains, lines, strict=True):
        marks = marks_of(net.points[rows])
        smooth = at_marks(marks / marks[-1], share, places)
        moved = _lengths(smooth - net.points[rows])
        free = moved < FARTHEST * net.radius[rows]
        free[[0, -1]] &= rows[0] == rows[-1] and len(net.at[rows[0]]) == 2
        net.points[rows[free]] = smooth[free]
        net.radius[rows[free]] -= moved[free]  # a ball that certainly fits


def _middles(places: Floats, depth: Depth) -> Floats:
    """Return the centres of the largest balls that touch the surface where it is nearest to places."""
    room = depth(places)
    way = _away(places, room, depth)
    low, high = np.zeros(len(places)), FARTHEST * room
    for _ in range(_HALVED):
        far = (low + high) / 2.0
        fits = depth(places + far[:, None] * way) >= (1.0 - AS_FAR) * (room + far)
        low, high = np.where(fits, far, low), np.where(fits, high, far)
    return places + low[:, None] * way


def _away(places: Floats, room: Floats, depth: Depth) -> Floats:
    """Return unit vectors away from the nearest places of the surface; 0 where there are some on two sides."""
    step = _AHEAD * room
    steps = step[:, None, None] * np.eye(3)
    ahead, behind = (
        depth((places[:, None] + sign * steps).reshape(-1, 3)).reshape(-1, 3) for sign in (1, -1)
    )
    grown = (ahead - behind) / np.maximum(2.0 * step, np.finfo(float).tiny)[:, None]
    size = _lengths(grown)
    share = (size > _ONE_SIDE) / np.maximum(size, _ONE_SIDE)
    return share[:, None] * grown


def _lengths(vectors: Floats) -> Floats:
    return np.sqrt(dot(vectors, vectors))
