# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes of several frames as objects of which one is shown at a time.

Their visibility is keyed, so that viewport, render and render farm show the right one without this add-on:
nothing runs when the frame changes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import bpy
import numpy as np

from ..core.axis.colours import radius_range
from ..core.axis.medial_axis import MedialAxis
from ..core.errors import InvalidInputError
from ..core.files.load_axis import load_axis
from .attributes import RADIUS
from .colours import colour_mesh, remember_colours
from .material import FLAT, RADIUS_MAX, RADIUS_MIN, radius_material
from .wires import show_wires
from .write_mesh import new_axis_mesh

SUFFIX = " Medial Axis Sequence"
SEQUENCE = "ma_sequence"
FRAME = "ma_frame"

_NAME = re.compile(r"(.*?)(?:_(-?\d+)|[.-]?(\d+))")  # a minus belongs to a number behind _ only


def by_frame(paths: Iterable[Path]) -> dict[str, dict[int, Path]]:
    """{name: {frame: path}} of files named as `Body_0012.npz`, frames ascending.

    Raises
    ------
    InvalidInputError
        A name without a number.
    """
    found: dict[str, dict[int, Path]] = {}
    for path in paths:
        match = _NAME.fullmatch(path.stem)
        if match is None:
            raise InvalidInputError(
                f"Expected names that end in the number of a frame, found '{path.name}'; rename it"
            )
        name, frame, other = match.groups()
        found.setdefault(name, {})[int(frame or other)] = path
    return {name: dict(sorted(frames.items())) for name, frames in found.items()}


def write_sequence(name: str, files: dict[int, Path]) -> bpy.types.Collection:
    """A collection with one object per frame, in place of the one that it was before; all or nothing.

    Each is shown from its frame to the next one's; the first also before, the last also after.

    Parameters
    ----------
    name : str
    files : dict of int to Path
        `.npz` of each frame, ascending.

    Raises
    ------
    ReadError, InvalidInputError
    """
    made: list[bpy.types.Object] = []
    try:
        for frame, path in files.items():
            made.append(_new_object(f"{name} {frame:04d}", load_axis(path), frame))
    except BaseException:
        _remove(made)
        raise
    _same_colours(made)
    _key_visibility(made, list(files))
    collection = _collection(name)
    _remove(list(collection.objects))
    for thing in made:
        collection.objects.link(thing)
    scene = bpy.context.scene
    scene.frame_set(scene.frame_current)  # shows the right one
    return collection


def _new_object(name: str, axis: MedialAxis, frame: int) -> bpy.types.Object:
    mesh = new_axis_mesh(axis, name)
    mesh.materials.append(radius_material())
    thing = bpy.data.objects.new(name, mesh)
    thing.color = FLAT
    thing.show_in_front = True
    show_wires(thing, axis)
    thing[FRAME] = frame
    thing[RADIUS_MIN], thing[RADIUS_MAX] = float(axis.radius.min()), float(axis.radius.max())
    return thing


def _same_colours(things: list[bpy.types.Object]) -> None:
    """One range of radii for all frames, so that colours do not flicker."""
    lowest, highest = min(t[RADIUS_MIN] for t in things), max(t[RADIUS_MAX] for t in things)
    start, end = radius_range([lowest, highest])
    for thing in things:
        thing[RADIUS_MIN], thing[RADIUS_MAX] = lowest, highest
        radii = np.empty(len(thing.data.vertices), np.float32)
        thing.data.attributes[RADIUS.name].data.foreach_get("value", radii)
        colour_mesh(thing.data, radii, start, end)
        remember_colours(thing, RADIUS.name, start, end)


def _key_visibility(things: list[bpy.types.Object], frames: list[int]) -> None:
    for i, thing in enumerate(things):
        hidden = {frames[i]: False}
        if i > 0:
            hidden[frames[i] - 1] = True
        if i + 1 < len(frames):
            hidden[frames[i + 1]] = True
        for frame, hide in hidden.items():
            thing.hide_viewport = thing.hide_render = hide
            for path in ("hide_viewport", "hide_render"):
                thing.keyframe_insert(path, frame=frame)


def _collection(name: str) -> bpy.types.Collection:
    """The collection of a sequence of this name, made where there is none."""
    for collection in bpy.data.collections:
        if collection.get(SEQUENCE) == name and collection.library is None:
            return collection
    collection = bpy.data.collections.new(name + SUFFIX)
    collection[SEQUENCE] = name
    bpy.context.scene.collection.children.link(collection)
    return collection


def _remove(things: list[bpy.types.Object]) -> None:
    """Remove objects of a sequence with their meshes and keys; objects that an artist added stay."""
    for thing in things:
        if FRAME not in thing:
            continue
        mesh, keys = thing.data, thing.animation_data and thing.animation_data.action
        bpy.data.objects.remove(thing)
        if mesh.users == 0:
            bpy.data.meshes.remove(mesh)
        if keys and keys.users == 0:
            bpy.data.actions.remove(keys)
