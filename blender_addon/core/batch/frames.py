# SPDX-License-Identifier: GPL-3.0-or-later
"""This module parses ranges of frames, and makes file names from patterns."""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import InvalidInputError

_RANGE = re.compile(r"(-?\d{1,9})(?:-(-?\d{1,9})(?::(\d{1,9}))?)?")
_MOST = 1_000_000  # a range has at most this many frames
_FORBIDDEN = re.compile(r'[\\/:*?"<>|\x00-\x1f]')  # some file systems refuse these
_NUMBER = re.compile(r"#+")
# These names mean a device on Windows, whatever extension follows.
_DEVICE = re.compile(r"(?:CON|PRN|AUX|NUL|CONIN\$|CONOUT\$|(?:COM|LPT)[0-9¹²³])", re.IGNORECASE)


def parse_frames(text: str) -> list[int]:
    """Return the frames of '1-10', '1-9:2' (every second), '7' or a list of these with commas, ascending, each once."""
    frames: set[int] = set()
    for part in text.split(","):
        match = _RANGE.fullmatch(part.strip())
        first, last, step = match.groups() if match else (None, None, None)
        if first is None or step == "0" or int(last or first) < int(first):
            raise ValueError(
                f"Expected frames such as 1-250, 1-250:10 or 1,5,9-12, found {text!a}; "
                "write first and last frame"
            )
        part_frames = range(int(first), int(last or first) + 1, int(step or 1))
        if len(part_frames) > _MOST:
            raise ValueError(
                f"Expected at most {_MOST:,} frames, found {len(part_frames):,} in {text!a}; "
                "split them"
            )
        frames.update(part_frames)
    return sorted(frames)


def has_number(pattern: str) -> bool:
    """Return whether a pattern has a place for the number of a frame."""
    return _NUMBER.search(pattern) is not None


def at_frame(pattern: str, frame: int) -> str:
    """Return the pattern with `####` replaced by the frame with at least as many digits."""
    return _NUMBER.sub(lambda marks: f"{frame:0{len(marks[0])}d}", pattern)


def output_path(pattern: str, name: str, file: str, frame: int | None) -> Path:
    """Return the pattern with `{name}`, `{file}` and `####` replaced; _ replaces characters that some system refuses.

    Raises
    ------
    InvalidInputError
        A folder or file would get a name that some system does not allow, or that leads elsewhere. Folders that
        the pattern names literally are not checked: they are the user's choice.
    """
    given = Path(pattern).parts
    parts = [_filled(part, name, file, frame) for part in given]
    for i, part in enumerate(parts):
        if (part != given[i] or i + 1 == len(parts)) and not _is_file_name(part):
            raise InvalidInputError(
                "Expected a name that files can have on every system, found "
                f"'{part}' for '{given[i]}' in OUTPUT; rename the object or the file, or change OUTPUT"
            )
    return Path(*parts)


def _filled(part: str, name: str, file: str, frame: int | None) -> str:
    filled = part if frame is None else at_frame(part, frame)
    for key, text in (("{name}", name), ("{file}", file)):
        filled = filled.replace(key, _FORBIDDEN.sub("_", text))
    return filled


def _is_file_name(part: str) -> bool:
    """Return whether every system accepts a name: it must not end in a dot or blank (as .. does), nor be a device."""
    return part == part.rstrip(". ") != "" and not _DEVICE.fullmatch(
        part.partition(".")[0].rstrip()
    )
