# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes as files, one after the other; what is finished is recognised and left.

Beside every output lies its report, `<output>.json`: figures, warnings, and a stamp of all that the output
depends on. An output is finished when its report has the right stamp and the digest of the file that is there.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import partial
from pathlib import Path
from typing import Any

from ... import __version__
from ..axis.compute import Computation, compute_axis
from ..axis.shape import Shape
from ..errors import ExportError, MedialAxisError
from ..files.whole_file import write_whole
from ..files.write import export_axis
from ..machine.cache import CACHE, key_of
from ..machine.job import Outcome, Task
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..settings import Settings
from .option_words import as_words


@dataclass(frozen=True, eq=False)
class Item:
    """One output.

    Parameters
    ----------
    input : str
        The file, for messages.
    object : str or None
        Its name in that file.
    frame : int or None
    output : Path
    read : callable
        Returns the shape, and warnings.
    """

    input: str
    object: str | None
    frame: int | None
    output: Path
    read: Callable[[], tuple[Shape, tuple[str, ...]]]

    @property
    def name(self) -> str:
        """What messages call this item."""
        name = Path(self.input).name if self.object is None else self.object
        return name if self.frame is None else f"{name}, frame {self.frame}"


@dataclass(frozen=True, eq=False)
class Begun:
    """An item whose shape was read.

    Parameters
    ----------
    item : Item
    settings : Settings
    limit : MemoryLimit
    shape : Shape
    warnings : tuple of str
    kept : dict or None
        The report of the output that is there and finished; None: it has to be computed.
    """

    item: Item
    settings: Settings
    limit: MemoryLimit
    shape: Shape
    warnings: tuple[str, ...]
    kept: dict[str, Any] | None

    @property
    def task(self) -> Task:
        """What is left to compute."""
        work = partial(compute_axis, self.shape, self.settings, limit=self.limit)
        return Task(self.item.name, work)

    def stamp(self, thinned: bool) -> str:
        """A hash of all that the output depends on; where samples were thinned, of the memory limit, too."""
        limit = self.limit if thinned else None
        return stamp_of(self.shape, self.settings, self.item.output.suffix.lower(), limit)


def begin(
    item: Item, settings: Settings, force: bool = False, limit: MemoryLimit = WHAT_IS_FREE
) -> Begun:
    """Read an item and look whether it is finished; with `force` it never is.

    Raises
    ------
    MedialAxisError
    """
    shape, warnings = item.read()
    begun = Begun(item, settings, limit, shape, warnings, None)
    kept = None if force else finished(item.output, {begun.stamp(False), begun.stamp(True)})
    return (
        begun if kept is None else replace(begun, kept={**kept, **_place(item), "status": "kept"})
    )


def finish(begun: Begun, outcome: Outcome) -> dict[str, Any]:
    """Write what the task gave, and its report, which is returned.

    Raises
    ------
    MedialAxisError
        Also where no facet is left; no output was written.
    """
    CACHE.clear()  # no other output uses this analysis
    if outcome.error is not None:
        raise outcome.error
    computation, output = outcome.value, begun.item.output
    if computation.axis.facets == 0:
        raise MedialAxisError(computation.warnings[-1])
    _make_folder(output)
    export_axis(computation.axis, output, begun.shape.frame)
    report = {
        "status": "done",
        **_place(begun.item),
        **_figures(computation),
        "settings": as_words(begun.settings),
        "warnings": [*begun.warnings, *computation.warnings],
        "seconds": round(computation.seconds, 3),
        "version": __version__,
        "stamp": begun.stamp(thinned=bool(computation.chosen.thinned)),
        "digest": _digest(output),
    }
    text = json.dumps(report, indent=1, ensure_ascii=False) + "\n"
    write_whole(report_path(output), lambda stream: stream.write(text.encode("utf-8")))
    return report


def failure(item: Item, error: BaseException) -> dict[str, Any]:
    """The report of an item that has no output."""
    return {"status": "failed", **_place(item), "kind": type(error).__name__, "error": str(error)}


def stamp_of(
    shape: Shape, settings: Settings, suffix: str, limit: MemoryLimit | None = None
) -> str:
    """A hash of all that an output depends on: the whole shape, every setting, format, version."""
    parts = (getattr(shape, part.name) for part in fields(shape))
    return key_of(*parts, repr(settings), repr(limit), suffix, __version__)


def finished(output: Path, stamps: set[str]) -> dict[str, Any] | None:
    """The report of an output that is there and has one of these stamps."""
    try:
        report = json.loads(report_path(output).read_text(encoding="utf-8"))
        right = report["stamp"] in stamps and report["digest"] == _digest(output)
    except (OSError, ValueError, LookupError, TypeError):
        return None
    return report if right else None


def report_path(output: Path) -> Path:
    """Where the report of an output lies."""
    return output.with_name(output.name + ".json")


def _place(item: Item) -> dict[str, Any]:
    place = {"input": item.input, "object": item.object, "frame": item.frame}
    return {**place, "output": str(item.output)}


def _figures(computation: Computation) -> dict[str, Any]:
    axis = computation.axis
    return {
        "points": computation.points,
        "duplicates": computation.duplicates,
        "facets": axis.facets,
        "vertices": len(axis.vertices),
        "unbounded": axis.unbounded,
        "zero_area": axis.zero_area,
        "radius": [float(axis.radius.min()), float(axis.radius.max())],
        "sampled": computation.chosen.reason,
        "density": str(computation.density),
        "missed": computation.missed,
        "inside": str(computation.sides),
    }


def _make_folder(output: Path) -> None:
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(
            f"Expected to make the folder '{output.parent}', but the system says "
            f"'{error.strerror or error}'; choose another one"
        ) from error


def _digest(path: Path) -> str:
    digest = hashlib.blake2b(digest_size=16)
    with open(path, "rb") as stream:
        while piece := stream.read(1 << 20):
            digest.update(piece)
    return digest.hexdigest()
