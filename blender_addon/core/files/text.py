# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads text files of numbers with one row per line, such as `.xyz` and `.off`.

A comment goes from `#` or `//` to the end of the line. Comments and blank lines are skipped. A comment may have any
byte, so every byte is read as a character (Latin-1); numbers are ASCII.
"""

from __future__ import annotations

import io
import math
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, TextIO

import numpy as np

from ..arrays import Floats, Longs
from ..errors import ReadError

_CHUNK = 1 << 17  # this many characters are parsed at once; they are few, to stay in the cache
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"  # this is the mark of UTF-8
_COMMENT = re.compile(r"(?:#|//).*")
_BLANK = np.isin(np.arange(256), list(b" \t\n\r\v\f"))  # bytes.split() splits at these


@dataclass(frozen=True)
class Rows:
    """Rows are lines of numbers."""

    # (t,) The numbers, line after line. They are finite, unless the caller of `Lines.rows` checks that itself.
    values: Floats
    offsets: Longs  # (r + 1,) Row i is `values[offsets[i]:offsets[i + 1]]`; it is never empty
    lines: Longs  # (r,) The number of each line in the file, counted from 1
    name: str  # The name of the file

    def __len__(self) -> int:
        return len(self.lines)

    def part(self, start: int, stop: int) -> Rows:
        """Return the rows from `start` up to, but without, `stop`."""
        offsets = self.offsets[start : stop + 1]
        values = self.values[offsets[0] : offsets[-1]]
        return Rows(values, offsets - offsets[0], self.lines[start:stop], self.name)

    def table(self, least: int, what: str) -> Floats:
        """Return the rows as a table, (r, k); k must be at least `least`, and `what` names the columns in messages."""
        widths = np.diff(self.offsets)
        if widths[0] < least:
            raise ReadError(
                f"Expected {what}, at least {least} numbers, in {self.place(0)}, found {widths[0]}; "
                "write one point per line"
            )
        other = np.flatnonzero(widths != widths[0])
        if len(other):
            raise ReadError(
                f"Expected {widths[0]} numbers in {self.place(other[0])}, as in line {self.lines[0]}, "
                f"found {widths[other[0]]}; mend that line or take the file from its source again"
            )
        return self.values.reshape(len(self), -1)

    def lists(self, before: int = 0) -> tuple[Longs, Floats]:
        """Return the sizes and the corners of the lists that each row has behind so many numbers."""
        starts, words = self.offsets[:-1] + before, np.diff(self.offsets) - before
        sizes = np.where(words > 0, self.values[np.minimum(starts, len(self.values) - 1)], -1)
        bad = np.flatnonzero((sizes != np.floor(sizes)) | (sizes < 0) | (sizes >= words))
        if len(bad):
            raise ReadError(
                f"Expected a number of corners and as many corners in {self.place(bad[0])}, "
                f"found {sizes[bad[0]]:.17g} and {words[bad[0]] - 1}; mend that line"
            )
        sizes = sizes.astype(np.int64)
        first = np.repeat(starts + 1 - (np.cumsum(sizes) - sizes), sizes)
        return sizes, self.values[first + np.arange(sizes.sum())]

    def place(self, row: int) -> str:
        """Return the place of a row in the file, for messages."""
        return f"line {self.lines[row]} of '{self.name}'"


class Lines:
    """Iterates over the lines of a text file that are not blank.

    Attributes
    ----------
    line : str
        The first line that was not read yet, without its comment; it is empty at the end of the file.
    number : int
        The number of that line in the file, counted from 1.
    name : str
        The name of the file.
    """

    def __init__(self, stream: TextIO, name: str) -> None:
        self._stream = stream
        self.name = name
        self.number = 1
        self.line = _COMMENT.sub("", stream.readline())
        if "\0" in self.line:
            raise ReadError(
                f"Expected text in '{name}', found a binary file or UTF-16; save it as UTF-8 text"
            )
        if not self.line.strip():
            self.advance()

    def advance(self) -> None:
        """Advance to the next line that is not blank."""
        while raw := self._stream.readline():
            self.number += 1
            self.line = _COMMENT.sub("", raw)
            if self.line.strip():
                return
        self.line = ""

    def place(self) -> str:
        """Return the place of the line in the file, for messages."""
        return f"line {self.number} of '{self.name}'"

    def rows(self, delimiter: str = "", finite: bool = True) -> Rows:
        """Read all remaining lines: numbers separated by `delimiter`, or else by blanks.

        With `finite` all numbers must be finite. Otherwise the caller checks the numbers that it uses.
        """
        parts = [self._parse(text, first, delimiter, finite) for first, text in self._chunks()]
        found: Any = map(np.concatenate, zip(*parts, strict=True))
        values, widths, lines = found
        return Rows(values, np.concatenate([[0], np.cumsum(widths)]), lines, self.name)

    def _chunks(self) -> Iterator[tuple[int, str]]:
        """Yield pieces of whole lines, each with the number of its first line."""
        text, first = self.line + self._whole_lines(), self.number
        while text:
            yield first, text
            first += text.count("\n")
            text = self._whole_lines()
        self.line = ""
        yield first, ""  # this makes sure that there is always one

    def _whole_lines(self) -> str:
        text = self._stream.read(_CHUNK) + self._stream.readline()
        return _COMMENT.sub("", text) if "#" in text or "//" in text else text

    def _parse(
        self, text: str, first: int, delimiter: str, finite: bool
    ) -> tuple[Floats, Longs, Longs]:
        """Return the numbers of a piece, how many of them each filled line has, and the numbers of those lines."""
        if delimiter:
            self._check_fields(text, first, delimiter)
            text = text.replace(delimiter, " ")
        data = text.encode("latin-1")
        words, widths = data.split(), _words_per_line(data)
        try:
            values = np.array(list(map(float, words)), np.float64)
            fit = b"_" not in data and (not finite or np.isfinite(values).all())
        except ValueError:
            fit = False
        if not fit:
            bad = next(i for i, word in enumerate(words) if not _is_fit(word, finite))
            line = first + np.searchsorted(np.cumsum(widths), bad, side="right")
            raise ReadError(
                f"Expected finite numbers in line {line} of '{self.name}', "
                f"found {_shown(words[bad])}; mend or remove that line"
            )
        filled = np.flatnonzero(widths)
        return values, widths[filled], first + filled

    def _check_fields(self, text: str, first: int, delimiter: str) -> None:
        """Check that every field has exactly one word: '1,,2' and '1,5 2,5' are ambiguous."""
        blank = r"[ \t]"
        leading = f"(?m)^{blank}*{delimiter}"
        empty = f"{delimiter}{blank}*{delimiter}"
        double = rf"{blank}(?<=[^\s{delimiter}]{blank}){blank}*[^\s{delimiter}]"
        for pattern in (leading, empty, double):  # a single combined pattern is much slower
            if found := re.search(pattern, text):
                line = first + text.count("\n", 0, found.end() - 1)
                raise ReadError(
                    f"Expected one number between each two '{delimiter}' in line {line} of "
                    f"'{self.name}', found none or several; use one kind of separator, and points in decimals"
                )


@contextmanager
def open_file(path: str | os.PathLike) -> Iterator[BinaryIO]:
    """Open a file to read its bytes; errors of the system become a ReadError."""
    if not os.path.isfile(path):
        raise ReadError(f"Expected a file, found none at '{path}'; choose another one")
    try:
        with open(path, "rb") as stream:
            yield stream
    except ReadError:
        raise
    except OSError as error:
        raise ReadError(
            f"Expected to read '{path}', but the system says '{error.strerror or error}'; "
            "choose another file"
        ) from error


@contextmanager
def open_text(path: str | os.PathLike) -> Iterator[TextIO]:
    """Open a text file to read its characters, of one byte each, behind the byte order mark if it has one."""
    with open_file(path) as stream:
        skip_mark(stream)
        yield io.TextIOWrapper(stream, encoding="latin-1")


def skip_mark(stream: BinaryIO) -> None:
    """Skip the byte order mark at the beginning of a file, which editors on Windows write before text."""
    if stream.read(len(_BYTE_ORDER_MARK)) != _BYTE_ORDER_MARK:
        stream.seek(0)


@contextmanager
def open_lines(path: str | os.PathLike) -> Iterator[Lines]:
    """Open a text file as `Lines`."""
    with open_text(path) as stream:
        yield Lines(stream, Path(path).name)


def is_number(word: str | bytes) -> bool:
    """Return whether a word is a number; NaN, infinity and 1_000 count as numbers, too."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def _is_fit(word: bytes, finite: bool) -> bool:
    known = is_number(word) and b"_" not in word
    return known and (not finite or math.isfinite(float(word)))


def _shown(word: bytes) -> str:
    """Return a word for messages, shortened because a binary file may have very long ones."""
    return ascii(word[:24].decode("latin-1")) + ("..." if len(word) > 24 else "")


def _words_per_line(data: bytes) -> Longs:
    """Return the number of words of each line; the last line has no line feed, or is empty."""
    symbols = np.frombuffer(b"\n" + data + b"\n", np.uint8)
    blank = _BLANK[symbols]
    starts = np.flatnonzero(blank[:-1] > blank[1:])
    return np.diff(np.searchsorted(starts, np.flatnonzero(symbols == ord("\n"))))
