# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis skeleton INPUT OUTPUT`: the skeleton of a file, as a file (docs/skeleton.md)."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from .core.batch.option_words import (
    add_limits,
    add_sampling,
    add_skeleton_options,
    limit_from,
    sampling_from,
    skeleton_settings_from,
)
from .core.errors import (
    Cancelled,
    DegenerateInputError,
    InvalidInputError,
    MedialAxisError,
    ReadError,
)
from .core.files.read_shape import read_shape
from .core.files.write_skeleton import export_skeleton, skeleton_format
from .core.machine import native
from .core.skeleton.compute import compute_skeleton

DONE, FAILED, USAGE, INPUT, CANCELLED = range(5)


def main(words: Sequence[str]) -> int:
    """Run the words behind `skeleton`; returns the exit code."""
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
        prog="medial_axis skeleton",
        description="The curve skeleton of a solid, with radii: .swc, .obj or .json.",
        allow_abbrev=False,
    )
    parser.add_argument("input", metavar="INPUT", help="a mesh or a point cloud")
    parser.add_argument("output", metavar="OUTPUT", help="a file that ends in .swc, .obj or .json")
    add_skeleton_options(parser.add_argument_group("skeleton"))
    add_sampling(parser.add_argument_group("sampling"))
    add_limits(parser.add_argument_group("memory"))
    parser.add_argument("--quiet", action="store_true", help="no warnings")
    wanted = parser.parse_args(words)
    try:
        wanted.settings, wanted.limit = sampling_from(wanted), limit_from(wanted)
        wanted.skeleton = skeleton_settings_from(wanted)
        skeleton_format(wanted.output)
    except MedialAxisError as error:
        parser.error(str(error))
    return wanted


def _write(wanted: argparse.Namespace) -> None:
    shape, warnings = read_shape(wanted.input)
    found = compute_skeleton(shape, wanted.settings, wanted.skeleton, limit=wanted.limit)
    path = export_skeleton(found.skeleton, found.parts, wanted.output)
    if not wanted.quiet:
        for warning in (*warnings, *found.warnings):
            _complain(warning, DONE)
    skeleton = found.skeleton
    print(
        f"{path}: {skeleton.count:,} branches, {skeleton.tips:,} ends, {skeleton.loops:,} loops, "
        f"done in {found.seconds:.2f} s"
    )


def _complain(text: str, code: int) -> int:
    print(f"medial_axis: {text}", file=sys.stderr, flush=True)
    return code
