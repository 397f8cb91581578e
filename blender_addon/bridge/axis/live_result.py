# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes that follow their sources: which these are, and how one is read and written again."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
from mathutils import Matrix

from ...core.errors import MedialAxisError
from ...core.settings import Look
from ...core.shape.shape import Shape
from ..mesh import stored
from ..objects.output_object import follow, is_gone, source_of
from ..objects.read_object import read_object
from ..objects.source_state import forget_answer, remember_state, state_of
from .axis_object import look_of, result_of, write_result
from .shown_axis import Computed

LIVE = "medial_axis_auto_update"  # a property of every object; off where it was never set

# A coarse answer leaves these as they were: the next computation asks for them.
_NOT_COARSE = (stored.SECONDS, stored.of_option("crisp"))


@dataclass(frozen=True)
class LiveSource:
    """The source of a result as it was at one moment: its shape, and its matrix.

    `name` and `look` are those of the result; `state` is the shape and the scale, as in `source_state`.
    """

    name: str
    shape: Shape
    world: Matrix
    state: tuple[str, list[float]] | None
    look: Look


def can_be_live(result: bpy.types.Object) -> bool:
    """Return whether a result belongs to a whole source, and is the one that the next computation of it updates."""
    source = source_of(result)
    return not is_gone(result) and not is_gone(source) and result_of(source) == result


def live_results() -> list[bpy.types.Object]:
    """The results that have Auto Update on."""
    return [
        thing for thing in bpy.data.objects if getattr(thing, LIVE, False) and can_be_live(thing)
    ]


def is_at_rest(result: bpy.types.Object) -> bool:
    """Return whether a result and its source are in object mode, and Blender evaluates the visible source."""
    source = source_of(result)
    return result.mode == source.mode == "OBJECT" and source.visible_get()


def read_live(result: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> LiveSource:
    """Read the source of a result as it is now."""
    source = source_of(result)
    shape = read_object(source, depsgraph)
    world = source.evaluated_get(depsgraph).matrix_world.copy()
    return LiveSource(result.name, shape, world, state_of(source, depsgraph), look_of(result))


def write_live(read: LiveSource, found: Computed, is_coarse: bool) -> None:
    """Give a result the axis of its source as it was read; nothing, where the result is gone or live no more.

    A coarse result stays outdated, as the panel says, until the full one is there.
    """
    result = bpy.data.objects.get(read.name)
    if result is None or result not in live_results():
        return
    if found.shown is None:
        raise MedialAxisError(found.warnings[-1])
    source, look = source_of(result), look_of(result)
    kept = {name: result[name] for name in _NOT_COARSE if name in result}
    shown = found.shown if look == read.look else None
    write_result(source, found.computation, read.shape.frame, look, between_steps=True, shown=shown)
    follow(result, source, read.world, look.parent)
    if is_coarse:
        for name, value in kept.items():
            result[name] = value
        result[stored.DRAFT] = True
        forget_answer(result)
    else:
        remember_state(result, read.state)
