# SPDX-License-Identifier: GPL-3.0-or-later
"""Hides a medial axis when its source is hidden, and shows it again with its source.

Blender does not hide children with their parent, and no driver can do it: visibility in one view layer (the eye,
which H closes) is not a property that can be driven. So only a *change* of the source is passed on: an axis that an
artist hides or shows stays so until the source is hidden or shown the next time, and an axis that was hidden before
its source is not shown with it. Visibility in renders is not changed, because a source is usually taken out of a
render in order to render the axis. The state is kept in two custom properties of the axis, so that undo, copies and
files keep it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import bpy

from .axis_object import is_result
from .output_object import source_of

SOURCE_HIDDEN = (
    "ma_source_hidden"  # the ways in which its source was hidden at the last look, a word per line
)
HIDDEN_WITH_SOURCE = "ma_hidden_with_source"  # the ways in which the axis was hidden with it


@dataclass(frozen=True)
class _Way:
    """One way of hiding an object: for all viewports, or in a view layer."""

    word: str
    layer: bpy.types.ViewLayer | None = None

    def hides(self, thing: bpy.types.Object) -> bool:
        if self.layer is not None:
            return thing.hide_get(view_layer=self.layer)
        return getattr(thing, self.word)

    def set(self, thing: bpy.types.Object, hidden: bool) -> None:
        if self.layer is None:
            setattr(thing, self.word, hidden)
        elif thing.name in self.layer.objects:
            thing.hide_set(hidden, view_layer=self.layer)


def hide_with_sources(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> None:
    """Hide or show every axis that is the child of its source, where that was hidden or shown since the last call."""
    ways = (
        _Way("hide_viewport"),
        _Way(f"{scene.name}/{layer.name}", layer),
    )
    for axis in list(_followers()):
        _hide_with(axis, axis.parent, ways)


def _followers() -> Iterator[bpy.types.Object]:
    """The medial axes that are children of their source; a parent that an artist chose hides nothing."""
    for thing in bpy.data.objects:
        if thing.parent is None or thing.library is not None or not is_result(thing):
            continue
        if source_of(thing) == thing.parent:
            yield thing


def _hide_with(axis: bpy.types.Object, source: bpy.types.Object, ways: tuple[_Way, ...]) -> None:
    first = SOURCE_HIDDEN not in axis
    seen, together = _words(axis, SOURCE_HIDDEN), _words(axis, HIDDEN_WITH_SOURCE)
    now = {way.word for way in ways if way.hides(source)}
    for way in () if first else ways:
        if way.word in now - seen and not way.hides(axis):
            way.set(axis, True)
            together.add(way.word)
        elif way.word in seen - now and way.word in together:
            way.set(axis, False)
            together.discard(way.word)
    now |= seen - {way.word for way in ways}  # other view layers
    if first or now != seen:
        axis[SOURCE_HIDDEN], axis[HIDDEN_WITH_SOURCE] = _text(now), _text(together)


def _words(axis: bpy.types.Object, name: str) -> set[str]:
    return set(axis.get(name, "").splitlines())


def _text(words: set[str]) -> str:
    return "\n".join(sorted(words))
