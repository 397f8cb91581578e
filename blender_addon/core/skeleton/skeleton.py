# SPDX-License-Identifier: GPL-3.0-or-later
"""A skeleton consists of arrays: points with radii, and the branches that they form."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..small_matrices import placed
from ..united import united


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A skeleton has branches between nodes; nodes are tips, forks and points without a branch."""

    points: Floats  # (p, 3)
    radius: Floats  # (p,) The radius of the ball around each point, in the unit of the input
    # (b + 1,) Branch i has the points branch_points[branch_offsets[i] : branch_offsets[i + 1]]
    branch_offsets: Ints
    # (c,) Rows of `points`, from node to node. A loop starts and ends at the same row.
    branch_points: Ints
    # (k,) Rows of `points`, ascending: all ends of branches, and points without a branch
    nodes: Ints
    # (j, 2) Rows of `points`, nearest to the ends of gaps inside the solid across which pieces were joined
    joins: Ints = field(default_factory=lambda: np.empty((0, 2), np.int32))

    @property
    def gaps(self) -> Floats:
        """Return the lengths of the joins, (j,)."""
        return np.linalg.norm(np.diff(self.points[self.joins], axis=1)[:, 0], axis=1)

    @property
    def branches(self) -> list[Ints]:
        """Return the points of each branch."""
        return np.split(self.branch_points, self.branch_offsets[1:-1]) if self.count else []

    @property
    def count(self) -> int:
        """Return the number of branches."""
        return len(self.branch_offsets) - 1

    @property
    def edges(self) -> Ints:
        """Return the pairs of neighbours along the branches, (e, 2), branch after branch."""
        pairs = np.column_stack((self.branch_points[:-1], self.branch_points[1:]))
        within = np.ones(len(pairs), bool)
        within[self.branch_offsets[1:-1] - 1] = False
        return pairs[within]

    @property
    def degree(self) -> Longs:
        """Return the number of edges at each point, (p,): 1 at tips, 3 or more at forks."""
        return np.bincount(self.edges.ravel(), minlength=len(self.points))

    @property
    def tips(self) -> int:
        """Return the number of tips."""
        return int((self.degree == 1).sum())

    @property
    def loops(self) -> int:
        """Return the number of independent loops."""
        return len(self.edges) - len(self.points) + self.pieces

    @property
    def pieces(self) -> int:
        """Return the number of connected parts."""
        return len(np.unique(united(len(self.points), self.edges)))

    @property
    def length(self) -> float:
        """Return the length of all branches together."""
        steps = np.diff(self.points[self.edges], axis=1)[:, 0]
        return float(np.linalg.norm(steps, axis=1).sum())

    def placed(self, frame: Floats) -> Skeleton:
        """Return the skeleton moved and turned by a (4, 4) matrix."""
        return replace(self, points=placed(self.points, frame))


def skeleton_of(points: Floats, radius: Floats, branches: list[Longs], singles: Longs) -> Skeleton:
    """Return a skeleton of the points that `branches` and `singles` use; both are rows of `points`."""
    used = np.unique(np.concatenate([*branches, singles]).astype(np.int64))
    row = np.full(len(points), -1, np.int64)
    row[used] = np.arange(len(used))
    ends = [end for branch in branches for end in (branch[0], branch[-1])]
    offsets = np.cumsum([0, *(len(branch) for branch in branches)])
    return Skeleton(
        points=points[used],
        radius=radius[used],
        branch_offsets=offsets.astype(np.int32),
        branch_points=row[np.concatenate([*branches, used[:0]])].astype(np.int32),
        nodes=row[np.unique(np.concatenate([ends, singles])).astype(np.int64)].astype(np.int32),
    )


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
