# SPDX-License-Identifier: GPL-3.0-or-later
"""A skeleton becomes a tree of chains from a root outwards; loops are opened where they are farthest from the root."""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Floats
from ..curves.smooth_line import at_marks, marks_of
from ..skeleton.skeleton import Skeleton

_FAR = 4.0  # chains are compared up to this many radii from their fork; chosen: unseen
_SAMPLES = 65  # at this many places
_AS_THICK = 0.9  # a ball is nearly as thick as the thickest if it has this share of its radius; chosen: unseen


@dataclass(frozen=True, eq=False)
class Chain:
    """A chain is a branch, or half of one that closes a loop, from its start towards the tips."""

    branch: int
    points: Floats  # (n, 3)
    radius: Floats  # (n,)
    # (n,) The points lie at these shares of the length of the branch; they descend where the chain runs against it
    along: Floats
    # The chain at whose end this one starts; -1 at a root. Parents come before their children.
    parent: int
    from_root: float  # The length of the way from the root to the start
    to_tip: bool  # The chain ends in a tip
    # After this length the chain has left the balls of its fork, and of the other chains there, for good
    rim: float = 0.0
    marks: Floats = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "marks", marks_of(self.points))

    @property
    def length(self) -> float:
        return float(self.marks[-1])

    @property
    def volume(self) -> float:
        """Return the volume of the tube along the chain."""
        square = self.radius**2
        return float(np.pi * (np.diff(self.marks) * (square[:-1] + square[1:]) / 2).sum())

    def at(self, marks: Floats) -> tuple[Floats, Floats, Floats]:
        """Return points, radii and shares of the branch at some lengths from the start."""
        table = np.column_stack((self.points, self.radius, self.along))
        found = at_marks(marks, self.marks, table)
        return found[:, :3].copy(), found[:, 3].copy(), found[:, 4].copy()


def trees_of(skeleton: Skeleton) -> list[list[Chain]]:
    """Return the chains of each connected part of a skeleton, those of the largest volume first."""
    ends = [(int(rows[0]), int(rows[-1])) for rows in skeleton.branches]
    at: dict[int, list[int]] = {}
    for branch, pair in enumerate(ends):
        for node in dict.fromkeys(pair):
            at.setdefault(node, []).append(branch)
    trees, seen = [], set()
    for node in sorted(at):
        if node not in seen:
            piece = _connected(node, ends, at)
            seen |= piece
            root = pelvis_of(skeleton, sorted(piece), at, ends)
            trees.append(_tree(skeleton, root, ends, at))
    return sorted(trees, key=lambda tree: -sum(chain.volume for chain in tree))


def _connected(node: int, ends: list[tuple[int, int]], at: dict[int, list[int]]) -> set[int]:
    found, left = {node}, [node]
    while left:
        for branch in at[left.pop()]:
            new = set(ends[branch]) - found
            found |= new
            left += new
    return found


def _tree(
    skeleton: Skeleton, root: int, ends: list[tuple[int, int]], at: dict[int, list[int]]
) -> list[Chain]:
    whole = {
        branch: _chain(skeleton, branch)
        for node in _connected(root, ends, at)
        for branch in at[node]
    }
    away, through = _nearest_first(root, ends, at, {b: c.length for b, c in whole.items()})
    degree = skeleton.degree
    found: list[Chain] = []
    arrives = {root: -1}
    for node in away:  # from the root outwards
        for branch in at[node]:
            start, end = ends[branch]
            if through.get(node) == branch and start != end:
                continue  # it leads here
            for turned in [False, True] if start == end else [start != node]:
                chain = whole[branch]
                chain = _turned(chain) if turned else chain
                other = start if turned else end
                if through.get(other) == branch and start != end:
                    arrives[other] = len(found)
                    is_tip = bool(degree[other] == 1)
                else:
                    half = (away[other] + chain.length - away[node]) / 2
                    chain, is_tip = _until(chain, half), False
                place = {"parent": arrives[node], "from_root": away[node], "to_tip": is_tip}
                found.append(replace(chain, **place))
    return [replace(chain, rim=_rim(found, number)) for number, chain in enumerate(found)]


def _rim(tree: list[Chain], number: int) -> float:
    """Return the length after which a chain is in no ball of another chain at its fork."""
    chain = tree[number]
    others = [other for n, other in enumerate(tree) if other.parent == chain.parent and n != number]
    balls = [_near(other, chain.radius[0], 0.0) for other in others]
    if chain.parent >= 0:
        parent = tree[chain.parent]
        balls.append(_near(parent, chain.radius[0], parent.length))
    balls.append((chain.points[:1], chain.radius[:1]))
    points, radius = (np.concatenate(column) for column in zip(*balls, strict=True))
    marks = np.linspace(0.0, min(chain.length, _FAR * chain.radius[0]), _SAMPLES)
    away = np.linalg.norm(chain.at(marks)[0][:, None] - points, axis=2) - radius
    inside = np.flatnonzero((away <= 0.0).any(axis=1))
    last = int(inside[-1])
    if last == len(marks) - 1:
        return float(marks[-1])
    before, after = away[last].min(), away[last + 1].min()
    return float(marks[last] + (marks[last + 1] - marks[last]) * before / (before - after))


def _near(chain: Chain, radius: float, mark: float) -> tuple[Floats, Floats]:
    """Return points and radii of a chain near one of its ends."""
    far = _FAR * radius
    marks = np.linspace(max(0.0, mark - far), min(chain.length, mark + far), _SAMPLES)
    return chain.at(marks)[:2]


def _chain(skeleton: Skeleton, branch: int) -> Chain:
    rows = skeleton.branches[branch]
    points = skeleton.points[rows]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate(([0.0], np.cumsum(steps))) / max(steps.sum(), np.finfo(float).tiny)
    return Chain(branch, points, skeleton.radius[rows], along, -1, 0.0, False)


def _turned(chain: Chain) -> Chain:
    whole = chain.points[::-1], chain.radius[::-1], chain.along[::-1]
    return Chain(chain.branch, *whole, -1, 0.0, False)


def _until(chain: Chain, length: float) -> Chain:
    """Return the first part of a chain."""
    kept = max(1, int(np.searchsorted(chain.marks, length)))
    first = chain.points[:kept], chain.radius[:kept], chain.along[:kept]
    last = chain.at(np.array([length]))
    points, radius, along = (np.concatenate(pair) for pair in zip(first, last, strict=True))
    return Chain(chain.branch, points, radius, along, -1, 0.0, False)


def _nearest_first(
    root: int, ends: list[tuple[int, int]], at: dict[int, list[int]], length: dict[int, float]
) -> tuple[dict[int, float], dict[int, int]]:
    """Return how far each node is from the root, nearest first, and the branch that leads there."""
    away: dict[int, float] = {}
    through: dict[int, int] = {}
    queue = [(0.0, root, -1)]
    while queue:
        so_far, node, branch = heapq.heappop(queue)
        if node in away:
            continue
        away[node] = so_far
        if branch >= 0:
            through[node] = branch
        for leaving in at[node]:
            start, end = ends[leaving]
            heapq.heappush(
                queue, (so_far + length[leaving], end if start == node else start, leaving)
            )
    return away, through


def pelvis_of(
    skeleton: Skeleton, nodes: list[int], at: dict[int, list[int]], ends: list[tuple[int, int]]
) -> int:
    """Return the pelvis of a connected part: the node, of ascending `nodes`, from which all bones go out.

    It is the fork with the thickest ball. Of forks that are nearly as thick, it is the one with the longest limb, for
    legs and tails are longer than arms. A skeleton without a fork starts at its thicker end. `at` has the branches at
    each node, `ends` the nodes at the ends of each branch.
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
