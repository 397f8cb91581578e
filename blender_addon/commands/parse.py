# SPDX-License-Identifier: GPL-3.0-or-later
"""From the words of a command line to what is wanted."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Sequence
from pathlib import Path

from ..core.batch.frames import has_number, output_path, parse_frames
from ..core.batch.option_words import settings_from
from ..core.errors import MedialAxisError
from ..core.files.names import is_folder
from ..core.files.read import READERS
from ..core.files.writing import extension_of
from ..core.machine.memory_limit import MemoryLimit
from ..core.products.product import PRODUCTS, product
from ..core.settings import Division
from .items import inside_blender
from .words import parser_of


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Return what the words ask for: work, inputs, output, frames, switches. SystemExit where they are wrong."""
    word = words[0] if words and words[0] in PRODUCTS else ""
    parser = parser_of(word, product(word))
    words = _with_paths_behind_dashes(words[1:] if word else words)
    wanted = parser.parse_intermixed_args(words)
    try:
        if more := shlex.split(wanted.options):
            wanted = parser.parse_intermixed_args([*words, *more])
        _complete(wanted)
    except (MedialAxisError, ValueError) as error:
        parser.error(str(error))
    return wanted


def _with_paths_behind_dashes(words: Sequence[str]) -> list[str]:
    """The words without `--`, behind which all are paths, also those that begin with a dash."""
    end = list(words).index("--") if "--" in words else len(words)
    return [*words[:end], *(f"./{word}" if word[:1] == "-" else word for word in words[end + 1 :])]


def _complete(wanted: argparse.Namespace) -> None:
    """Settings, inputs, the pattern of outputs and frames, or an error when they do not fit together."""
    paged = wanted.page is not None
    *wanted.inputs, output = [*wanted.paths, wanted.page] if paged else wanted.paths
    wanted.work = wanted.record.from_words(wanted)
    wanted.limit = settings_from(wanted, MemoryLimit)
    wanted.division = settings_from(wanted, Division)
    wanted.frames = None if wanted.frames is None else parse_frames(wanted.frames)
    if "" in wanted.paths:
        raise ValueError(
            "Expected names of files, found an empty one; look whether a variable is unset"
        )
    if not wanted.inputs and not inside_blender():
        raise ValueError("Expected INPUT and OUTPUT, found one path; add the other")
    if output.endswith(("/", "\\")) or is_folder(output):
        number = "" if wanted.frames is None else "_####"
        output = str(Path(output, f"{{name}}{number}.{wanted.format}"))
    extension_of(output, (".html",) if paged else tuple(wanted.record.formats))
    wanted.output = output
    first = wanted.frames[0] if wanted.frames else None
    output_path(output, "name", "file", first)  # it raises what is wrong
    if not paged and has_number(Path(output).name) != (wanted.frames is not None):
        raise ValueError(
            "Expected --frames together with #### in OUTPUT, found one without the other"
        )
    if wanted.frames is not None and (still := list(filter(_is_still, wanted.inputs))):
        raise ValueError(
            f"Expected #### in INPUT with --frames, found none in '{still[0]}'; add it"
        )
    named = "{name}" in output or "{file}" in output
    if len(wanted.inputs) > 1 and not (named or paged):
        if not Path(word := wanted.inputs[0]).suffix and not Path(word).exists():
            known = ", ".join(filter(None, PRODUCTS))
            raise ValueError(f"Expected a file, or one of {known}, found '{word}'; check it")
        raise ValueError(
            f"Expected a folder or {{name}} in OUTPUT for several inputs, found '{output}'; add it"
        )


def _is_still(path: str) -> bool:
    """Return whether a path is one file for all frames: its format has none, and its name no number."""
    return Path(path).suffix.lower() in READERS and not has_number(Path(path).name)
