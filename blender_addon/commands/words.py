# SPDX-License-Identifier: GPL-3.0-or-later
"""The words that all commands share: inputs, output, memory, parts, files."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from typing import Any

from .. import __version__
from ..core.batch.batch import Work
from ..core.batch.option_words import add_options
from ..core.files.read_shape import read_shape
from ..core.machine.memory_limit import MemoryLimit
from ..core.settings import Division


def command_parser(name: str, description: str, epilog: str) -> argparse.ArgumentParser:
    """The parser of a command with its inputs and its output; `epilog` explains files and exit codes."""
    parser = argparse.ArgumentParser(
        prog=name,
        usage=f"{name} INPUT [INPUT ...] OUTPUT [options]",
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("paths", nargs="+", metavar="PATH", help="INPUT ... OUTPUT, see below")
    return parser


def add_files(
    parser: argparse.ArgumentParser,
    extensions: Iterable[str],
    usual: str,
    work_from: Callable[[argparse.Namespace], Work],
    read: Callable[..., Any] = read_shape,
) -> argparse._ArgumentGroup:
    """Adds what all commands share, and says what files and work they have; returns the group of the files.

    Parameters
    ----------
    parser : ArgumentParser
    extensions : iterable of str
        Of the files that the command writes, such as ".ma".
    usual : str
        The format of files in a folder, such as "ma".
    work_from : callable
        Returns the work that the arguments of a command line ask for.
    read : callable
        Reads a file with a memory limit; what is no shape has no connected parts.
    """
    known = tuple(extensions)
    parser.set_defaults(known=known, work_from=work_from, page=None, read=read)
    add_options(parser.add_argument_group("memory"), MemoryLimit)
    if read is read_shape:
        add_options(parser.add_argument_group("parts"), Division)
    files = parser.add_argument_group("files")
    files.add_argument("--frames", metavar="A-B", help="such as 1-250, 1-250:10 or 1,5,9-12")
    files.add_argument(
        "--object",
        action="append",
        metavar="NAME",
        help="of a file with objects, can be repeated (default: all visible meshes and point clouds)",
    )
    files.add_argument(
        "--format",
        choices=[extension[1:] for extension in known],
        default=usual,
        help=f"of files in a folder OUTPUT (default: {usual})",
    )
    files.add_argument(
        "--options", metavar="TEXT", default="", help="more options in one word, as farms pass them"
    )
    files.add_argument("--force", action="store_true", help="compute also what is finished")
    files.add_argument(
        "--allow-scripts",
        action="store_true",
        help="let .blend files of INPUT run the Python scripts and drivers in them",
    )
    files.add_argument("--json", action="store_true", help="one line of JSON per result")
    files.add_argument("--quiet", action="store_true", help="no progress and no warnings")
    parser.add_argument("--version", action="version", version=f"medial_axis {__version__}")
    return files
