# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that step back: a new object that fills the place of others is seen alone, until these are shown again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import bpy

from .output_object import is_gone, source_of


def others_of(made: bpy.types.Object) -> list[bpy.types.Object]:
    """The objects from which another was made, the nearest first, as far as this view layer has them."""
    found = []
    thing = source_of(made)
    while not is_gone(thing) and thing not in found:
        found.append(thing)
        thing = source_of(thing)
    return [thing for thing in found if thing.name in bpy.context.view_layer.objects]


def are_back(made: bpy.types.Object) -> bool:
    """Return whether all of these are hidden in this view layer."""
    others = others_of(made)
    return bool(others) and all(thing.hide_get() for thing in others)


def step_back(made: bpy.types.Object, back: bool) -> None:
    """Hide them in this view layer, or show them."""
    for thing in others_of(made):
        thing.hide_set(back)


@contextmanager
def seen(things: Iterable[bpy.types.Object]) -> Iterator[None]:
    """Show objects, and those from which they were made, while these are read: Blender does not evaluate what is
    hidden."""
    layer = bpy.context.view_layer
    wanted = {other for thing in things for other in (thing, *others_of(thing))}
    hidden = [thing for thing in wanted if thing.name in layer.objects and thing.hide_get()]
    try:
        for thing in hidden:
            thing.hide_set(False)
        layer.update()
        yield
    finally:
        for thing in hidden:
            thing.hide_set(True)
