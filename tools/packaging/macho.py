# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and joins libraries for Macs: files of Apple's format Mach-O, without a Mac.

A file holds one image for one processor, or several behind a table that says where each begins (a universal file).
"""

from __future__ import annotations

import hashlib
import struct
from dataclasses import dataclass

X64, ARM64 = 0x01000007, 0x0100000C  # processors
NAMES = {X64: "x64", ARM64: "arm64"}
_UNIVERSAL, _IMAGE = 0xCAFEBABE, 0xFEEDFACF
_LIBRARY_COMMANDS = {0xC, 0x80000018, 0x8000001F}  # load, load if there, export again
_SYMBOLS, _SEGMENT, _SIGNATURE, _VERSION, _OLD_VERSION = 0x2, 0x19, 0x1D, 0x32, 0x24
_PAGE = 14  # images begin at multiples of 2**14 bytes: memory pages of Apple's processors
_DEBUG, _PRIVATE, _TYPE, _EXTERNAL = 0xE0, 0x10, 0x0E, 0x01  # bits of a symbol's kind


@dataclass(frozen=True)
class Image:
    """The part of a library for one processor, by what it says about itself."""

    processor: int
    libraries: list[str]
    oldest_system: tuple[int, int] | None  # version of macOS, such as (11, 0)
    undefined: set[
        str
    ]  # names taken from others; each begins with an underscore that C does not show
    exported: set[str]
    signed: bool  # a signature is there, and the hash of each page agrees with it
    page: int  # bytes: the largest power of two of which all places of segments are multiples; 0 without segments


def processors(data: bytes) -> dict[int, bytes]:
    """The images of a file, by processor."""
    magic, count = struct.unpack_from(">II", data)
    if magic != _UNIVERSAL:
        return {struct.unpack_from("<II", data)[1]: data}
    rows = [struct.unpack_from(">5I", data, 8 + 20 * row) for row in range(count)]
    return {row[0]: data[row[2] : row[2] + row[3]] for row in rows}


def join(images: list[bytes]) -> bytes:
    """A universal file of images for different processors."""
    head, body = struct.pack(">II", _UNIVERSAL, len(images)), b""
    first = 1 << _PAGE
    for image in images:
        body += bytes(-len(body) % (1 << _PAGE))
        processor, kind = struct.unpack_from("<II", image, 4)
        head += struct.pack(">5I", processor, kind, first + len(body), len(image), _PAGE)
        body += image
    return head.ljust(first, b"\0") + body


def read(data: bytes) -> Image:
    """An image; ValueError when it is none."""
    magic, processor, _, _, count, *_ = struct.unpack_from("<8I", data)
    if magic != _IMAGE:
        raise ValueError("no image of 64 bits")
    libraries, version, symbols, signed = [], None, (set(), set()), False
    place, bits = 32, 0
    for _ in range(count):
        command, size = struct.unpack_from("<II", data, place)
        if command in _LIBRARY_COMMANDS:
            libraries.append(_text(data, place + struct.unpack_from("<I", data, place + 8)[0]))
        elif command in (_VERSION, _OLD_VERSION):
            (packed,) = struct.unpack_from("<I", data, place + (12 if command == _VERSION else 8))
            version = (packed >> 16, packed >> 8 & 0xFF)
        elif command == _SYMBOLS:
            symbols = _symbols(data, *struct.unpack_from("<4I", data, place + 8))
        elif command == _SEGMENT:
            in_memory, _, in_file = struct.unpack_from("<3Q", data, place + 24)
            bits |= in_memory | in_file
        elif command == _SIGNATURE:
            signed = _agrees(data, struct.unpack_from("<I", data, place + 8)[0])
        place += size
    return Image(processor, libraries, version, *symbols, signed, bits & -bits)


def _text(data: bytes, place: int) -> str:
    return data[place : data.index(b"\0", place)].decode()


def _symbols(data: bytes, table: int, count: int, names: int, _: int) -> tuple[set[str], set[str]]:
    """The names that an image takes from others, and those that it gives to others."""
    undefined: set[str] = set()
    exported: set[str] = set()
    for row in range(count):
        name, kind = struct.unpack_from("<IB", data, table + 16 * row)
        if kind & _DEBUG or not kind & _EXTERNAL:
            continue
        if kind & _TYPE == 0:
            undefined.add(_text(data, names + name))
        elif not kind & _PRIVATE:
            exported.add(_text(data, names + name))
    return undefined, exported


def _agrees(data: bytes, place: int) -> bool:
    """Whether the signature at a place has the hash (SHA-256) of each page before it."""
    _, _, count = struct.unpack_from(">III", data, place)
    for row in range(count):
        kind, offset = struct.unpack_from(">II", data, place + 12 + 8 * row)
        if kind == 0:  # the directory of hashes
            directory = place + offset
            hashes, _, _, pages, end = struct.unpack_from(">5I", data, directory + 16)
            size, algorithm, _, shift = struct.unpack_from("4B", data, directory + 36)
            step = 1 << shift
            found = [data[at : min(at + step, end)] for at in range(0, end, step)]
            digests = b"".join(hashlib.sha256(page).digest() for page in found)
            stated = data[directory + hashes : directory + hashes + 32 * pages]
            return (size, algorithm) == (32, 2) and end == place and digests == stated
    return False
