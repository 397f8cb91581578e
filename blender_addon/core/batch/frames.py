"""Ranges of frames, and names of files with a number in them."""

from __future__ import annotations

import re
from pathlib import Path

_RANGE = re.compile(r"(-?\d{1,9})(?:-(-?\d{1,9})(?::(\d{1,9}))?)?")
_MOST = 1_000_000  # frames of one command
_FORBIDDEN = re.compile(r'[\\/:*?"<>|\x00-\x1f]')  # by some file system
_NUMBER = re.compile(r"#+")


def parse_frames(text: str) -> list[int]:
    """'1-10', '1-9:2' (every second), '7' and lists of these with commas -> frames, ascending, each once.

    Raises
    ------
    ValueError
    """
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
    """Whether a pattern has a place for the number of a frame."""
    return _NUMBER.search(pattern) is not None


def at_frame(pattern: str, frame: int) -> str:
    """The pattern with `####` replaced by the frame, as many digits at least."""
    return _NUMBER.sub(lambda marks: f"{frame:0{len(marks[0])}d}", pattern)


def output_path(pattern: str, name: str, file: str, frame: int | None) -> Path:
    """The pattern with `{name}`, `{file}` and `####` replaced; _ stands for what a file system may refuse."""
    filled = pattern if frame is None else at_frame(pattern, frame)
    for key, text in (("{name}", name), ("{file}", file)):
        filled = filled.replace(key, _FORBIDDEN.sub("_", text))
    return Path(filled)
