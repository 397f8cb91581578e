# SPDX-License-Identifier: GPL-3.0-or-later
"""Work can run in parallel with other work: while CGAL inserts points it uses only one core."""

from __future__ import annotations

import threading
from collections.abc import Callable
from types import TracebackType
from typing import Any, Generic, TypeVar

from . import native

T = TypeVar("T")


class Beside(Generic[T]):
    """Runs work in its own thread during a `with`; `result` then returns its value or raises its error.

    If the body of the `with` fails, the work is cancelled. The `with` ends only when the work has ended.

    Parameters
    ----------
    work : callable
        It is called with a `_medial.Progress`, which nobody watches.
    """

    def __init__(self, work: Callable[[Any], T]) -> None:
        self._work = work
        self._progress = native.load().Progress()
        self._ended = threading.Event()
        self._value: T
        self._failure: BaseException | None = None

    def __enter__(self) -> Beside[T]:
        thread = threading.Thread(target=self._run, name="beside")
        try:
            thread.start()
        except RuntimeError:  # the system has no more threads, so this one does the work
            self._run()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        if kind is not None:
            self._progress.cancel()
        self._ended.wait()  # joining is unsafe: after a Ctrl-C Python 3.11 believes that the thread ended

    def result(self) -> T:
        """Return the value of the work after the `with`; an error of the work is raised here."""
        if self._failure is not None:
            raise self._failure
        return self._value

    def _run(self) -> None:
        try:
            self._value = self._work(self._progress)
        except BaseException as failure:  # `result` raises it
            self._failure = failure
        finally:
            self._ended.set()
