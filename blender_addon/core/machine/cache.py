# SPDX-License-Identifier: GPL-3.0-or-later
"""The cache keeps the last analyses, so that other thresholds for the same points cost milliseconds."""

from __future__ import annotations

import hashlib
import numbers
import threading
from collections import OrderedDict
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np

from ..settings import CACHE_SIZE, MEGABYTE


def key_of(*parts: Any) -> str:
    """Hash everything that an analysis depends on; the hash names the analysis.

    Parameters
    ----------
    *parts : array of numbers, str, bool, int, float, None, member of an Enum, or tuple of these
        All elements of an array count. Parts of different types differ, even if they print the same.

    Raises
    ------
    TypeError
        A part has another type.
    """
    digest = hashlib.blake2b(digest_size=16)
    _add(digest, parts)
    return digest.hexdigest()


def _add(digest: hashlib.blake2b, part: Any) -> None:
    """Add the type, length and content of a part to a hash, so that different lists of parts differ."""
    if isinstance(part, tuple):
        digest.update(f"tuple {len(part)};".encode())
        for item in part:
            _add(digest, item)
    elif isinstance(part, np.ndarray) and part.dtype.kind in "biuf":
        digest.update(f"array {part.dtype.str} {part.shape};".encode())
        digest.update(np.ascontiguousarray(part).data)
    else:
        text = _text_of(part)
        digest.update(f"{text[0]} {len(text[1])};".encode() + text[1])


def _text_of(part: Any) -> tuple[str, bytes]:
    """Return the type and the value of a single part; equal numbers of Python and NumPy give the same pair."""
    match part:
        case None:
            return "None", b""
        case Enum():
            return f"member of {type(part).__qualname__}", part.name.encode()
        case str():
            return "str", part.encode("utf-8", "surrogatepass")
        case bool() | np.bool_():
            return "bool", str(bool(part)).encode()
        case numbers.Integral():
            return "int", str(int(part)).encode()
        case numbers.Real():
            return "float", float(part).hex().encode()
    raise TypeError(
        f"Expected arrays of numbers, texts, numbers, None, members of enums or tuples of these in a key, "
        f"found {type(part).__name__}; convert it"
    )


def bytes_of(value: Any) -> int:
    """Return the memory of all that plain data holds: each array once, and what knows its own `bytes`."""
    found: dict[int, int] = {}
    left = [value]
    while left:
        one = left.pop()
        if isinstance(one, np.ndarray):
            found[id(one)] = one.nbytes
        elif is_dataclass(one):
            left += [getattr(one, part.name) for part in fields(one)]
        elif hasattr(one, "bytes"):
            found[id(one)] = int(one.bytes)
    return sum(found.values())


class AnalysisCache:
    """Keeps the most recently used analyses that fit into its room, and drops the least recent first.

    An analysis that is larger than the whole room is not kept; it lives only as long as its computation.

    Parameters
    ----------
    room : int
        All kept analyses together may take this many bytes.
    """

    def __init__(self, room: int) -> None:
        self._room = room
        self._kept: OrderedDict[str, tuple[Any, int]] = OrderedDict()
        self._lock = threading.Lock()
        self.analyses = 0  # this many were computed since Blender started

    def get(self, key: str) -> Any | None:
        with self._lock:
            if key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key][0]

    def put(self, key: str, analysis: Any, size: int) -> None:
        """Keep an analysis that takes `size` bytes."""
        with self._lock:
            self.analyses += 1
            self._kept.pop(key, None)
            if size <= self._room:
                self._drop_until(self._room - size)
                self._kept[key] = (analysis, size)

    def resize(self, key: str, size: int) -> None:
        """Record that a kept analysis has grown to `size` bytes; older ones are dropped to make room."""
        with self._lock:
            if key not in self._kept:
                return
            analysis, _ = self._kept.pop(key)
            if size <= self._room:
                self._drop_until(self._room - size)
                self._kept[key] = (analysis, size)

    @property
    def room(self) -> int:
        return self._room

    @room.setter
    def room(self, size: int) -> None:
        with self._lock:
            self._room = size
            self._drop_until(size)

    @property
    def bytes(self) -> int:
        """Return the bytes that all kept analyses take together."""
        return sum(size for _, size in tuple(self._kept.values()))

    def give_back(self, size: int) -> None:
        """Drop analyses until they free at least `size` bytes, or none is left."""
        with self._lock:
            self._drop_until(max(0, self.bytes - size))

    def clear(self) -> None:
        with self._lock:
            self._kept.clear()

    def __len__(self) -> int:
        return len(self._kept)

    def _drop_until(self, size: int) -> None:
        while self.bytes > size:
            self._kept.popitem(last=False)


CACHE = AnalysisCache(CACHE_SIZE.default * MEGABYTE)
