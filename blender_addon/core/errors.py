# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors, and warnings as severe. Each message is one sentence: what was expected, what was found, and what to do.

Every computation may raise those of this file, so a docstring names an error only where it says when it comes.
"""

from __future__ import annotations


class MedialAxisError(Exception):
    """A medial axis could not be computed; nothing was changed."""


class NativeModuleError(MedialAxisError, ImportError):
    """The compiled module for this Python is missing or does not load."""


class InvalidInputError(MedialAxisError, ValueError):
    """An input has the wrong shape, type or range, or a value that is not finite."""


class DegenerateInputError(MedialAxisError, ValueError):
    """The points span no volume: fewer than 4 distinct ones, or all on a line or a plane."""


class OutOfMemoryError(MedialAxisError, MemoryError):
    """The computer has not enough memory for this many points."""


def out_of_memory() -> OutOfMemoryError:
    """Return the error for a computer that runs out of memory."""
    return OutOfMemoryError(
        "Expected enough memory, found too little; close other programs or use fewer points"
    )


class MemoryLimitError(OutOfMemoryError):
    """The analysis of `points` points would need more memory than it may have; it was not begun."""

    def __init__(self, text: str, points: int) -> None:
        super().__init__(text)
        self.points = points


class Cancelled(MedialAxisError):  # noqa: N818 - as in _medial
    """The computation was cancelled; nothing was computed."""


class ExportError(MedialAxisError, OSError):
    """A medial axis could not be written; no file was changed."""


class ReadError(MedialAxisError, OSError):
    """A file of points could not be read; nothing was made."""


class Severe(str):
    """A warning that the result is probably wrong. A plain `str` only reports an assumption."""

    __slots__ = ()
