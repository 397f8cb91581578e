# SPDX-License-Identifier: GPL-3.0-or-later
"""A task that shows its progress, and that Ctrl-C or a polite kill stops at once."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..core.machine.job import Job, Outcome, Task


def watch(task: Task, show: Callable[[str], None]) -> Outcome:
    """Run a task in a thread, so that Ctrl-C stops it at once."""
    job = Job([task])
    try:
        while not job.wait(0.1):
            show(job.text)
        return job.outcomes()[0]
    except BaseException:
        job.stop()
        raise
    finally:
        show("")


@contextmanager
def interruptible() -> Iterator[None]:
    """The first Ctrl-C or polite kill raises KeyboardInterrupt, inside Blender, too; more are ignored.

    Python drops what is raised while a weak reference dies, so there it is raised again a moment later.
    """
    hook, again = sys.unraisablehook, threading.Timer(0.05, _thread.interrupt_main)
    kept = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def stop(_number: int, _frame: object) -> None:
        for number in kept:
            signal.signal(number, signal.SIG_IGN)
        raise KeyboardInterrupt

    def dropped(what: sys.UnraisableHookArgs) -> None:
        if what.exc_type is not KeyboardInterrupt:
            return hook(what)
        signal.signal(signal.SIGINT, stop)
        again.start()

    for number in kept:
        signal.signal(number, stop)
    sys.unraisablehook = dropped
    try:
        yield
    finally:
        again.cancel()
        sys.unraisablehook = hook
        for number, handler in kept.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
