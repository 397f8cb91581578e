# SPDX-License-Identifier: GPL-3.0-or-later
"""Few capsules of little volume that hold a solid: its places are divided into groups, each with its least capsule."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..machine.native import own_errors
from ..small_matrices import dot, length_of
from .capsule_fits import gaps
from .capsule_segments import cube_root, evenly, lattice

_ROUNDS = 8  # of places that go to the capsule nearest to them, at most
_MOST_DIVIDED = 16  # more capsules are at least as tight where balls were merged
_NEAR = 6  # capsules with which one may be united
_BORDER = 1 / 32  # of the radius: borders between capsules move so much; chosen: unseen
_EXCHANGES = 3  # of places between two halves
_DIVIDED = 4_000  # places that tell where to divide
_LATTICE = 20_000  # places on which the volume of a union is counted


@dataclass(frozen=True, eq=False)
class Capsules:
    """Capsules round groups of places."""

    ends: Floats  # (k, 2, 3)
    radii: Floats  # (k, 2)
    # (n,) The capsule of each place, where they were made round places
    group: Ints = field(default_factory=lambda: np.empty(0, np.int32))

    @staticmethod
    def round(places: Floats, group: Ints, tapered: bool) -> Capsules:
        """Make the least capsule of each group; groups that have no place go."""
        kept, group = np.unique(group, return_inverse=True)
        group = group.astype(np.int32)
        with own_errors() as module:
            ends, radii = module.least_capsules(places, group, count=len(kept), tapered=tapered)
        return Capsules(ends.reshape(-1, 2, 3), radii.reshape(-1, 2), group)

    def nearest(self, places: Floats) -> tuple[Ints, Floats]:
        """Return the nearest capsule of each place, and how far it is; negative inside."""
        nearest = np.zeros(len(places), np.int32)
        least = np.full(len(places), np.inf)
        for row, (ends, radii) in enumerate(zip(self.ends, self.radii, strict=True)):
            away = gaps(places, ends, radii)
            nearer = away < least
            nearest[nearer], least[nearer] = row, away[nearer]
        return nearest, least

    def only(self, rows: list[int]) -> Capsules:
        """Return some of the capsules."""
        return Capsules(self.ends[rows], self.radii[rows])

    def pairs(self) -> list[tuple[int, int]]:
        """Return the rows of each two whose ends or middles are near, ascending."""
        marks = np.concatenate([self.ends, self.ends.mean(axis=1)[:, None]], axis=1).reshape(-1, 3)
        found = set()
        for row, (ends, radii) in enumerate(zip(self.ends, self.radii, strict=True)):
            away = gaps(marks, ends, radii).reshape(-1, 3).min(axis=1) - self.radii.max(axis=1)
            order = np.argsort(away, kind="stable")
            near = [int(other) for other in order[order != row][:_NEAR]]
            found |= {(min(row, other), max(row, other)) for other in near}
        return sorted(found)

    def volume(self) -> float:
        """Return the volume of the union, as counted on a lattice in its box."""
        most = self.radii.max(axis=1)[:, None]
        low = (self.ends.min(axis=1) - most).min(axis=0)
        size = (self.ends.max(axis=1) + most).max(axis=0) - low
        places = low + lattice(size.tolist(), cube_root(float(size.prod()) / _LATTICE))
        held = np.count_nonzero(self.nearest(places)[1] <= 0.0)
        return float(held / len(places) * size.prod())


def tight_capsules(
    places: Floats, count: int, tapered: bool, start: tuple[Floats, Floats]
) -> list[Capsules]:
    """Return one or two choices of at most so many capsules that hold all places and whose union has little volume.

    One beginning is given. For the other, if they are few, the capsule whose division saves most is divided in two,
    until there are twice as many or nothing is saved, and those that add least are united. Then each place goes to the
    capsule that is nearest to it, and each capsule is made anew, as long as the volume shrinks.

    Parameters
    ----------
    places : (n, 3) float64
    count : int
    tapered : bool
    start : (k, 2, 3) float64, (k, 2) float64
        Ends and radii of capsules to begin with.
    """
    merged = Capsules(*start)
    begun = [merged]
    if count <= _MOST_DIVIDED:
        begun.append(_divided(evenly(places, _DIVIDED), count, tapered))
    return [_settled(places, one.nearest(places)[0], tapered) for one in begun]


def _divided(places: Floats, count: int, tapered: bool) -> Capsules:
    """Return capsules of the parts into which places are divided, one after the other, twice as many as are wanted."""
    parts = [_Part.of(places, np.arange(len(places)), tapered)]
    while len(parts) < 2 * count:
        saved = [part.saved for part in parts]
        row = int(np.argmax(saved))
        if not saved[row] > 0.0:
            break
        parts[row : row + 1] = [_Part.of(places, rows, tapered) for rows in parts[row].halves]
    return _shifted(places, _united(places, [part.rows for part in parts], count, tapered), tapered)


def _united(places: Floats, parts: list[Longs], count: int, tapered: bool) -> list[Longs]:
    """Return parts after the two whose union adds least volume have become one, until there are so many."""
    added: dict[tuple[int, int], float] = {}
    names = list(range(len(parts)))
    fresh = len(parts)
    while len(parts) > count:
        found = _of_parts(places, parts, tapered)
        pairs = found.pairs()
        keys = [(names[i], names[j]) for i, j in pairs]
        for (i, j), key in zip(pairs, keys, strict=True):
            if key not in added:
                whole = _of_parts(places, [np.concatenate([parts[i], parts[j]])], tapered)
                added[key] = whole.volume() - found.only([i, j]).volume()
        i, j = pairs[int(np.argmin([added[key] for key in keys]))]
        parts = [
            *(part for k, part in enumerate(parts) if k not in (i, j)),
            np.concatenate([parts[i], parts[j]]),
        ]
        names = [*(name for k, name in enumerate(names) if k not in (i, j)), fresh]
        fresh += 1
    return parts


def _shifted(places: Floats, parts: list[Longs], tapered: bool) -> Capsules:
    """Return capsules after the border between each two has moved as long as they became smaller."""
    parts = list(parts)
    found = _of_parts(places, parts, tapered)
    for i, j in found.pairs():
        rows = np.concatenate([parts[i], parts[j]])
        group = _shifted_border(places[rows], len(parts[i]), tapered)
        parts[i], parts[j] = rows[group == 0], rows[group == 1]
    return _of_parts(places, parts, tapered)


def _shifted_border(places: Floats, first: int, tapered: bool) -> Ints:
    """Return the better group of each place; the first ones begin in the first group."""
    best = Capsules.round(places, (np.arange(len(places)) >= first).astype(np.int32), tapered)
    least, part = best.volume(), 0.5
    while part > _BORDER and len(best.radii) == 2:
        step = part * best.radii.max()
        ahead = gaps(places, best.ends[0], best.radii[0]) - gaps(
            places, best.ends[1], best.radii[1]
        )
        tried = [
            Capsules.round(places, (ahead > by).astype(np.int32), tapered) for by in (-step, step)
        ]
        volumes = [one.volume() for one in tried]
        row = int(np.argmin(volumes))
        if volumes[row] < least and len(tried[row].radii) == 2:
            best, least = tried[row], volumes[row]
        else:
            part /= 2.0
    return best.group


def _of_parts(places: Floats, parts: list[Longs], tapered: bool) -> Capsules:
    """Return the least capsule of each part."""
    rows = np.concatenate(parts)
    group = np.repeat(np.arange(len(parts), dtype=np.int32), [len(part) for part in parts])
    return Capsules.round(places[rows], group, tapered)


@dataclass(frozen=True, eq=False)
class _Part:
    """Rows of places, the two groups into which they are best divided, and the volume that this saves."""

    rows: Longs
    halves: tuple[Longs, Longs]
    saved: float

    @staticmethod
    def of(places: Floats, rows: Longs, tapered: bool) -> _Part:
        part = places[rows]
        whole = Capsules.round(part, np.zeros(len(part), np.int32), tapered)
        tried = [
            _divided_along(part, way, tapered)
            for way in _directions(whole.ends[0, 1] - whole.ends[0, 0])
        ]
        volumes = [one.volume() for one in tried]
        best = tried[int(np.argmin(volumes))]
        halves = rows[best.group == 0], rows[best.group == 1]
        return _Part(rows, halves, whole.volume() - min(volumes) if len(halves[1]) else 0.0)


def _directions(along: Floats) -> list[Floats]:
    """Return a direction and four that are perpendicular to it, evenly turned."""
    length = length_of(along)
    along = along / length if length > 0.0 else np.array([1.0, 0.0, 0.0])
    aside = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    aside = aside / length_of(aside)
    third = np.cross(along, aside)
    return [along, aside, third, aside + third, aside - third]


def _divided_along(places: Floats, way: Floats, tapered: bool) -> Capsules:
    """Divide places in the middle of their extent along a direction, then a few times by the nearer capsule."""
    height = dot(places, way)
    group = (height > (height.min() + height.max()) / 2.0).astype(np.int32)
    found = Capsules.round(places, group, tapered)
    for _ in range(_EXCHANGES):
        found = Capsules.round(places, found.nearest(places)[0], tapered)
    return found


def _settled(places: Floats, group: Ints, tapered: bool) -> Capsules:
    """Return capsules after places have gone to the nearest one, and these were made anew, while they shrink."""
    best = Capsules.round(places, group, tapered)
    least = best.volume()
    for _ in range(_ROUNDS):
        group = best.nearest(places)[0]
        if (group == best.group).all():
            break
        other = Capsules.round(places, group, tapered)
        if not (volume := other.volume()) < least:
            break
        best, least = other, volume
    return best
