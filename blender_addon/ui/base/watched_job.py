# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose work a thread does: a timer watches it, and Esc cancels it."""

from . import current_job

CANCELLED = "It was cancelled"  # in the panel: one row, so that nothing moves


class WatchedJob:
    """An operator that watches a job until it is done, and then calls its own `ended(context)`.

    `ended` takes the outcomes from `self._job` and returns what `modal` returns; it may start another job with
    `start_job` and go on.
    """

    after_escape = frozenset({"RUNNING_MODAL"})  # whether others see the key, too

    def watch(self, context, tasks, product):
        """Start the work; `invoke` returns what this returns."""
        self.start_job(context, tasks, product)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def start_job(self, context, tasks, product):
        self._job = current_job.start(tasks, product)
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        current_job.show(context)

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
            return set(self.after_escape)
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        self.meanwhile()
        if not self._job.done:
            current_job.show(context)
            return {"PASS_THROUGH"}
        self.stop_watching(context)
        return self.ended(context)

    def cancel(self, context):
        """Blender ends the operator: its window closes, a file is loaded, Blender quits."""
        self._job.stop()
        self.stop_watching(context)

    def meanwhile(self):
        """Called ten times per second; it may cancel the job."""

    def stop_watching(self, context):
        context.window_manager.event_timer_remove(self._timer)
        current_job.finish(self._job)
