# SPDX-License-Identifier: GPL-3.0-or-later
"""Segments for few capsules: those of many balls, merged two by two while that loses least."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Longs
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..small_matrices import dot
from .capsule_fits import fitting_radii, gaps

Element = tuple[Floats, Floats, Longs]  # see `_Merging`
Effect = tuple[Longs, NDArray[np.int8], NDArray[np.int8]]  # see `_effect`
Proposal = tuple[tuple[int, int], Element | None, Effect]

_NEAR = 10  # elements with which one may merge
_IN_BOX = 1_000_000  # places of a lattice that are looked at, at most
_BEYOND = 2.0  # times the bound: if places are farther, another bound is tried; chosen: unseen
_FIRST = 16.0  # the bound is this part of the distance at least, should the first one be 0; chosen: unseen
_LONGER = 1.25  # chosen: unseen
_NEWTON = 12  # steps; each doubles the digits
_ROUND = 16  # a round of proposals follows when one of so many elements is new


@dataclass(frozen=True, eq=False)
class Witnesses:
    """Places that tell what a choice of capsules loses."""

    places: Floats  # (q, 3) Ascending in x
    reach: Floats  # (q,) How near to a capsule each must be: 0 in the solid, a bound on the surface
    weight: Floats  # (q,) What it costs to leave it

    @staticmethod
    def of(inside: Floats, surface: Floats, bound: float) -> Witnesses:
        """A place on the surface that is farther than the bound costs more than all places inside."""
        places = np.concatenate([inside, surface])
        order = np.argsort(places[:, 0], kind="stable")
        is_surface = order >= len(inside)
        weight = np.where(is_surface, 1.0 + len(inside), 1.0)
        return Witnesses(places[order], np.where(is_surface, bound, 0.0), weight)

    def held(self, ends: Floats, radii: Floats) -> Longs:
        """Return the rows of places that one capsule, (2, 3) and (2,), is near enough to, ascending."""
        margin = radii.max() + self.reach.max(initial=0.0)
        low, high = ends.min(axis=0) - margin, ends.max(axis=0) + margin
        begin, end = np.searchsorted(self.places[:, 0], [low[0], high[0]])
        part = self.places[begin:end]
        near = np.flatnonzero(((part[:, 1:] >= low[1:]) & (part[:, 1:] <= high[1:])).all(axis=1))
        near += begin
        return near[gaps(self.places[near], ends, radii) <= self.reach[near]]


def evenly(places: Floats, count: int) -> Floats:
    """Return at most so many of the places, one in each so many rows."""
    return places[:: max(1, -(-len(places) // count))]


def places_inside(vertices: Floats, triangles: Ints, count: int) -> Floats:
    """Return about so many places of a cubic lattice in a solid; fewer if its box is very much larger than it."""
    low, size = vertices.min(axis=0), np.ptp(vertices, axis=0)
    a, b, c = np.moveaxis(vertices[triangles] - low, 1, 0)
    volume = abs(float(dot(a, np.cross(b, c)).sum())) / 6.0
    box = float(size[0] * size[1] * size[2])
    places = low + lattice(size.tolist(), cube_root(max(volume / count, box / _IN_BOX)))
    with own_errors() as module:
        return places[np.asarray(module.winding_number(places, vertices, triangles)) > 0.5]


def lattice(size: list[float], step: float) -> Floats:
    """Return the places of a lattice in a box at 0, with about this step."""
    steps = _steps(size, step)
    axes = [(np.arange(n) + 0.5) * (length / n) for n, length in zip(steps, size, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _steps(size: list[float], step: float) -> list[int]:
    """Return how many steps of about this length fit in a box; of a longer one, if there were too many places."""
    while math.prod(steps := [max(1, round(length / step)) for length in size]) > _IN_BOX:
        step *= _LONGER
    return steps


def cube_root(number: float) -> float:
    """Return the cube root of a positive number by Newton's method; that of the C library differs between systems."""
    root = math.ldexp(1.0, math.frexp(number)[1] // 3 + 1)
    for _ in range(_NEWTON):
        root = (2.0 * root + number / (root * root)) / 3.0
    return root


class _Changes:
    """The changes that may be made next: two elements become one, or an element goes.

    A change loses a place, or gains it, if so many elements hold it as `need` says.
    """

    def __init__(self) -> None:
        self.gone: list[tuple[int, int]] = []
        self.new: list[Element | None] = []
        self.closed = np.zeros(0, np.bool_)
        self._owner = np.zeros(0, np.int64)
        self._place = np.zeros(0, np.int64)
        self._need = np.zeros(0, np.int8)
        self._sign = np.zeros(0, np.int8)

    def add(self, proposals: list[Proposal]) -> None:
        """Add tuples of the elements that go, of the new one or None, and of what `_effect` says."""
        if not proposals:
            return
        first = len(self.gone)
        self.gone += [gone for gone, _, _ in proposals]
        self.new += [new for _, new, _ in proposals]
        effects = [effect for _, _, effect in proposals]
        owner = np.repeat(np.arange(len(effects)) + first, [len(effect[0]) for effect in effects])
        columns = [np.concatenate(column) for column in zip(*effects, strict=True)]
        self._owner = np.concatenate([self._owner, owner])
        self._place = np.concatenate([self._place, columns[0]])
        self._need = np.concatenate([self._need, columns[1]])
        self._sign = np.concatenate([self._sign, columns[2]])
        self.closed = np.concatenate([self.closed, np.zeros(len(effects), np.bool_)])

    def close(self, elements: tuple[int, int]) -> None:
        """Forget the changes of these elements."""
        self.closed |= np.isin(np.array(self.gone), elements).any(axis=1)
        kept = ~self.closed[self._owner]
        self._owner, self._place = self._owner[kept], self._place[kept]
        self._need, self._sign = self._need[kept], self._sign[kept]

    def cheapest(self, holders: Ints, weight: Floats) -> int:
        """Return the row of the change that loses least, of equal ones the first."""
        acts = holders[self._place] == self._need
        loss = np.where(acts, self._sign * weight[self._place], 0.0)
        cost = np.bincount(self._owner, loss, minlength=len(self.gone))
        return int(np.where(self.closed, np.inf, cost).argmin())


class _Merging:
    """Balls and capsules that become fewer: the elements, each with its ends, its radii and the places it holds."""

    def __init__(
        self,
        centres: Floats,
        radii: Floats,
        surface: Any,
        witnesses: Witnesses,
        tapered: bool,
        progress: Progress | None,
    ) -> None:
        self.ends = np.repeat(centres[:, None], 2, axis=1)
        self.radii = np.repeat(radii[:, None], 2, axis=1)
        self.lives = np.ones(len(radii), np.bool_)
        self._surface, self._witnesses = surface, witnesses
        self._tapered, self._progress = tapered, progress
        self._held = [witnesses.held(*one) for one in zip(self.ends, self.radii, strict=True)]
        self._holders = np.zeros(len(witnesses.places), np.int32)
        for rows in self._held:
            self._holders[rows] += 1
        self._changes = _Changes()

    def until(self, count: int) -> None:
        """Merge and leave out until so many are left."""
        fresh = list(range(len(self.lives)))
        while (left := int(self.lives.sum())) > count:
            if len(fresh) * _ROUND >= left:
                self._propose(fresh)
                fresh = []
            fresh += self._apply(self._changes.cheapest(self._holders, self._witnesses.weight))
            fresh = [row for row in fresh if self.lives[row]]

    def farthest(self) -> float:
        """Return how far the farthest place on the surface is, or 0 if all are within the bound."""
        bare = (self._holders == 0) & (self._witnesses.reach > 0.0)
        places = self._witnesses.places[bare]
        away = np.full(len(places), np.inf)
        for row in np.flatnonzero(self.lives):
            away = np.minimum(away, gaps(places, self.ends[row], self.radii[row]))
        return float(away.max(initial=0.0))

    def _propose(self, rows: list[int]) -> None:
        """Add the changes of new elements: each may go, or merge with one that is near."""
        none = np.zeros(0, np.int64)
        self._changes.add([((i, i), None, self._effect(i, i, none)) for i in rows])
        pairs = sorted({(min(i, j), max(i, j)) for i in rows for j in self._near(i)})
        owner, ends = self._segments(pairs)
        if not len(owner):
            return
        part = self._progress.part(0.1) if self._progress else None
        radii, fits = fitting_radii(ends, self._surface, self._tapered, part)
        proposals: list[Proposal] = []
        for row in np.flatnonzero(fits):
            held = self._witnesses.held(ends[row], radii[row])
            i, j = pair = pairs[owner[row]]
            proposals.append((pair, (ends[row], radii[row], held), self._effect(i, j, held)))
        self._changes.add(proposals)

    def _near(self, row: int) -> Longs:
        """Return the elements that are nearest by the distance between balls at ends."""
        rows = np.flatnonzero(self.lives)
        away = self.ends[rows, :, None] - self.ends[row]
        gap = np.sqrt(dot(away, away)) - self.radii[rows, :, None] - self.radii[row]
        order = rows[np.argsort(gap.min(axis=(1, 2)), kind="stable")]
        return order[order != row][:_NEAR]

    def _segments(self, pairs: list[tuple[int, int]]) -> tuple[NDArray, NDArray]:
        """Return all segments from an end of one element to an end of the other, and the row of the pair of each."""
        if not pairs:
            return np.zeros(0, np.int64), np.zeros((0, 2, 3))
        first, second = (self.ends[[pair[k] for pair in pairs]] for k in (0, 1))
        ends = np.stack([first[:, [0, 0, 1, 1]], second[:, [0, 1, 0, 1]]], axis=2)
        ball = [(each[:, 0] == each[:, 1]).all(axis=1) for each in (first, second)]
        twice = np.zeros((len(pairs), 4), np.bool_)  # a ball has one end
        twice[:, 2:] |= ball[0][:, None]
        twice[:, 1::2] |= ball[1][:, None]
        owner = np.repeat(np.arange(len(pairs))[:, None], 4, axis=1)
        return owner[~twice], ends[~twice]

    def _effect(self, i: int, j: int, held: Longs) -> Effect:
        """Return places, how many elements must hold each for it to change, and 1 if it is lost, -1 if gained."""
        before = np.concatenate([self._held[i], self._held[j]]) if i != j else self._held[i]
        before, holders = np.unique(before, return_counts=True)
        lost = ~np.isin(before, held, assume_unique=True)
        gained = np.setdiff1d(held, before, assume_unique=True)
        need = np.concatenate([holders[lost], np.zeros(len(gained), np.int64)])
        sign = np.repeat(np.array([1, -1], np.int8), [int(lost.sum()), len(gained)])
        return np.concatenate([before[lost], gained]), need.astype(np.int8), sign

    def _apply(self, row: int) -> list[int]:
        """Make a change; return the new element, if there is one."""
        (i, j), new = self._changes.gone[row], self._changes.new[row]
        self._changes.close((i, j))
        for gone in {i, j}:
            self.lives[gone] = False
            self._holders[self._held[gone]] -= 1
        if new is None:
            return []
        self.ends[i], self.radii[i], self._held[i] = new
        self.lives[i] = True
        self._holders[self._held[i]] += 1
        return [i]


def segments_of(
    centres: Floats,
    radii: Floats,
    count: int,
    surface: tuple[Floats, Ints],
    places: tuple[Floats, Floats],
    bound: float,
    tapered: bool,
    progress: Progress | None = None,
) -> tuple[Floats, Floats]:
    """Return few capsules that hold most of what many balls do: (s, 2, 3) ends and (s, 2) radii; a ball has equal ends.

    Two elements, balls or capsules, become one capsule from an end of one to an end of the other, or one of them is
    left out, whichever loses least, until there are `count`. (p, 3) places in the solid and (q, 3) on its surface tell
    what is lost; the surface is (v, 3) points and (f, 3) triangles. A place on it may be as far from the capsules as
    the bound says. If one must be farther than twice that, the bound is doubled, and all begins anew. Tapered capsules
    may have two radii.
    """
    with own_errors() as module:
        tree = module.TriangleTree(*surface)
    while True:
        witnesses = Witnesses.of(*places, bound)
        merging = _Merging(centres, radii, tree, witnesses, tapered, progress)
        merging.until(count)
        farthest = merging.farthest()
        if farthest <= _BEYOND * bound:
            break
        bound = max(2.0 * bound, farthest / _FIRST)
    return merging.ends[merging.lives], merging.radii[merging.lives]
