# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis balls INPUT OUTPUT`: a solid as few balls, as a file (docs/balls.md)."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from .core.batch.option_words import (
    add_ball_options,
    add_limits,
    add_sampling,
    sampling_from,
    settings_from,
)
from .core.errors import (
    Cancelled,
    DegenerateInputError,
    InvalidInputError,
    MedialAxisError,
    ReadError,
)
from .core.files.read_shape import read_shape
from .core.files.write_balls import ball_format, export_balls
from .core.machine import native
from .core.machine.memory_limit import MemoryLimit
from .core.settings import BallSettings
from .core.solid.ball_cover import cover_by_balls

DONE, FAILED, USAGE, INPUT, CANCELLED = range(5)


def main(words: Sequence[str]) -> int:
    """Run the words behind `balls`; returns the exit code."""
    try:
        wanted = _parse(words)
    except SystemExit as end:  # of argparse, which has said why
        return DONE if end.code in (None, 0) else USAGE
    try:
        if problem := native.problem():
            raise MedialAxisError(problem)
        _write(wanted)
    except (KeyboardInterrupt, Cancelled):
        return _complain("cancelled", CANCELLED)
    except (ReadError, InvalidInputError, DegenerateInputError) as error:
        return _complain(str(error), INPUT)
    except MedialAxisError as error:
        return _complain(str(error), FAILED)
    return DONE


def _parse(words: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="medial_axis balls",
        description="A solid as few balls of its medial axis: .ma or .json.",
        allow_abbrev=False,
    )
    parser.add_argument("input", metavar="INPUT", help="a mesh or a point cloud")
    parser.add_argument("output", metavar="OUTPUT", help="a file that ends in .ma or .json")
    add_ball_options(parser.add_argument_group("balls"))
    add_sampling(parser.add_argument_group("sampling"))
    add_limits(parser.add_argument_group("memory"))
    parser.add_argument("--quiet", action="store_true", help="no warnings")
    wanted = parser.parse_args(words)
    try:
        wanted.settings, wanted.limit = sampling_from(wanted), settings_from(wanted, MemoryLimit)
        wanted.balls = settings_from(wanted, BallSettings)
        ball_format(wanted.output)
    except MedialAxisError as error:
        parser.error(str(error))
    return wanted


def _write(wanted: argparse.Namespace) -> None:
    shape, warnings = read_shape(wanted.input)
    found = cover_by_balls(shape, wanted.settings, wanted.balls, limit=wanted.limit)
    balls = found.balls
    path = export_balls(balls, wanted.output)
    if not wanted.quiet:
        for warning in (*warnings, *found.warnings):
            _complain(warning, DONE)
    print(
        f"{path}: {len(balls.radii):,} balls, {100 * balls.covered:.1f} % of the volume, "
        f"{balls.outside:.4g} outside, surface at most {balls.farthest:.4g} away, "
        f"done in {found.seconds:.2f} s"
    )


def _complain(text: str, code: int) -> int:
    print(f"medial_axis: {text}", file=sys.stderr, flush=True)
    return code
