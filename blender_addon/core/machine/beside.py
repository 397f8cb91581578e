# SPDX-License-Identifier: GPL-3.0-or-later
"""Work beside other work: while CGAL inserts points it leaves all cores but one idle."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from . import native

if TYPE_CHECKING:
    from types import TracebackType

T = TypeVar("T")


class Beside(Generic[T]):
    """Work in a thread of its own during a `with`; what it returned, or raised, comes from `result` afterwards.

    When the body of the `with` fails the work is cancelled. It never outlives the body.

    Parameters
    ----------
    work : callable
        Called with a `_medial.Progress`, which nobody watches.
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
        except RuntimeError:  # the system has no thread to give: the work is done here and now
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
        self._ended.wait()  # not by joining: a Ctrl-C there makes Python 3.11 believe that it ended

    def result(self) -> T:
        """Wait for the work and return its result; an error of the work is raised here."""
        if self._failure is not None:
            raise self._failure
        return self._value

    def _run(self) -> None:
        try:
            self._value = self._work(self._progress)
        except BaseException as failure:  # raised where the result is asked for
            self._failure = failure
        finally:
            self._ended.set()
