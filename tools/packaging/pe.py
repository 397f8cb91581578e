# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads libraries for Windows: files of Microsoft's format PE, without a Windows."""

from __future__ import annotations

import struct
from dataclasses import dataclass

X64, ARM64 = 0x8664, 0xAA64  # processors
NAMES = {X64: "amd64", ARM64: "arm64"}  # as names of modules have them
_IMAGE, _WIDE, _BY_NUMBER = b"PE\0\0", 0x20B, 1 << 63
_ANYWHERE, _NOT_RUN = 0x40, 0x100  # Windows may choose the address; data is not run as code
_EXPORTS, _IMPORTS, _PLACES = 0, 1, 5  # rows of the table of directories


@dataclass(frozen=True)
class Image:
    """A library by what it says about itself."""

    processor: int
    taken: dict[str, set[str]]  # by library: the names taken from it, or '#' and the number
    exported: list[str]
    movable: bool  # Windows may load it at any address, and learns which places change then
    guarded: bool  # its data cannot be run as code


def read(data: bytes) -> Image:
    """A library; ValueError when it is none for a processor of 64 bits."""
    (head,) = struct.unpack_from("<I", data, 60)
    if data[:2] != b"MZ" or data[head : head + 4] != _IMAGE:
        raise ValueError("no library for Windows")
    processor, sections, _, _, _, size, _ = struct.unpack_from("<2H3I2H", data, head + 4)
    options = head + 24
    kind, flags = (struct.unpack_from("<H", data, options + at)[0] for at in (0, 70))
    if kind != _WIDE:
        raise ValueError("no library of 64 bits")
    image = _Sections(data, options + size, sections)
    starts = [struct.unpack_from("<I", data, options + 112 + 8 * row)[0] for row in range(6)]
    return Image(
        processor,
        _taken(image, starts[_IMPORTS]),
        _exported(image, starts[_EXPORTS]),
        bool(flags & _ANYWHERE and starts[_PLACES]),
        bool(flags & _NOT_RUN),
    )


class _Sections:
    """The image as it would lie in memory, by addresses from its start."""

    def __init__(self, data: bytes, table: int, count: int) -> None:
        self._data = data
        # Each section: its size and start in memory, its size and start in the file.
        self._rows = [struct.unpack_from("<4I", data, table + 40 * i + 8) for i in range(count)]

    def words(self, form: str, address: int) -> tuple:
        return struct.unpack_from(form, self._data, self._place(address))

    def text(self, address: int) -> str:
        place = self._place(address)
        return self._data[place : self._data.index(b"\0", place)].decode()

    def _place(self, address: int) -> int:
        for _, start, size, place in self._rows:
            if start <= address < start + size:
                return address - start + place
        raise ValueError(f"no section holds the address {address}")


def _taken(image: _Sections, table: int) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    while table:
        names, _, _, library, places = image.words("<5I", table)
        if not library:
            break
        found.setdefault(image.text(library), set()).update(_names(image, names or places))
        table += 20
    return found


def _names(image: _Sections, row: int) -> list[str]:
    names = []
    while entry := image.words("<Q", row)[0]:
        by_number = entry & _BY_NUMBER
        names.append(f"#{entry & 0xFFFF}" if by_number else image.text(entry + 2))
        row += 8
    return names


def _exported(image: _Sections, table: int) -> list[str]:
    if not table:
        return []
    (count,) = image.words("<I", table + 24)
    (names,) = image.words("<I", table + 32)
    return [image.text(image.words("<I", names + 4 * row)[0]) for row in range(count)]
