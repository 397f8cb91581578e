# SPDX-License-Identifier: GPL-3.0-or-later
"""Place few bones along a skeleton, as riggers do: a root in the pelvis, and limbs that turn about their own joints.

The root bone leads from the pelvis along the spine to the rim of the ball there. A limb starts where it leaves the ball
of its fork, as a thigh at the hip; what lies within the ball follows the bone that ends there. Of the chains at a fork,
one continues from that bone directly, as a neck from a spine.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..skeleton.skeleton import Skeleton
from ..small_matrices import length_of
from .joints import joints_of
from .roll import upright, ups_of
from .sides import Sides, sides_of
from .tree import Chain, trees_of

_HIPS = 0.75  # radii: the pelvis is no higher above the place between the hips; chosen: unseen
_BEFORE = 0.5  # a limb has what lies this many radii before its head, so its skin bends on both sides; chosen: rig
_LEAST = 3  # bones of a limb, so that it can be curled, as a finger
_TRIED = 24  # this many places are tried for the start of a limb, from the rim of the ball inwards


@dataclass(frozen=True, eq=False)
class Stubs:
    """A stub is a part of a branch that has no bone of its own, within the ball of a fork; it follows another bone."""

    branch: Ints  # (s,)
    # (s, 2) The stub lies between these shares of the length of the branch, the smaller first
    along: Floats
    bone: Ints  # (s,)


@dataclass(frozen=True, eq=False)
class Bones:
    """Bones form a tree for each connected part of a skeleton; parents come before their children."""

    head: Floats  # (n, 3)
    tail: Floats  # (n, 3)
    head_radius: Floats  # (n,)
    tail_radius: Floats  # (n,)
    # (n, 3) The third axis of each bone, of length 1 and at right angles to it. A limb bends about its first axis.
    up: Floats
    parent: Ints  # (n,) It is -1 for root bones
    connected: Flags  # (n,) The head is the tail of the parent
    branch: Ints  # (n,) The branch of the skeleton; it is -1 for a root bone that lies on none
    # (n, 2) The part of the branch that follows the bone lies between these shares of its length. They are those of
    # head and tail, but the first bone of a limb has also what lies just before its head.
    along: Floats
    # (n,) Bones that go on into each other along one branch have the same number. Parents have lower numbers.
    chain: Ints
    to_tip: Flags  # (n,) The chain ends in a tip
    stubs: Stubs

    @property
    def count(self) -> int:
        return len(self.parent)


@dataclass(frozen=True, eq=False)
class Body:
    """A body is a connected part of a skeleton as a rig sees it."""

    tree: list[Chain]
    sides: Sides
    goes_on: list[int]  # The chain that continues from the end of each chain, or -1
    spine: int  # The chain that continues from the root bone, or -1: all leave it to the side
    # The bones along each chain; there are none along a chain that is shorter than the balls on it. The root bone is
    # the first one along the spine.
    bones: list[list[int]]
    root: int  # The root bone


def bones_of(
    skeleton: Skeleton, per_limb: int = 0, flats: Floats | None = None
) -> tuple[Bones, list[Body]]:
    """Return the bones of a skeleton, and its connected parts, the largest first.

    Points without a branch get no bone. `per_limb` bones are along each limb, where there is room for them; 0 for as
    many as it needs. The flats are (b, 3): the normal of the sheet in each branch, or 0.
    """
    maker = _Maker(per_limb, np.zeros((skeleton.count, 3)) if flats is None else flats)
    bodies = [maker.add(tree) for tree in trees_of(skeleton)]
    return maker.bones(), bodies


class _Maker:
    """Makes bones from the root outwards."""

    def __init__(self, per_limb: int, flats: Floats) -> None:
        self._per_limb, self._flats = per_limb, flats
        self._rows: list[tuple[Floats, ...]] = []
        self._ints: list[tuple[int, int, int, bool, bool]] = []
        self._ups: list[Floats] = []
        self._stubs: list[tuple[int, float, float, int]] = []
        self._chains = 0

    def add(self, tree: list[Chain]) -> Body:
        """Add the bones of a connected part."""
        sides = sides_of(tree)
        tree = _from_hips(tree, sides)
        goes_on = [_goes_on(tree, sides, number) for number in range(len(tree))]
        spine = _goes_on(tree, sides, -1)
        if sides.found and not sides.within[spine]:
            spine = -1  # a root bone on one side would break the symmetry
        body = Body(tree, sides, goes_on, spine, [[] for _ in tree], len(self._ints))
        ends = [-1] * len(tree)  # the bone on which what starts at the end of each chain hangs
        if spine < 0:
            self._add_root_alone(body)
        else:
            self._add_spine(body)
            ends[spine] = body.bones[spine][-1]
        counts = _counts(body, self._per_limb)
        for number, chain in enumerate(tree):
            if number != spine:
                hangs_on = ends[chain.parent] if chain.parent >= 0 else body.root
                ends[number] = self._add_chain(body, number, hangs_on, counts[number])
        return body

    def _add_root_alone(self, body: Body) -> None:
        """Add a root bone in the plane between the sides that lies on no chain."""
        place, radius = body.tree[0].points[0], body.tree[0].radius[0]
        up = upright(body.sides.normal)
        joints = np.stack((place, place + radius * up[0])), np.full(2, radius), np.zeros(2)
        self._add_bones([], -1, joints, up[1][None], -1, False, False)

    def _add_spine(self, body: Body) -> None:
        """Add the root bone, within its ball, and the bones that go on from it along the spine."""
        chain = body.tree[body.spine]
        away = np.linalg.norm(chain.points - chain.points[0], axis=1)
        rim = float(np.interp(chain.radius[0], away, chain.marks))
        tried = np.linspace(min(rim, chain.length), chain.length, _TRIED + 1)
        points, radius, _ = chain.at(tried)
        long = np.linalg.norm(points - chain.points[0], axis=1) >= np.maximum(radius, radius[0])
        left = np.linalg.norm(points - points[-1], axis=1) >= np.maximum(radius, radius[-1])
        fits = np.flatnonzero(long & left)
        marks = np.array([0.0, chain.length])
        if len(fits):
            rest = joints_of(chain, float(tried[fits[0]]), self._count_of(chain))
            marks = np.append(0.0, rest)
        self._add_along(body, body.spine, marks, -1, False)

    def _count_of(self, chain: Chain) -> int:
        return _count(chain, _begin(chain, True), self._per_limb)

    def _add_chain(self, body: Body, number: int, hangs_on: int, count: int) -> int:
        """Add the bones of a chain, and return the last of them; a chain too short for one leaves all to its parent."""
        chain = body.tree[number]
        before = body.goes_on[chain.parent] if chain.parent >= 0 else body.spine
        goes_on = before == number
        begin = _begin(chain, goes_on)
        if begin is None and not chain.to_tip:
            self._add_stub(chain, chain.length, hangs_on)
            return hangs_on
        marks = np.array([0.0, chain.length])
        if begin is not None:
            marks = joints_of(chain, begin, count)
        self._add_along(body, number, marks, hangs_on, goes_on)
        until = max(0.0, marks[0] - _BEFORE * float(chain.at(marks[:1])[1][0]))
        self._add_stub(chain, until, hangs_on)
        first = body.bones[number][0]
        self._rows[first][3][0] = chain.at(np.array([until]))[2][0]
        return body.bones[number][-1]

    def _add_stub(self, chain: Chain, until: float, bone: int) -> None:
        if until > 0.0:
            low, high = np.sort(chain.at(np.array([0.0, until]))[2])
            self._stubs.append((chain.branch, float(low), float(high), bone))

    def _add_along(
        self, body: Body, number: int, marks: Floats, parent: int, goes_on: bool
    ) -> None:
        chain = body.tree[number]
        points, radius, along = chain.at(marks)
        if chain.to_tip:
            points[-1] = _long_enough(points[-2], points[-1], radius[-2:])
        within = bool(body.sides.within[number])
        ups = ups_of(chain, points, body.sides, within, self._flats[chain.branch])
        tail = self._rows[parent][1] if parent >= 0 else None
        connected = goes_on and tail is not None and bool((tail == points[0]).all())
        joints = points, radius, along
        self._add_bones(
            body.bones[number], chain.branch, joints, ups, parent, connected, chain.to_tip
        )

    def _add_bones(
        self,
        found: list[int],
        branch: int,
        joints: tuple[Floats, Floats, Floats],
        ups: Floats,
        parent: int,
        connected: bool,
        to_tip: bool,
    ) -> None:
        points, radius, along = joints
        for first, (a, b) in enumerate(pairwise(range(len(points)))):
            self._rows.append((points[a], points[b], radius[[a, b]], along[[a, b]]))
            self._ints.append((parent, branch, self._chains, connected or first > 0, to_tip))
            self._ups.append(ups[a])
            parent = len(self._ints) - 1
            found.append(parent)
        self._chains += 1

    def bones(self) -> Bones:
        head, tail, radius, along = (np.array(column) for column in zip(*self._rows, strict=True))
        parent, branch, chain, connected, to_tip = (
            np.array(column) for column in zip(*self._ints, strict=True)
        )
        stubs = np.array(self._stubs, np.float64).reshape(-1, 4)
        return Bones(
            head=head,
            tail=tail,
            head_radius=radius[:, 0],
            tail_radius=radius[:, 1],
            up=np.array(self._ups),
            parent=parent.astype(np.int32),
            connected=connected.astype(bool),
            branch=branch.astype(np.int32),
            along=along,
            chain=chain.astype(np.int32),
            to_tip=to_tip.astype(bool),
            stubs=Stubs(stubs[:, 0].astype(np.int32), stubs[:, 1:3], stubs[:, 3].astype(np.int32)),
        )


def _from_hips(tree: list[Chain], sides: Sides) -> list[Chain]:
    """Return the chains of a body; those in its plane start between the hips, if the fork of the legs lies far above.

    Where legs are nearly parallel, the place of their fork says little, but not the places where they part.
    """
    pairs = [n for n, c in enumerate(tree) if c.parent < 0 and sides.partner[n] >= 0]
    if not pairs:
        return tree
    fork, radius = tree[0].points[0], tree[0].radius[0]
    largest = max(pairs, key=lambda n: (tree[n].volume, -n))
    hips = [tree[n] for n in (largest, int(sides.partner[largest]))]
    between = np.mean([chain.at(np.array([chain.rim]))[0][0] for chain in hips], axis=0)
    up = fork - between
    far = length_of(up)
    if far <= _HIPS * radius:
        return tree
    pelvis = between + up * (_HIPS * radius / far)
    return [
        _started_at(chain, pelvis) if chain.parent < 0 and sides.within[n] else chain
        for n, chain in enumerate(tree)
    ]


def _started_at(chain: Chain, place: Floats) -> Chain:
    """Return a chain that starts at another place."""
    more = length_of(chain.points[0] - place)
    return replace(
        chain,
        points=np.concatenate((place[None], chain.points)),
        radius=np.concatenate((chain.radius[:1], chain.radius)),
        along=np.concatenate((chain.along[:1], chain.along)),
        rim=chain.rim + more,
    )


def _goes_on(tree: list[Chain], sides: Sides, parent: int) -> int:
    """Return the chain that continues at the end of another one, or at the root (-1); it is -1 if there is none.

    It lies in the plane between the sides, or else leads to other forks, or else carries the largest volume.
    """
    below = [number for number, chain in enumerate(tree) if chain.parent == parent]
    if not below:
        return -1
    volume = [chain.volume for chain in tree]
    for number in range(len(tree) - 1, -1, -1):
        if tree[number].parent >= 0:
            volume[tree[number].parent] += volume[number]
    return max(below, key=lambda n: (bool(sides.within[n]), not tree[n].to_tip, volume[n], -n))


def _counts(body: Body, per_limb: int) -> list[int]:
    """Return the number of bones for each chain: a pair has equally many."""
    begins = [_begin(chain, False) for chain in body.tree]
    counts = []
    for n, chain in enumerate(body.tree):
        is_head = (
            bool(body.sides.within[n]) and chain.parent >= 0 and body.goes_on[chain.parent] == n
        )
        counts.append(_count(chain, begins[n], per_limb, 0 if is_head else _LEAST))
    for a, b in enumerate(body.sides.partner.tolist()):
        if b > a:
            both = max(counts[a], counts[b])
            counts[a] = counts[b] = min(_room(body.tree[n], begins[n], both) for n in (a, b))
    return counts


def _count(chain: Chain, begin: float | None, per_limb: int, least: int = _LEAST) -> int:
    """Return the number of bones of a chain: a limb has at least `least`, where there is room."""
    if chain.to_tip and per_limb:
        return per_limb
    needed = _room(chain, begin, 0)
    return max(needed, least) if chain.to_tip else needed


def _room(chain: Chain, begin: float | None, count: int) -> int:
    """Return the number of bones that a chain gets of those that are asked for, or of those that it needs."""
    return 0 if begin is None else len(joints_of(chain, begin, count)) - 1


def _begin(chain: Chain, goes_on: bool) -> float | None:
    """Return the length after which the first bone of a chain starts, or None if there is no room for a bone.

    It starts where it leaves the ball of its fork, or this much before that it is as long as the balls at its ends.
    """
    rim = 0.0 if goes_on else chain.rim
    marks = np.linspace(rim, 0.0, _TRIED + 1)
    points, radius, _ = chain.at(np.append(marks, chain.length))
    long = np.linalg.norm(points[:-1] - points[-1], axis=1)
    room = np.flatnonzero(long >= np.maximum(radius[:-1], radius[-1]))
    return float(marks[room[0]]) if len(room) else None


def _long_enough(head: Floats, tail: Floats, radius: Floats) -> Floats:
    """Return the tail of the last bone of a limb, farther out if the bone is shorter than the balls at its ends."""
    along = tail - head
    length = length_of(along)
    wanted = float(radius.max())
    return tail if length >= wanted or length == 0.0 else head + along * (wanted / length)
