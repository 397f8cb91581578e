# SPDX-License-Identifier: GPL-3.0-or-later
"""An item of a batch divided into the connected parts of its mesh, with numbered outputs."""

from __future__ import annotations

from dataclasses import replace

from ..samples.mesh_parts import PartShape, split
from ..settings import Settings
from ..shape.own_frame import in_own_frame
from ..shape.shape import Shape
from .batch import Item


def items_of_parts(item: Item, settings: Settings) -> list[Item]:
    """Read an item and return an item for each connected part of its mesh that has thickness.

    The first one has the warnings of the whole.
    """
    given, warnings = item.read()
    shape, _ = in_own_frame(given)
    found = split(shape, settings)

    def item_of(part: PartShape, said: tuple[str, ...]) -> Item:
        output = item.output.with_stem(f"{item.output.stem}_{found.words(part.number)}")

        def read() -> tuple[Shape, tuple[str, ...]]:
            return part.shape, said

        return replace(item, output=output, read=read, part=part.number)

    first, *others = found.parts
    return [item_of(first, (*warnings, *found.warnings)), *(item_of(p, ()) for p in others)]
