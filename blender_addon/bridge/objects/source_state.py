# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the source of an output has changed since the output was made.

The state of a source is what an output depends on: the shape as Blender shows it and its scale, but not its place.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import InvalidInputError
from ..mesh import stored
from ..mesh.mesh_arrays import read_corners, read_positions
from .output_object import is_gone, is_torn, source_of
from .read_object import split_transform

_ROUNDING = 1e-5  # share of the scale that is lost where a matrix in float32 is turned
_SELDOM = 20.0  # a check is repeated after this many times its own duration
_VALUES = {"BOOLEAN", "INT", "FLOAT", "STRING", "ENUM"}
_NO_SHAPE = {
    "name",
    "tag",
    "use_fake_user",
    "use_extra_user",
    "is_active",
    "show_expanded",
    "show_render",
    "show_in_editmode",
    "show_on_cage",
    "eval_time",
    "use_path",
    "path_duration",
    "use_path_follow",
    "use_path_clamp",
    "use_auto_texspace",
    "texspace_location",
    "texspace_size",
}
_checked: dict[str, tuple[float, bool]] = {}  # an output -> when to check again, and what was found


def state_of(
    source: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[str, list[float]] | None:
    """Return the state of a source; None where it cannot be known now, in edit mode or where it is hidden."""
    evaluated = source.evaluated_get(depsgraph)
    if source.mode == "EDIT" or evaluated == source or not source.visible_get():
        return None
    try:
        _, rest = split_transform(np.array(evaluated.matrix_world, np.float64))
    except InvalidInputError:
        return None
    digest = hashlib.blake2b(digest_size=16)
    for numbers in _numbers(evaluated):
        digest.update(numbers.tobytes())
    return digest.hexdigest(), rest.ravel().tolist()


def remember_state(output: bpy.types.Object, state: tuple[str, list[float]] | None) -> None:
    """Store the state that the source had when it was read."""
    if state is not None:
        output[stored.SOURCE_STATE], output[stored.SOURCE_SCALE] = state
    else:
        output.pop(stored.SOURCE_STATE, None)
    forget_answer(output)


def forget_answer(output: bpy.types.Object) -> None:
    """Have the next `has_changed` look again."""
    _checked.pop(output.name, None)


@contextmanager
def same_state(source: bpy.types.Object) -> Iterator[None]:
    """Work that is done meanwhile, such as binding to bones at rest, does not make the outputs of a source outdated."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    fresh = [
        thing
        for thing in bpy.data.objects
        if stored.SOURCE_STATE in thing
        and source_of(thing) == source
        and not differs(thing, depsgraph)
    ]
    yield
    state = state_of(source, bpy.context.evaluated_depsgraph_get())
    for thing in fresh:
        remember_state(thing, state)


def has_changed(output: bpy.types.Object, depsgraph: bpy.types.Depsgraph | None) -> bool:
    """Return whether the source is known to have another state than when the output was made.

    Panels may call it whenever they are drawn: for large meshes the answer is up to a few seconds old.
    """
    now = time.monotonic()
    after, answer = _checked.get(output.name, (0.0, False))
    if now >= after:
        answer = depsgraph is not None and differs(output, depsgraph)
        _checked[output.name] = now + _SELDOM * (time.monotonic() - now), answer
    return answer


def differs(output: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    """The same as `has_changed`, never from memory."""
    source = source_of(output) or output  # thickness may be written on the source itself
    if is_gone(source) or stored.SOURCE_STATE not in output:
        return False
    if is_torn(output):
        return True
    state = state_of(source, depsgraph)
    if state is None:
        return False
    shape, scale = state
    before = np.array(output[stored.SOURCE_SCALE])
    same_scale = np.abs(before - scale).max() <= _ROUNDING * np.abs(before).max()
    return shape != output[stored.SOURCE_STATE] or not same_scale


def _numbers(evaluated: bpy.types.Object) -> Iterator[NDArray]:
    """All that the shape depends on; curves, texts and metaballs are judged by their settings and control points.

    Their boxes would be easier, but Blender 4.3 knows those only when the object is evaluated once more.
    """
    data = evaluated.data
    if isinstance(data, bpy.types.Mesh):
        yield read_positions(data)
        yield read_corners(data)
        return
    for settings in (data, *evaluated.modifiers):
        yield np.frombuffer(repr(_settings(settings)).encode(), np.uint8)
    for elements, name, size in _control_points(data):
        values = np.empty(len(elements) * size, np.float32)
        elements.foreach_get(name, values)
        yield values


def _settings(block: bpy.types.bpy_struct) -> list[tuple[str, Any]]:
    """The settings of a curve, a text, a metaball or a modifier, without those that change no shape."""
    found = []
    for prop in block.bl_rna.properties:
        if prop.is_readonly or prop.type not in _VALUES or prop.identifier in _NO_SHAPE:
            continue
        value = getattr(block, prop.identifier)
        if getattr(prop, "is_array", False):
            value = tuple(value)
        elif isinstance(value, set):  # whose order differs from session to session
            value = sorted(value)
        found.append((prop.identifier, value))
    return found


def _control_points(data: bpy.types.ID) -> Iterator[tuple[Any, str, int]]:
    """Collections of control points, with a name and the number of values of a property of theirs."""
    for spline in getattr(data, "splines", ()):
        yield spline.points, "co", 4
        yield spline.points, "radius", 1
        for name in ("co", "handle_left", "handle_right"):
            yield spline.bezier_points, name, 3
        yield spline.bezier_points, "radius", 1
    if isinstance(data, bpy.types.MetaBall):
        yield data.elements, "co", 3
        yield data.elements, "radius", 1
    elif points := getattr(data, "points", None):
        yield points, "co", 3
