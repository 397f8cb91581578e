# SPDX-License-Identifier: GPL-3.0-or-later
"""Where somebody is better than we are: of each case and measure the best of the others, and what it pays for it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from . import recipes
from .solids import SOLIDS

Row = dict[str, Any]

ACCURACY = ("mean", "p99", "largest")
COVERAGE = ("missed_mean", "missed_largest")
WORDS = {
    "mean": "off, mean",
    "p99": "off, 99 %",
    "largest": "off, largest",
    "missed_mean": "missed, mean",
    "missed_largest": "missed, largest",
}
MARGIN = 1.1
"""What is nearer than a tenth is no difference: other seeds give as much."""
FLOOR = 1e-6
"""Below this share of the solids' size everybody is exact."""
PRICE = 1e-5
"""What is smaller is no price: we are stricter with ourselves."""


@dataclass(frozen=True)
class Loss:
    """A row of somebody that is better than ours in one measure. `pays`: where the same program is worse than ours, as
    words; empty where it is as good or better in all other measures."""

    theirs: Row
    ours: Row
    measure: str
    pays: str

    @property
    def ratio(self) -> float:
        return self.ours[self.measure] / max(self.theirs[self.measure], FLOOR)


def key(row: Row) -> tuple:
    return row["solid"], row["size"], row["noisy"], row["outer"]


def scored(rows: Iterable[Row]) -> list[Row]:
    return [row for row in rows if "failed" not in row]


def rival_of(row: Row, ours: dict[tuple, list[Row]]) -> Row | None:
    """Ours from the same input: the default form; outside, the only one; from normals where they were given."""
    name = "ours, clean, normals" if row["program"] in _with_normals() else "ours, clean"
    name = "ours, as published" if row["outer"] else name
    found = [x for x in ours.get(key(row), []) if x["program"] == name]
    return found[0] if found else None


@cache
def _with_normals() -> frozenset[str]:
    return frozenset(recipe.name for recipe in recipes.read() if recipe.gets == "normals")


def losses(rows: list[Row]) -> list[Loss]:
    """The best of the others in each case and measure, where it is better than ours; topology aside."""
    best: dict[tuple, Loss] = {}
    for loss in _all(scored(rows)):
        place = (*key(loss.theirs), loss.measure, loss.pays == "", loss.ours["program"])
        if place not in best or loss.ratio > best[place].ratio:
            best[place] = loss
    return list(best.values())


def _all(rows: list[Row]) -> Iterator[Loss]:
    ours: dict[tuple, list[Row]] = {}
    for row in rows:
        if row["group"] == "ours":
            ours.setdefault(key(row), []).append(row)
    for row in rows:
        own = rival_of(row, ours) if row["group"] != "ours" else None
        if own is None:
            continue
        for measure in (*ACCURACY, *COVERAGE):
            if better(row[measure], own[measure]):
                yield Loss(row, own, measure, _paid(row, own, measure))


def better(a: float | None, b: float | None) -> bool:
    if a is None or b is None or a != a or b != b:
        return False
    return max(a, FLOOR) * MARGIN < b


def _paid(theirs: Row, own: Row, measure: str) -> str:
    """Where ours is better by the largest factor; or what else is wrong with theirs."""
    others = [m for m in (*ACCURACY, *COVERAGE) if m != measure]
    worse = [m for m in others if theirs[m] > PRICE and better(own[m], theirs[m])]
    if worse:
        most = max(worse, key=lambda m: theirs[m] / max(own[m], FLOOR))
        return f"{WORDS[most]}: {theirs[most]:.1e}, ours {own[most]:.1e}"
    if theirs["faces"] + theirs["edges"] == 0:
        return "loose points"
    if theirs["outer"]:
        return ""
    if exact(own) and not exact(theirs):
        return "wrong topology"
    truth = SOLIDS[theirs["solid"]].area
    if truth and theirs["area"] > 1.5 * truth:
        return f"{theirs['area'] / truth:.1f} times the area"
    return ""


def exact(row: Row) -> bool:
    """The Betti numbers are those of the solid."""
    return row["betti"] is not None and tuple(row["betti"]) == SOLIDS[row["solid"]].shape.betti
