# SPDX-License-Identifier: GPL-3.0-or-later
"""The wires of a level as a net, whose points carry the surface that they own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Floats, Longs
from ..samples.analysed import Analysed
from .ends import Balls
from .net import Net
from .owners import owners, shares


@dataclass(frozen=True, eq=False)
class LoadedNet:
    """A net, and the samples that its points own."""

    net: Net  # Its points are the vertices of the level
    owner: Longs  # (n,) The point that owns each sample
    balls: Balls  # The balls of the samples, by their owners
    # (p,) The mean spacing of the samples that each point owns; that of all samples where it owns
    # none
    spacing: Floats


def loaded_net(
    samples: Analysed, hierarchy: Any, level: Any, anchored: Iterable[int] = ()
) -> LoadedNet:
    """Return the net of the wires of a level.

    The hierarchy and its level are those of the module; anchored points are as of `Net`.
    """
    owner, balls = owners(samples, hierarchy, level)
    spacing, share = shares(samples)
    count = len(level.vertices)
    net = Net(
        level.vertices,
        level.radius,
        level.wires,
        level.points,
        np.bincount(owner, weights=share, minlength=count).astype(np.float64),
        anchored,
    )
    return LoadedNet(net, owner, balls, _mean_of_owned(owner, spacing, count))


def genuine_loops(samples: Analysed) -> int:
    """Return the number of loops that the closed faces have; 0 where they are not closed."""
    return 0 if samples.by_faces is None else samples.by_faces[1]


def _mean_of_owned(owner: Longs, values: Floats, count: int) -> Floats:
    """Return the mean value of the samples that each point owns, (count,); a point without samples gets that of all."""
    owned = np.bincount(owner, minlength=count)
    total = np.bincount(owner, weights=values, minlength=count)
    return np.where(owned > 0, total / np.maximum(owned, 1), values.mean())
