# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress of several calls of the compiled module as one fraction, and one `cancel` for all of them."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from . import native

if TYPE_CHECKING:
    from types import ModuleType


class Progress:
    """The progress of work that calls the compiled module several times; safe to use from two threads."""

    def __init__(self) -> None:
        self._module: ModuleType = native.load()
        self._lock = threading.Lock()
        self._before = 0.0  # share of the work that was done before the running call
        self._share = 1.0  # share of the work that the running call is
        self._end = 1.0  # share of the work after which the calls that follow now are over
        self._running: Any = self._module.Progress()
        self._cancelled = False
        self._pass = 1

    def until(self, fraction: float) -> None:
        """The work that follows ends at this fraction; the rest belongs to the work after the next `until`."""
        with self._lock:
            self._end = fraction

    def part(self, share: float = 1.0) -> Any:
        """A `_medial.Progress` for the next call, which is a `share` of all that is left to do until then."""
        with self._lock:
            self._before += self._share * self._running.fraction
            self._share = share * max(0.0, self._end - self._before)
            self._running = self._module.Progress()
            if self._cancelled:
                self._running.cancel()
            return self._running

    @property
    def fraction(self) -> float:
        """Share of the work that is done, 0 to 1, never falling."""
        with self._lock:
            return min(1.0, self._before + self._share * self._running.fraction)

    def begin_pass(self, number: int) -> None:
        """Say which pass over the same stages begins now; the first has no name."""
        self._pass = number

    @property
    def stage(self) -> str:
        """Name of the running stage, for people, such as 'Poles' or 'Pass 2: Poles'."""
        stage = self._running.stage
        return f"Pass {self._pass}: {stage}" if stage and self._pass > 1 else stage

    @property
    def cancelled(self) -> bool:
        """Whether `cancel` was called."""
        return self._cancelled

    def cancel(self) -> None:
        """Stop the running call and those that follow within 0.3 s."""
        with self._lock:
            self._cancelled = True
            self._running.cancel()
