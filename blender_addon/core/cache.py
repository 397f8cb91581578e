"""A memory of the last analyses, so that other thresholds for the same points cost milliseconds."""

from __future__ import annotations

import hashlib
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Any

import numpy as np

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
    """The most recent analyses; the newest always stays, older ones as long as there is room.

    Parameters
    ----------
    entries : int
        Most analyses that are kept.
    points : int
        Most points that all kept analyses have together (about 1.5 KB each).
    """

    def __init__(self, entries: int = 8, points: int = 1_500_000) -> None:
        self._entries = entries
        self._points = points
        self._kept: OrderedDict[str, tuple[Any, int]] = OrderedDict()
        self._lock = threading.Lock()
        self.analyses = 0  # computed since Blender started

    def get(self, key: str) -> Any | None:
        with self._lock:
            if key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key][0]

    def put(self, key: str, analysis: Any, points: int) -> None:
        with self._lock:
            self._kept[key] = (analysis, points)
            self._kept.move_to_end(key)
            self.analyses += 1
            while len(self._kept) > 1 and self._too_much():
                self._kept.popitem(last=False)

    def clear(self) -> None:
        with self._lock:
            self._kept.clear()

    def __len__(self) -> int:
        return len(self._kept)

    def _too_much(self) -> bool:
        points = sum(points for _, points in self._kept.values())
        return len(self._kept) > self._entries or points > self._points


CACHE = AnalysisCache()
