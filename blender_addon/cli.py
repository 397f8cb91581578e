# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line (docs/command_line.md): files in, medial axes, lengths or skeletons as files out.

The same in three places: `blender --command medial_axis` from 4.2, `blender --background --python .../__main__.py --`
in every version, and `python3 -m medial_axis` without Blender.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from typing import Any

from .commands.items import (
    UsageError,
    check_outputs,
    divided,
    files_of,
    inside_blender,
    items,
)
from .commands.parse import parse
from .commands.watch import interruptible, watch
from .console import ClosedPipeError, Console, open_streams
from .core.batch.batch import Item, begin, failure, finish
from .core.errors import Cancelled, DegenerateInputError, InvalidInputError, ReadError
from .core.machine import native
from .core.products.product import CANCELLED, DONE, FAILED, INPUT, THIN, UNMEASURED, USAGE

_GRAVEST_FIRST = (FAILED, INPUT, THIN, UNMEASURED, DONE)
CLOSED_PIPE = 128 + 13  # the exit code by which shells report that SIGPIPE ended a program


def main(words: Sequence[str]) -> int:
    """Run a command line; returns its exit code."""
    open_streams()
    try:
        wanted = parse(words)
    except SystemExit as end:  # of argparse, which has said why
        return DONE if end.code in (None, 0) else USAGE
    console = Console(wanted.json, wanted.quiet, new_lines=inside_blender())
    if problem := native.problem():
        console.complain(problem)
        return FAILED
    with interruptible():
        try:
            check_outputs(wanted)
            code = _run(items(wanted), wanted, console)
        except UsageError as error:
            console.complain(str(error))
            return USAGE
        except KeyboardInterrupt:
            console.complain("cancelled")
            return CANCELLED
        except ClosedPipeError:
            return CLOSED_PIPE
    return FAILED if code in (DONE, THIN, UNMEASURED) and console.lost else code


def run() -> None:
    """Run the words behind `--` and end Blender with the exit code; for `--python-expr`."""
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    code = main(words)
    sys.stdout.flush()
    sys.exit(code)


def _run(found: Iterable[Item], wanted: argparse.Namespace, console: Console) -> int:
    """All items; one that fails, however it does, does not stop the others."""
    codes, files = {DONE}, files_of(wanted, wanted.inputs)
    page = None if wanted.page is None else wanted.work.page(wanted.page)
    for item in divided(found, wanted):
        try:
            if page is None:
                files.claim(item.output)
            report = _done(item, wanted, page, console)
            codes.add(wanted.work.exit_code(report))
        except (KeyboardInterrupt, Cancelled):
            console.tell({**failure(item, Cancelled("cancelled")), "status": "cancelled"})
            return CANCELLED
        except Exception as error:
            report = (page.failed if page else failure)(item, error)
            of_input = isinstance(error, (ReadError, InvalidInputError, DegenerateInputError))
            codes.add(INPUT if of_input else FAILED)
        console.tell(report)
    if page is not None:
        console.tell(report := page.written())
        codes |= {FAILED} if report["status"] == "failed" else set()
    return next(code for code in _GRAVEST_FIRST if code in codes)


def _done(item: Item, wanted: argparse.Namespace, page: Any, console: Console) -> dict[str, Any]:
    """The report of an item, which is computed unless it is finished."""
    if page is not None:
        return page.measured(item, wanted.limit, lambda task: watch(task, console.show))
    begun = begin(item, wanted.work, wanted.force, wanted.limit)
    return begun.kept or finish(begun, watch(begun.task, console.show))
