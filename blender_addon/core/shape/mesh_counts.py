# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of faces and of connected parts of a shape, and how the parts lie to each other."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from ..machine import native
from .bent_sheets import bent_sheets
from .shape import TURNED, Shape

_MOST_ROWS = 1000  # of the table of parts


class Place(IntEnum):
    """How a connected part lies to the others, as `_medial.part_places` numbers it."""

    APART = 0
    TOUCHING = 1
    WITHIN = 2
    OVERLAPPING = 3
    SHEET = 4


@dataclass(frozen=True)
class PartCounts:
    """A connected part of the faces, with its number from 1, in the order of the first faces of all parts."""

    part: int
    faces: int
    turned: int  # The number of its faces that were read the other way round
    open: bool
    # `apart`, `touching`, `within` (another part), `overlapping` or `sheet` (without thickness)
    place: str


@dataclass(frozen=True)
class MeshCounts:
    """The numbers of faces, of connected parts, and of parts of a kind."""

    faces: int
    parts: int
    open: int = 0
    turned: int = 0  # Parts with faces that were read the other way round
    # Parts that share some of their volume with others; together they are one solid
    overlapping: int = 0
    # Parts that lie inside another one; that only touch others; that do neither
    within: int = 0
    touching: int = 0
    apart: int = 0
    sheets: int = 0  # Parts without thickness
    table: tuple[PartCounts, ...] = ()  # The first parts, at most `_MOST_ROWS`; empty for one part

    def __str__(self) -> str:
        """Return a sentence; it is empty for one part."""
        if self.parts < 2:
            return ""
        kinds = (
            (self.open, f"{self.open:,} of them open"),
            (self.turned, f"{self.turned:,} of them with faces that were turned"),
            (self.overlapping, f"{self.overlapping:,} of them overlapping others"),
            (self.within, f"{self.within:,} of them inside another"),
            (self.touching, f"{self.touching:,} of them only touching others"),
            (self.apart, f"{self.apart:,} of them apart from all others"),
            (self.sheets, f"{self.sheets:,} of them without thickness"),
        )
        told = [words for count, words in kinds if count]
        return "; ".join((f"{self.parts:,} connected parts", *told))


def mesh_counts(shape: Shape) -> MeshCounts | None:
    """Count the connected parts of a shape as it was given or read; None where there are no faces."""
    if not len(shape.triangles):
        return None
    with native.own_errors() as module:
        part, is_open, place = module.part_places(shape.points, shape.triangles)
    if is_open.any():
        place = np.where(bent_sheets(shape, part, len(place)), np.uint8(Place.SHEET), place)
    known, count = part >= 0, len(place)
    turned = np.zeros(len(part), bool) if shape.reading is None else shape.reading == TURNED
    faces_of = np.bincount(part[known], minlength=count)
    turned_of = np.bincount(part[known & turned], minlength=count)
    lying = np.bincount(place, minlength=len(Place)).tolist()
    names = np.array([kind.name.lower() for kind in Place])
    columns = (faces_of, turned_of, is_open, names[place])
    rows = zip(*(column[:_MOST_ROWS].tolist() for column in columns), strict=True)
    table = tuple(PartCounts(number, *row) for number, row in enumerate(rows, 1))
    return MeshCounts(
        faces=len(part),
        parts=count,
        open=int(np.count_nonzero(is_open)),
        turned=int(np.count_nonzero(turned_of)),
        overlapping=lying[Place.OVERLAPPING],
        within=lying[Place.WITHIN],
        touching=lying[Place.TOUCHING],
        apart=lying[Place.APART],
        sheets=lying[Place.SHEET],
        table=table if count > 1 else (),
    )
