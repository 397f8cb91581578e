# SPDX-License-Identifier: GPL-3.0-or-later
"""A part of a surface belongs to one branch of the skeleton; vertices also have a position along it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..curves.net import Net


@dataclass(frozen=True, eq=False)
class Places:
    """Places are positions along branches."""

    branch: Ints  # (n,) It is -1 for places at a point without a branch
    along: Floats  # (n,) The share of the branch before it: 0 at its start, 1 at its end

    def of(self, rows: Longs) -> Places:
        """Return the places of some rows."""
        return Places(self.branch[rows], self.along[rows])


@dataclass(frozen=True, eq=False)
class Parts:
    """Parts assign vertices and faces of a surface to branches."""

    vertices: Places  # The places of the vertices
    # (m,) The branch of each triangle: that of most of its corners, otherwise of the first; -1 as in `Places`
    faces: Ints


def places(net: Net, names: list[int]) -> Places:
    """Return the place of each point of a net; a fork belongs to the thickest of its branches.

    The names of branches are in order: the first is branch 0.
    """
    branch, along = np.full(len(net.points), -1, np.int32), np.zeros(len(net.points))
    thickness = {name: float(net.radius[net.branches[name]].mean()) for name in names}
    for number, name in sorted(enumerate(names), key=lambda item: (thickness[item[1]], item[0])):
        chain = net.branches[name]
        steps = np.linalg.norm(np.diff(net.points[chain], axis=0), axis=1)
        branch[chain] = number
        total = max(float(steps.sum()), float(np.finfo(float).tiny))
        along[chain] = np.concatenate(([0.0], np.cumsum(steps))) / total
    return Places(branch, np.minimum(along, 1.0))


def parts_of(vertices: Places, triangles: Ints) -> Parts:
    """Return the parts of a surface whose vertices are at some places."""
    a, b, c = vertices.branch[triangles].T
    return Parts(vertices, np.where(b == c, b, a).astype(np.int32))
