# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads libraries for Windows: files of Microsoft's format PE, without a Windows."""

from __future__ import annotations

import struct
from dataclasses import dataclass

X64 = 0x8664  # the processor that names of modules call amd64
_IMAGE, _WIDE = b"PE\0\0", 0x20B


@dataclass(frozen=True)
class Image:
    """A library by what it says about itself."""

    processor: int
    libraries: set[str]  # those that it needs
    exported: list[str]


def read(data: bytes) -> Image:
    """A library; ValueError when it is none for a processor of 64 bits."""
    (head,) = struct.unpack_from("<I", data, 60)
    if data[:2] != b"MZ" or data[head : head + 4] != _IMAGE:
        raise ValueError("no library for Windows")
    processor, sections, _, _, _, size, _ = struct.unpack_from("<2H3I2H", data, head + 4)
    options = head + 24
    (kind,) = struct.unpack_from("<H", data, options)
    if kind != _WIDE:
        raise ValueError("no library of 64 bits")
    image = _Sections(data, options + size, sections)
    exports, _, imports = struct.unpack_from("<3I", data, options + 112)
    return Image(processor, _libraries(image, imports), _exported(image, exports))


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


def _libraries(image: _Sections, table: int) -> set[str]:
    found = set()
    while table and (library := image.words("<I", table + 12)[0]):
        found.add(image.text(library))
        table += 20
    return found


def _exported(image: _Sections, table: int) -> list[str]:
    if not table:
        return []
    (count,) = image.words("<I", table + 24)
    (names,) = image.words("<I", table + 32)
    return [image.text(image.words("<I", names + 4 * row)[0]) for row in range(count)]
