# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes or skeletons of several frames as objects of which one is shown at a time.

Their visibility is keyed, so that viewport, render and render farm show the right one without this add-on:
nothing runs when the frame changes.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...core.axis.colours import radius_range
from ...core.axis.medial_axis import MedialAxis
from ...core.errors import InvalidInputError
from ...core.files.load_axis import load_axis
from ...core.skeleton.load_skeleton import load_skeleton
from ...core.skeleton.skeleton import Skeleton
from ..mesh import stored
from ..mesh.attributes import RADIUS, read_attribute
from ..mesh.colours import colour_mesh, remember_colours
from ..mesh.material import dress, radius_material
from ..mesh.write_mesh import new_axis_mesh
from ..nodes.wires import show_wires
from ..objects.output_object import collection_of
from .skeleton_object import check_size, fill_curve, new_curve

AXES, SKELETONS = ".npz", ".json"

_NAME = re.compile(r"(.*?)(?:_(-?\d+)|[.-]?(\d+))")  # a minus belongs to a number behind _ only


def sequences(paths: Iterable[Path]) -> list[tuple[str, dict[int, Path]]]:
    """Return (name, {frame: path}) of each sequence among some files; the reports next to them are passed over.

    Raises InvalidInputError where a name has no number, or another extension.
    """
    outputs = [path for path in paths if not _is_report(path)]
    for path in outputs:
        if path.suffix.lower() not in _KINDS:
            raise InvalidInputError(
                f"Expected .npz of medial axes or .json of skeletons, found '{path.name}'; choose others"
            )
    return [
        found
        for form in _KINDS
        for found in by_frame(p for p in outputs if p.suffix.lower() == form).items()
    ]


def _is_report(path: Path) -> bool:
    return path.suffix.lower() == ".json" and Path(path.stem).suffix.lower() in _KINDS


def by_frame(paths: Iterable[Path]) -> dict[str, dict[int, Path]]:
    """{name: {frame: path}} of files named as `Body_0012.npz`, frames ascending.

    Raises InvalidInputError where a name has no number.
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

    Each is shown from its frame to the next one's; the first also before, the last also after. The files of the frames,
    ascending, are all `.npz` of medial axes, or all `.json` of skeletons.
    """
    form = next(iter(files.values())).suffix.lower()
    loaded = [_KINDS[form].load(path) for path in files.values()]  # a broken file leaves nothing
    made: list[bpy.types.Object] = []
    try:
        for frame, found in zip(files, loaded, strict=True):
            made.append(_KINDS[form].make(f"{name} {frame:04d}", found))
            made[-1][stored.SEQUENCE_FRAME] = frame
    except BaseException:
        _remove(made)
        raise
    _KINDS[form].finish(made)
    _key_visibility(made, list(files))
    marks = {stored.SEQUENCE: name, stored.SEQUENCE_FORMAT: form}
    collection = collection_of(
        marks, name + _KINDS[form].suffix, earlier={stored.SEQUENCE_FORMAT: AXES}
    )
    _remove(list(collection.objects))
    for thing in made:
        collection.objects.link(thing)
    scene = bpy.context.scene
    scene.frame_set(scene.frame_current)  # shows the right one
    return collection


def _new_axis(name: str, axis: MedialAxis) -> bpy.types.Object:
    thing = bpy.data.objects.new(name, new_axis_mesh(axis, name))
    dress(thing, radius_material())
    thing.show_in_front = True
    show_wires(thing, axis)
    thing[stored.RADIUS_MIN], thing[stored.RADIUS_MAX] = (
        float(axis.radius.min()),
        float(axis.radius.max()),
    )
    return thing


def _load_skeleton(path: Path) -> Skeleton:
    skeleton = load_skeleton(path)
    check_size(skeleton)
    return skeleton


def _new_skeleton(name: str, skeleton: Skeleton) -> bpy.types.Object:
    curve = new_curve(name)
    fill_curve(curve, skeleton)
    thing = bpy.data.objects.new(name, curve)
    thing.show_in_front = True
    thing[stored.ENDS], thing[stored.LOOPS], thing[stored.BRANCHES] = (
        skeleton.tips,
        skeleton.loops,
        skeleton.count,
    )
    return thing


def _same_colours(things: list[bpy.types.Object]) -> None:
    """One range of radii for all frames, so that colours do not flicker."""
    lowest, highest = (
        min(t[stored.RADIUS_MIN] for t in things),
        max(t[stored.RADIUS_MAX] for t in things),
    )
    start, end = radius_range([lowest, highest])
    for thing in things:
        thing[stored.RADIUS_MIN], thing[stored.RADIUS_MAX] = lowest, highest
        radii = read_attribute(thing.data.attributes, RADIUS.name, RADIUS.type, RADIUS.domain)
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


def _remove(things: list[bpy.types.Object]) -> None:
    """Remove objects of a sequence with what they show and their keys; objects that an artist added stay."""
    for thing in things:
        if stored.SEQUENCE_FRAME not in thing:
            continue
        shape, keys = thing.data, thing.animation_data and thing.animation_data.action
        bpy.data.objects.remove(thing)
        if shape.users == 0:
            is_curve = isinstance(shape, bpy.types.Curve)
            (bpy.data.curves if is_curve else bpy.data.meshes).remove(shape)
        if keys and keys.users == 0:
            bpy.data.actions.remove(keys)


@dataclass(frozen=True)
class _Kind:
    """The kind of the files of a sequence: the end of its collection's name, and how they are read and made objects."""

    suffix: str
    load: Callable[[Path], Any]
    make: Callable[[str, Any], bpy.types.Object]
    finish: Callable[[list[bpy.types.Object]], None] = lambda _: None


_KINDS = {
    AXES: _Kind(" Medial Axis Sequence", load_axis, _new_axis, _same_colours),
    SKELETONS: _Kind(" Skeleton Sequence", _load_skeleton, _new_skeleton),
}
