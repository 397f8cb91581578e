# SPDX-License-Identifier: GPL-3.0-or-later
"""This module combines the progress of several calls of the compiled module, and cancels them together."""

from __future__ import annotations

import threading
from types import ModuleType
from typing import Any

from . import native


class Progress:
    """Tracks work that calls the compiled module several times; two threads may use it safely."""

    def __init__(self) -> None:
        self._module: ModuleType = native.load()
        self._lock = threading.Lock()
        self._before = 0.0  # this share of the work was done before the running call
        self._share = 1.0  # the running call is this share of the work
        self._end = 1.0  # the next calls end at this share of the work
        self._last = 1.0  # where the last `until` let them end
        self._section = 0.0, 1.0
        self._running: Any = self._module.Progress()
        self._cancelled = False
        self._pass = 1

    def until(self, fraction: float) -> None:
        """Let the next calls end at this fraction; the rest belongs to calls after the next `until`."""
        begin, end = self._section
        with self._lock:
            self._end = self._last = begin + (end - begin) * fraction

    def begin_share(self, share: float) -> None:
        """Let the next calls end after a share of the work left up to the last `until`."""
        with self._lock:
            done = self._before + self._share * self._running.fraction
            self._end = done + share * max(0.0, self._last - done)

    def begin_section(self, begin: float, end: float) -> None:
        """Let the work that follows, with its own calls of `until`, go from one share of the whole to another."""
        self._section = begin, end
        self.until(1.0)

    def part(self, share: float = 1.0) -> Any:
        """Return a `_medial.Progress` for the next call, which is a `share` of the work left up to the last `until`."""
        with self._lock:
            self._before += self._share * self._running.fraction
            self._share = share * max(0.0, self._end - self._before)
            self._running = self._module.Progress()
            if self._cancelled:
                self._running.cancel()
            return self._running

    @property
    def fraction(self) -> float:
        """Return the share of the work that is done, 0 to 1; it never falls."""
        with self._lock:
            return min(1.0, self._before + self._share * self._running.fraction)

    def begin_pass(self, number: int) -> None:
        """Set the number of the pass over the same stages that begins now; pass 1 is not shown."""
        self._pass = number

    @property
    def stage(self) -> str:
        """Return the displayed name of the running stage, such as 'Poles' or 'Pass 2: Poles'."""
        stage = self._running.stage
        return f"Pass {self._pass}: {stage}" if stage and self._pass > 1 else stage

    @property
    def cancelled(self) -> bool:
        """Return whether `cancel` was called."""
        return self._cancelled

    def cancel(self) -> None:
        """Stop the running call, and all later ones, within 0.3 s."""
        with self._lock:
            self._cancelled = True
            self._running.cancel()
