# SPDX-License-Identifier: GPL-3.0-or-later
"""This module computes the centre of mass of a solid."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from .skeleton import Skeleton


def centre_of_mass(skeleton: Skeleton) -> Floats:
    """Return the centre of mass, (3,), of tubes along the edges and balls at single points.

    It needs no faces, so open or self-intersecting ones do not disturb it.
    """
    a, b = skeleton.edges.T
    length = np.linalg.norm(skeleton.points[a] - skeleton.points[b], axis=1)
    r, s = skeleton.radius[a], skeleton.radius[b]
    volume = np.pi * length * (r * r + r * s + s * s) / 3
    singles = np.setdiff1d(np.arange(len(skeleton.points)), skeleton.edges)
    places = np.concatenate(
        ((skeleton.points[a] + skeleton.points[b]) / 2, skeleton.points[singles])
    )
    alone = skeleton.radius[singles]
    volume = np.concatenate((volume, 4 / 3 * np.pi * alone * alone * alone))
    return np.average(places, axis=0, weights=volume)
