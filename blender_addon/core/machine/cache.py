# SPDX-License-Identifier: GPL-3.0-or-later
"""A memory of the last analyses, so that other thresholds for the same points cost milliseconds."""

from __future__ import annotations

import hashlib
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Any

import numpy as np

from ..settings import CACHE_SIZE, MEGABYTE

if TYPE_CHECKING:
    from numpy.typing import NDArray


def key_of(*parts: NDArray | str | bool | None) -> str:
    """The name of an analysis: a hash of all that it depends on."""
    digest = hashlib.blake2b(digest_size=16)
    for part in parts:
        if isinstance(part, np.ndarray):
            digest.update(repr((part.shape, part.dtype.str)).encode())
            digest.update(np.ascontiguousarray(part).data)
        else:
            digest.update(repr(part).encode())
    return digest.hexdigest()


class AnalysisCache:
    """The most recent analyses, as many as there is room for; the oldest go first.

    An analysis that is larger than all the room is not kept; it lives as long as the computation that uses it.

    Parameters
    ----------
    room : int
        Bytes that all kept analyses may have together.
    """

    def __init__(self, room: int) -> None:
        self._room = room
        self._kept: OrderedDict[str, tuple[Any, int]] = OrderedDict()
        self._lock = threading.Lock()
        self.analyses = 0  # computed since Blender started

    def get(self, key: str) -> Any | None:
        with self._lock:
            if key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key][0]

    def put(self, key: str, analysis: Any, size: int) -> None:
        """Keep an analysis of so many bytes."""
        with self._lock:
            self.analyses += 1
            self._kept.pop(key, None)
            if size <= self._room:
                self._drop_until(self._room - size)
                self._kept[key] = (analysis, size)

    def resize(self, key: str, size: int) -> None:
        """An analysis, where it is kept, has grown to so many bytes; others go first to make room."""
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
        """What all kept analyses have together."""
        return sum(size for _, size in tuple(self._kept.values()))

    def give_back(self, size: int) -> None:
        """Drop analyses of at least so many bytes, as far as there are any."""
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
