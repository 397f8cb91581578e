# SPDX-License-Identifier: GPL-3.0-or-later
"""From inputs to items: an output each, with what reads its shape."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from ..core.batch.batch import Item
from ..core.batch.frames import at_frame, output_path
from ..core.batch.option_words import sampling_from
from ..core.batch.outputs import Files
from ..core.errors import InvalidInputError
from ..core.files.read import READERS
from ..core.samples.mesh_parts import PartShape, split
from ..core.settings import Settings
from ..core.shape.own_frame import in_own_frame
from ..core.shape.shape import Shape


def inside_blender() -> bool:
    """Whether this Python is Blender's."""
    return "bpy" in sys.modules


class UsageError(Exception):
    """Inputs and outputs do not fit together; nothing was computed."""


def check_outputs(wanted: argparse.Namespace) -> None:
    """Check all outputs that are known before Blender loads a file: none is an input, and no two are the same."""
    known = [
        item
        for path in wanted.inputs
        if _is_file(path, wanted)
        for item in _items_of_file(path, wanted)
    ]
    files = files_of(wanted, [*wanted.inputs, *(item.input for item in known)])
    try:
        for output in (
            [item.output for item in known] if wanted.page is None else [Path(wanted.output)]
        ):
            files.claim(output)
    except InvalidInputError as error:
        raise UsageError(str(error)) from error


def files_of(wanted: argparse.Namespace, inputs: Sequence[str]) -> Files:
    """Return the files of a run."""
    return Files(inputs, wanted.work.beside)


def _is_file(path: str, wanted: argparse.Namespace) -> bool:
    """Whether a path is read as a file, without Blender."""
    own = not wanted.record.reads_shapes or Path(path).suffix.lower() in READERS
    return own or not inside_blender()


def items(wanted: argparse.Namespace) -> Iterator[Item]:
    """The items one after the other, because Blender loads frames and files in between."""
    if not wanted.inputs:
        yield from _items_of_blender(None, wanted)
    for path in wanted.inputs:
        if _is_file(path, wanted):
            yield from _items_of_file(path, wanted)
        else:
            yield from _items_of_blender(path, wanted)


def divided(found: Iterable[Item], wanted: argparse.Namespace) -> Iterator[Item]:
    """The items, or with --each-part those of the connected parts of each."""
    settings = sampling_from(wanted)
    for item in found:
        if not wanted.division.each_part:
            yield item
            continue
        try:
            parts = items_of_parts(item, settings)
        except Exception as error:  # whatever reading raises
            parts = [replace(item, read=partial(_raise, error))]
        yield from parts


def _items_of_file(pattern: str, wanted: argparse.Namespace) -> Iterator[Item]:
    stem = Path(pattern).stem
    stem = stem.rstrip("#").rstrip("_.-") or stem
    for frame in wanted.frames or (None,):
        path = pattern if frame is None else at_frame(pattern, frame)
        yield _item(
            wanted.output, path, None, stem, frame, partial(wanted.record.read, path, wanted.limit)
        )


def _items_of_blender(path: str | None, wanted: argparse.Namespace) -> Iterator[Item]:
    """The objects of a file that Blender loads, frame by frame; None: of the file that is open."""
    from ..bridge.objects import read_scene

    source = path or read_scene.open_file() or "unsaved.blend"
    stem = Path(source).stem
    try:
        if path is not None:
            read_scene.load(path, wanted.allow_scripts)
        names = read_scene.names(list(filter(None, wanted.object or ())))
        if len(names) > 1 and wanted.page is None and "{name}" not in wanted.output:
            raise InvalidInputError(
                f"Expected {{name}} in OUTPUT for {len(names)} objects, found '{wanted.output}'; "
                "add it, or choose one with --object"
            )
    except Exception as error:  # Blender, or a script in the file, may raise anything
        yield Item(source, None, None, Path(wanted.output), partial(_raise, error))
        return
    for frame in wanted.frames or (None,):
        for name in names:
            read = partial(read_scene.read, name, frame)
            yield _item(wanted.output, source, name, stem, frame, read)


def _item(
    pattern: str,
    source: str,
    thing: str | None,
    file: str,
    frame: int | None,
    read: Callable[[], Any],
) -> Item:
    """One output; where it cannot have the name that the pattern gives, to read the item raises the reason."""
    try:
        name = file if thing is None else thing
        return Item(source, thing, frame, output_path(pattern, name, file, frame), read)
    except InvalidInputError as error:
        return Item(source, thing, frame, Path(pattern), partial(_raise, error))


def _raise(error: Exception) -> Any:
    raise error


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
