# SPDX-License-Identifier: GPL-3.0-or-later
"""This module makes every radius of a net that of the ball that fits, which is the distance to the surface."""

from __future__ import annotations

import numpy as np

from ..curves.depth import Depth
from ..curves.net import Net


def inscribe(net: Net, depth: Depth, plane: float | None = None) -> None:
    """Make every radius of a net the distance to the surface.

    Parameters
    ----------
    net : Net
    depth : Depth
    plane : float, optional
        The net is symmetric in X at this plane. Its radii remain so: they are those of balls that fit on both sides.
    """
    used = np.unique(np.concatenate([*net.branches.values(), list(net.at)]).astype(np.int64))
    places = net.points[used]
    net.radius[used] = depth(places)
    if plane is not None:
        places[:, 0] = 2.0 * plane - places[:, 0]
        net.radius[used] = np.minimum(net.radius[used], depth(places))
