# SPDX-License-Identifier: GPL-3.0-or-later
"""Place few bones along a skeleton: joints lie at its nodes and bends, and the bones form a tree from a root."""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..small_matrices import length_of
from .simplify import kept_points

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .skeleton import Skeleton

ERROR = 0.5  # a bone may deviate from the curve by this share of the local radius
ROOT = -1  # a root bone has this branch


@dataclass(frozen=True, eq=False)
class Bones:
    """Bones form a tree for each connected part of a skeleton; parents come before their children.

    Parameters
    ----------
    head, tail : (n, 3) float64
        The head of a bone is the tail of its parent. A bone that closes a loop shares its tail with another bone.
    head_radius, tail_radius : (n,) float64
    parent : (n,) int32
        It is -1 for root bones, which end in the joint from which all other bones of their part go out.
    branch : (n,) int32
        The branch of the skeleton; it is -1 for root bones.
    along : (n, 2) float64
        The head and the tail lie at these shares of the length of the branch.
    chain : (n,) int32
        Bones that go on into each other along one branch have the same number; root bones have their own.
    to_tip : (n,) bool
        The chain ends in a tip.
    """

    head: NDArray[np.float64]
    tail: NDArray[np.float64]
    head_radius: NDArray[np.float64]
    tail_radius: NDArray[np.float64]
    parent: NDArray[np.int32]
    branch: NDArray[np.int32]
    along: NDArray[np.float64]
    chain: NDArray[np.int32]
    to_tip: NDArray[np.bool_]

    @property
    def count(self) -> int:
        return len(self.parent)


@dataclass(frozen=True)
class _Segment:
    """A segment joins two neighbouring joints of a branch; `ends` are rows of the points of the skeleton."""

    ends: tuple[int, int]
    branch: int
    along: tuple[float, float]
    length: float

    def turned(self) -> _Segment:
        return _Segment(self.ends[::-1], self.branch, self.along[::-1], self.length)


def bones_of(skeleton: Skeleton, centre: NDArray[np.float64]) -> Bones:
    """Return the bones of a skeleton; the root is the joint nearest to a centre, such as that of mass.

    Parameters
    ----------
    skeleton : Skeleton
        Points without a branch get no bone.
    centre : (3,) float64
    """
    segments = _segments(skeleton)
    at: dict[int, list[int]] = {}
    for number, segment in enumerate(segments):
        for end in segment.ends:
            at.setdefault(end, []).append(number)
    maker = _Maker(skeleton)
    for root in _by_distance(skeleton, sorted(at), centre):
        if root not in maker.bone_to:
            maker.grow(root, segments, at)
    return maker.bones()


def _segments(skeleton: Skeleton) -> list[_Segment]:
    found = []
    for branch, rows in enumerate(skeleton.branches):
        points = skeleton.points[rows]
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        along = np.concatenate(([0.0], np.cumsum(steps))) / max(steps.sum(), np.finfo(float).tiny)
        kept = kept_points(points, ERROR * skeleton.radius[rows])
        for a, b in pairwise(kept.tolist()):
            length = length_of(points[b] - points[a])
            ends, shares = (int(rows[a]), int(rows[b])), (float(along[a]), float(along[b]))
            found.append(_Segment(ends, branch, shares, length))
    return found


def _by_distance(skeleton: Skeleton, joints: list[int], centre: NDArray[np.float64]) -> list[int]:
    """Return the joints sorted by their distance from the centre."""
    away = np.linalg.norm(skeleton.points[joints] - centre, axis=1)
    return [joints[i] for i in np.argsort(away, kind="stable")]


class _Maker:
    """Makes bones from the root outwards."""

    def __init__(self, skeleton: Skeleton) -> None:
        self._skeleton, self._degree = skeleton, skeleton.degree
        self._rows: list[
            tuple[_Segment | None, int, int, int]
        ] = []  # a row is (segment, joint, parent, chain)
        self.bone_to: dict[int, int] = {}  # it maps a joint to the bone that ends there
        self._chains = 0

    def grow(self, root: int, segments: list[_Segment], at: dict[int, list[int]]) -> None:
        """Add a root bone and its descendants, nearest joints first; the remaining segments close loops."""
        self.bone_to[root] = self._add(None, root, -1)
        queue, used = [(0.0, root)], set()
        while queue:
            so_far, joint = heapq.heappop(queue)
            for number in at[joint]:
                segment = segments[number]
                segment = segment if segment.ends[0] == joint else segment.turned()
                if number in used:
                    continue
                used.add(number)
                bone = self._add(segment, segment.ends[1], self.bone_to[joint])
                if segment.ends[1] not in self.bone_to:
                    self.bone_to[segment.ends[1]] = bone
                    heapq.heappush(queue, (so_far + segment.length, segment.ends[1]))

    def _add(self, segment: _Segment | None, joint: int, parent: int) -> int:
        self._rows.append((segment, joint, parent, self._chain(segment, parent)))
        return len(self._rows) - 1

    def _chain(self, segment: _Segment | None, parent: int) -> int:
        before = self._rows[parent][0] if parent >= 0 else None
        if (
            segment
            and before
            and before.branch == segment.branch
            and before.along[1] == segment.along[0]
        ):
            return self._rows[parent][3]
        self._chains += 1
        return self._chains - 1

    def bones(self) -> Bones:
        points, radius = self._skeleton.points, self._skeleton.radius
        joints = np.array([joint for _, joint, _, _ in self._rows], np.int64)
        heads = np.array([s.ends[0] if s else joint for s, joint, _, _ in self._rows], np.int64)
        is_root = np.array([s is None for s, *_ in self._rows], bool)
        chain = np.array([chain for *_, chain in self._rows], np.int32)
        down = is_root[:, None] * radius[joints][:, None] * np.array([0.0, 0.0, 1.0])
        tips = np.isin(chain, chain[(self._degree[joints] == 1) & ~is_root])
        return Bones(
            head=points[heads] - down,
            tail=points[joints],
            head_radius=radius[heads],
            tail_radius=radius[joints],
            parent=np.array([parent for _, _, parent, _ in self._rows], np.int32),
            branch=np.array([s.branch if s else ROOT for s, *_ in self._rows], np.int32),
            along=np.array([s.along if s else (0.0, 0.0) for s, *_ in self._rows]).reshape(-1, 2),
            chain=chain,
            to_tip=tips & ~is_root,
        )
