# SPDX-License-Identifier: GPL-3.0-or-later
"""Work on several shapes runs directly, or in a thread that can be watched and cancelled."""

from __future__ import annotations

import atexit
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import Cancelled, MedialAxisError, out_of_memory
from .progress import Progress

_DRAFT = 0.15  # of the work of a task


@dataclass(frozen=True, eq=False)
class Task:
    """A task is work on one shape; `work` is called with a `Progress` or None, and `name` is for messages.

    A `draft` is work whose quick answer comes before that of all tasks, where people watch the job.
    """

    name: str
    work: Callable[[Progress | None], Any]
    draft: Callable[[Progress | None], Any] | None = None


@dataclass(frozen=True, eq=False)
class Outcome:
    """An outcome of a task has the value that its work returned, or an error."""

    value: Any
    error: MedialAxisError | None


def run_task(task: Task, progress: Progress | None = None) -> Outcome:
    """Do the work and return its outcome; of the add-on's errors only `Cancelled` is raised."""
    try:
        return Outcome(task.work(progress), None)
    except Cancelled:
        raise
    except MedialAxisError as error:
        return Outcome(None, error)
    except MemoryError:  # NumPy may raise it anywhere
        return Outcome(None, out_of_memory())


class Job:
    """Runs drafts and then tasks one after the other in a thread, which ends with `outcomes`, `stop` or the
    interpreter."""

    def __init__(self, tasks: Sequence[Task]) -> None:
        drafts = [Task(task.name, task.draft) for task in tasks if task.draft is not None]
        self._drafts = len(drafts)
        tasks = (*drafts, *tasks)
        self.names = tuple(task.name for task in tasks)
        self._progress = tuple(Progress() for _ in tasks)
        self._current = 0
        self._cancelled = False
        self._outcomes: list[Outcome] = []
        self._failure: BaseException | None = None
        self._ended = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(tuple(tasks),), name="medial axis", daemon=True
        )
        try:
            self._thread.start()
        except RuntimeError:  # the system has no more threads, so this one does the work
            self._run(tuple(tasks))
            return
        # A daemon thread inside the compiled module must not outlive the interpreter.
        atexit.register(self.stop)

    @property
    def done(self) -> bool:
        return self._ended.is_set() and not self._thread.is_alive()

    @property
    def cancelled(self) -> bool:
        return self._cancelled

    @property
    def fraction(self) -> float:
        """Return the share of all tasks that is done, 0 to 1."""
        done = self._current + self._progress[self._current].fraction
        saved = 1.0 - _DRAFT  # which a draft is shorter than a task
        done -= saved * min(done, self._drafts)
        return done / (len(self._progress) - saved * self._drafts)

    @property
    def name(self) -> str:
        """Return the name of the task that runs."""
        return self.names[self._current]

    @property
    def stage(self) -> str:
        """Return the stage, such as 'Poles', or '1 of 2: Poles' if there are several tasks."""
        count, number = len(self.names) - self._drafts, self._current + 1 - self._drafts
        which = f"{number} of {count}: " if count > 1 and number > 0 else ""
        return which + (self._progress[self._current].stage or "Preparing")

    @property
    def text(self) -> str:
        """Return a text such as 'Suzanne, 1 of 2: Poles, 42 %'."""
        return f"{self.name}, {self.stage}, {100 * self.fraction:.0f} %"

    def wait(self, seconds: float) -> bool:
        """Wait at most this many seconds, and return whether the job is done.

        It does not join the thread: after a Ctrl-C in `Thread.join` Python 3.11 believes that the thread ended.
        """
        return self._ended.wait(seconds)

    def cancel(self) -> None:
        """Ask the thread to end, which it does within 0.3 s."""
        self._cancelled = True
        for progress in self._progress:
            progress.cancel()

    def stop(self) -> None:
        """Cancel the tasks, and wait until the thread has ended."""
        self.cancel()
        self._join()

    @property
    def drafts(self) -> list[Outcome]:
        """Return the outcomes of the drafts, in order; none before all of them are there."""
        found = self._outcomes[: self._drafts]
        return found if len(found) == self._drafts else []

    def outcomes(self) -> list[Outcome]:
        """Wait for the thread, and return the outcome of each task, in order."""
        self._join()
        if self._failure is not None:
            raise self._failure
        if self._cancelled:
            raise Cancelled("The computation was cancelled; nothing was changed")
        return self._outcomes[self._drafts :]

    def _join(self) -> None:
        if self._thread.ident is not None:  # the thread was started
            self._thread.join()
            atexit.unregister(self.stop)

    def _run(self, tasks: tuple[Task, ...]) -> None:
        try:
            for number, task in enumerate(tasks):
                self._current = number
                self._outcomes.append(run_task(task, self._progress[number]))
                if self._cancelled:
                    return
        except Cancelled:
            self._cancelled = True
        except BaseException as failure:  # `outcomes` raises it
            self._failure = failure
        finally:
            self._ended.set()
