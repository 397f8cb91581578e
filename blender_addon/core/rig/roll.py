# SPDX-License-Identifier: GPL-3.0-or-later
"""The roll of bones: a limb bends about the first axis of its bones, further if the angle is positive.

A limb that is bent lies in a plane, and bends in it. A straight one that is flat bends towards its flat side, along the
normal of the sheet in its middle. Bones between the sides of a body nod in that plane. Mirror images have mirror images
of these axes.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..curves.smooth_line import marks_of
from ..skeleton.parts import Places
from ..skeleton.skeleton import Skeleton
from ..small_matrices import dot, stretches
from .sides import Sides
from .tree import Chain

_BENT = 0.25  # a limb is bent if it leaves a straight line by this share of its mean radius; chosen: unseen
_FLAT = 0.75  # a limb is flat if it is this many times as thick as wide, or less; chosen: unseen
_ALONG = 0.1  # the sine of the angle of a bone that is parallel to an axis; chosen: unseen


def ups_of(chain: Chain, joints: Floats, sides: Sides, within: bool, flat: Floats) -> Floats:
    """Return the third axis of each bone along a chain, (n, 3), given its (n + 1, 3) joints.

    A chain within lies between the sides; `flat` is the normal of the sheet in it, (3,), or 0.
    """
    along = _unit(np.diff(joints, axis=0))
    hinge = sides.normal if within else _hinge(chain)
    front = np.array([_front(sides.normal, bone) for bone in along])
    if hinge is not None:
        up = np.cross(hinge, along)
    else:
        up = np.tile(flat * np.where(dot(front, flat).sum() < 0.0, -1.0, 1.0), (len(along), 1))
    up -= (up * along).sum(axis=1)[:, None] * along
    weak = np.linalg.norm(up, axis=1) < _ALONG
    up[weak] = front[weak]
    return _unit(up - (up * along).sum(axis=1)[:, None] * along)


def flats_of(skeleton: Skeleton, places: Places, vertices: Floats) -> Floats:
    """Return the normal of the sheet in each branch, (b, 3), across which the surface lies nearest; 0 of round ones."""
    found = np.zeros((skeleton.count, 3))
    for branch, rows in enumerate(skeleton.branches):
        points = skeleton.points[rows]
        marks = marks_of(points)
        here = places.branch == branch
        at = places.along[here] * marks[-1]
        step = np.clip(np.searchsorted(marks, at, side="right") - 1, 0, len(points) - 2)
        along = _unit(np.diff(points, axis=0))[step]
        across = vertices[here] - points[step] - (at - marks[step])[:, None] * along
        across -= (across * along).sum(axis=1)[:, None] * along
        if len(across) > len(rows):
            found[branch] = _thinnest(across, _unit(points[-1] - points[0]))
    return found


def _thinnest(across: Floats, along: Floats) -> Floats:
    """Return the direction in which (n, 3) spokes at right angles to a limb are short, or 0 if it is round."""
    size, axes, _ = stretches(across)
    least = int(np.argmax(np.abs(dot(axes, along))))  # the axis of the limb itself
    wide, thin = (axis for axis in range(3) if axis != least)
    return axes[thin] if size[thin] <= _FLAT * size[wide] else np.zeros(3)


def upright(normal: Floats) -> tuple[Floats, Floats]:
    """Return the direction in a plane that is nearest to Z, or to Y if Z is its normal, and the front."""
    axis = np.eye(3)[2 if abs(normal[2]) < 0.9 else 1]
    up = _unit(axis - dot(axis, normal) * normal)
    return up, np.cross(normal, up)


def _hinge(chain: Chain) -> Floats | None:
    """Return the axis about which a chain is bent outside of the ball at its fork, or None if it is straight."""
    begin = min(chain.rim, chain.length / 2)
    points = chain.at(np.linspace(begin, chain.length, 33))[0]
    chord = _unit(points[-1] - points[0])
    away = points - points[0]
    away -= dot(away, chord)[:, None] * chord
    far = np.linalg.norm(away, axis=1)
    if far.max() <= _BENT * chain.radius.mean():
        return None
    return _unit(np.cross(away[far.argmax()], chord))


def _front(normal: Floats, along: Floats) -> Floats:
    """Return the front of a body whose left is along a normal, or up for bones that look to the front."""
    up, front = upright(normal)
    return up if abs(float(dot(along, front))) > 0.7 else front


def _unit(vectors: Floats) -> Floats:
    length = np.sqrt(dot(vectors, vectors))[..., None]
    return vectors / np.maximum(length, np.finfo(float).tiny)
