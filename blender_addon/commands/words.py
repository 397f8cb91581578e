# SPDX-License-Identifier: GPL-3.0-or-later
"""The words that all commands share: inputs, output, memory, parts, files."""

from __future__ import annotations

import argparse

from .. import __version__
from ..core.batch.option_words import add_options
from ..core.machine.memory_limit import MemoryLimit
from ..core.products.product import PRODUCTS, Product
from ..core.settings import Division

_CODES = {
    0: "all is there",
    1: "something failed",
    2: "wrong usage",
    3: "an input cannot be used",
    4: "cancelled",
    141: "nobody reads the results any more",
}
_OTHERS = f"""
results besides the axis, each with its own --help:
  medial_axis {" | ".join(filter(None, PRODUCTS))}"""


def parser_of(word: str, record: type[Product]) -> argparse.ArgumentParser:
    """The parser of a product: its own options, and what all products share; `word` is of PRODUCTS."""
    name = f"medial_axis {word}".rstrip()
    codes = sorted((_CODES | dict(record.codes)).items())
    parser = argparse.ArgumentParser(
        prog=name,
        usage=f"{name} INPUT [INPUT ...] OUTPUT [options]",
        description=record.description,
        epilog="\n".join(
            [record.help, "exit codes:", *(f"  {code:<5}{what}" for code, what in codes), _OTHERS]
        ),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("paths", nargs="+", metavar="PATH", help="INPUT ... OUTPUT, see below")
    parser.set_defaults(record=record, page=None)
    record.add_words(parser)
    _add_files(parser, record)
    return parser


def _add_files(parser: argparse.ArgumentParser, record: type[Product]) -> None:
    add_options(parser.add_argument_group("memory"), MemoryLimit)
    if record.reads_shapes:
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
        choices=[extension[1:] for extension in record.formats],
        default=record.usual,
        help=f"of files in a folder OUTPUT (default: {record.usual})",
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
