# SPDX-License-Identifier: GPL-3.0-or-later
"""A batch writes results as files, one after the other; finished outputs are recognised and kept.

Each output has a report next to it, `<output>.json`, with figures, warnings, and a stamp of everything that the output
depends on. An output is finished if its report has the right stamp and the digest of the existing file.
"""

from __future__ import annotations

import hashlib
import json
import traceback
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, Protocol

from ... import __version__
from ..errors import (
    ExportError,
    InvalidInputError,
    MedialAxisError,
    OutOfMemoryError,
    out_of_memory,
)
from ..files.names import LONGEST, bytes_of
from ..files.writing import write_whole
from ..machine.cache import CACHE, key_of
from ..machine.job import Outcome, Task
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..shape.own_frame import in_own_frame
from ..shape.shape import Shape


class Work(Protocol):
    """Work is one kind of computation for each shape; its `repr` has all settings that the output depends on.

    The result of `compute` has `warnings`, `seconds`, and `chosen`, which is None where nothing was sampled.
    """

    def compute(self, shape: Any, limit: MemoryLimit, progress: Progress | None) -> Any:
        """Compute from what was read, a Shape for most kinds."""

    def check(self, found: Any) -> None:
        """Raise MedialAxisError if there is nothing to write."""

    def write(self, found: Any, path: Path, frame: Any) -> tuple[str, ...]:
        """Write the file, and return warnings about the parts that it does not hold."""

    def words(self) -> dict[str, Any]:
        """Return the settings, for the report."""

    def figures(self, found: Any) -> dict[str, Any]:
        """Return the figures of a result, for the report."""


@dataclass(frozen=True, eq=False)
class Item:
    """An item is one output of a batch."""

    input: str  # The input file, for messages
    object: str | None  # The name of the object in that file
    frame: int | None
    output: Path
    # It returns the shape, or a `RobotFile`, and warnings
    read: Callable[[], tuple[Shape, tuple[str, ...]]]
    # The number of the connected part of the shape, from 1, that this item is; None for the whole
    part: int | None = None

    @property
    def name(self) -> str:
        """Return the name of this item in messages."""
        name = Path(self.input).name if self.object is None else self.object
        frame = "" if self.frame is None else f", frame {self.frame}"
        return name + frame + ("" if self.part is None else f", part {self.part}")


@dataclass(frozen=True, eq=False)
class Begun:
    """Begun is an item whose shape was read."""

    item: Item
    work: Work
    limit: MemoryLimit
    shape: Shape
    warnings: tuple[str, ...]
    # The report of the output if that is finished, or None if it has to be computed
    kept: dict[str, Any] | None

    @property
    def task(self) -> Task:
        """Return the computation that is left to do."""
        limit = self.limit.used(output=self.item.output.suffix.lower())
        return Task(self.item.name, lambda progress: self.work.compute(self.shape, limit, progress))

    def stamp(self, thinned: bool) -> str:
        """Return a hash of everything that the output depends on; thinned samples depend on the memory limit, too."""
        limit = self.limit if thinned else None
        return stamp_of(self.shape, self.work, self.item.output.suffix.lower(), limit)


def begin(item: Item, work: Work, force: bool = False, limit: MemoryLimit = WHAT_IS_FREE) -> Begun:
    """Read an item and check whether its output is finished; with `force` it counts as unfinished."""
    check_name(item.output)
    given, warnings = item.read()
    shape = in_own_frame(given)[0] if isinstance(given, Shape) else given
    begun = Begun(item, work, limit, shape, warnings, None)
    kept = None if force else finished(item.output, {begun.stamp(False), begun.stamp(True)})
    return (
        begun if kept is None else replace(begun, kept={**kept, **_place(item), "status": "kept"})
    )


def finish(begun: Begun, outcome: Outcome) -> dict[str, Any]:
    """Write the outcome of the task and its report, and return the report.

    Raises
    ------
    MedialAxisError
        The task failed, or there is nothing to write; no output was written.
    """
    found, output = result_of(begun, outcome), begun.item.output
    make_folder(output)
    report = {
        **report_of(begun, found, begun.work.write(found, output, begun.shape.frame)),
        "stamp": begun.stamp(thinned=found.chosen is not None and bool(found.chosen.thinned)),
        "digest": _digest(output),
    }
    _write_report(report, output)
    return report


def result_of(begun: Begun, outcome: Outcome) -> Any:
    """Return what the task computed.

    Raises
    ------
    MedialAxisError
        The task failed, or there is nothing to write.
    """
    CACHE.clear()  # no other output uses this analysis
    if outcome.error is not None:
        raise outcome.error
    begun.work.check(outcome.value)
    return outcome.value


def report_of(begun: Begun, found: Any, left_out: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return the report of a result; `left_out` are warnings about what its file does not hold."""
    return {
        "status": "done",
        **_place(begun.item),
        **begun.work.figures(found),
        "settings": begun.work.words(),
        "warnings": [*begun.warnings, *found.warnings, *left_out],
        "seconds": round(found.seconds, 3),
        "version": __version__,
    }


def failure(item: Item, error: BaseException) -> dict[str, Any]:
    """Return the report of an item that has no output, whatever the reason."""
    if isinstance(error, MemoryError) and not isinstance(error, OutOfMemoryError):
        error = out_of_memory()  # Python or NumPy may raise it while files are read and written
    return {"status": "failed", **_place(item), "kind": type(error).__name__, "error": _said(error)}


def check_name(output: Path) -> None:
    """Check that the report next to an output can have its name."""
    if (length := bytes_of(report_path(output).name)) > LONGEST:
        raise InvalidInputError(
            f"Expected the name of an output of at most {LONGEST - len('.json')} bytes, so that its "
            f"report fits beside it, found {length - len('.json')}; choose a shorter name"
        )


def _said(error: BaseException) -> str:
    """Return the error as one sentence; an unexpected error names its place in the sources."""
    if isinstance(error, MedialAxisError):
        return str(error)
    frame = traceback.extract_tb(error.__traceback__)[-1:]
    place = "".join(f" in line {at.lineno} of {Path(at.filename).name}" for at in frame)
    words = " ".join(str(error).split())
    return (
        f"Expected to finish this, found {type(error).__name__}{place}: '{words}'; "
        "this is a bug of the program, please report it with the input"
    )


def _write_report(report: dict[str, Any], output: Path) -> None:
    text = json.dumps(report, indent=1, ensure_ascii=False) + "\n"
    data = text.encode("utf-8", "surrogateescape")  # names are bytes
    try:
        write_whole(report_path(output), lambda stream: stream.write(data))
    except ExportError as error:
        raise ExportError(
            f"Expected to write the report of '{output}', which is written, but the system says "
            f"'{getattr(error.__cause__, 'strerror', None) or error}'; run the command again"
        ) from error


def stamp_of(shape: Shape, settings: object, suffix: str, limit: MemoryLimit | None = None) -> str:
    """Return a hash of everything that an output depends on: the whole shape, every setting, format, version."""
    parts = (getattr(shape, part.name) for part in fields(shape))
    return key_of(*parts, repr(settings), repr(limit), suffix, __version__)


def finished(output: Path, stamps: set[str]) -> dict[str, Any] | None:
    """Return the report of an existing output if it has one of these stamps, otherwise None."""
    try:
        report = json.loads(report_path(output).read_text("utf-8", "surrogateescape"))
        right = report["stamp"] in stamps and report["digest"] == _digest(output)
    except (OSError, ValueError, LookupError, TypeError):
        return None
    return report if right else None


def report_path(output: Path) -> Path:
    """Return the path of the report of an output."""
    return output.with_name(output.name + ".json")


def _place(item: Item) -> dict[str, Any]:
    place = {"input": item.input, "object": item.object, "frame": item.frame}
    if item.part is not None:
        place["part"] = item.part
    return {**place, "output": str(item.output)}


def make_folder(output: Path) -> None:
    """Make the folder of an output where it is missing."""
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
