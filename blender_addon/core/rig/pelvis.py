# SPDX-License-Identifier: GPL-3.0-or-later
"""This module finds the pelvis: the node of a skeleton from which all bones go out.

It is the fork with the thickest ball. Of forks that are nearly as thick, it is the one with the longest limb, for legs
and tails are longer than arms. A skeleton without a fork starts at its thicker end.
"""

from __future__ import annotations

import numpy as np

from ..skeleton.skeleton import Skeleton

_AS_THICK = 0.9  # a ball is nearly as thick as the thickest if it has this share of its radius; chosen: unseen


def pelvis_of(
    skeleton: Skeleton, nodes: list[int], at: dict[int, list[int]], ends: list[tuple[int, int]]
) -> int:
    """Return the pelvis of a connected part of a skeleton.

    Parameters
    ----------
    skeleton : Skeleton
    nodes : list of int
        The nodes of the part, ascending.
    at : dict of int to list of int
        The branches at each node.
    ends : list of (int, int)
        The nodes at the ends of each branch.
    """
    degree = skeleton.degree
    forks = [node for node in nodes if degree[node] > 2] or nodes
    radius = skeleton.radius[forks]
    thick = [node for node in forks if skeleton.radius[node] >= _AS_THICK * radius.max()]
    limbs = [
        max(
            (_length(skeleton, b) for b in at[node] if (degree[list(ends[b])] == 1).any()),
            default=0.0,
        )
        for node in thick
    ]
    return thick[int(np.argmax(limbs))]


def _length(skeleton: Skeleton, branch: int) -> float:
    steps = np.diff(skeleton.points[skeleton.branches[branch]], axis=0)
    return float(np.linalg.norm(steps, axis=1).sum())
