# SPDX-License-Identifier: GPL-3.0-or-later
"""The one computation that may run at a time: here it is started, shown, and ended."""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

from ...core.machine import native
from ...core.machine.cache import CACHE
from ...core.machine.job import Job, Task
from .plain_words import doing
from .translation import say

_A_MOMENT = 0.1  # seconds
_job: Job | None = None
_product = ""


def start(tasks: list[Task], product: str) -> Job:
    """Begin a computation of `product`s; `finish` or `stop` ends it. There must be none."""
    global _job, _product
    _job, _product = Job(tasks), product
    return _job


def job() -> Job | None:
    """The computation that runs now."""
    return _job


def finish(ended: Job) -> None:
    """Forget a computation and clear what was shown of it."""
    global _job
    if _job is ended:
        _job = None
        for workspace in bpy.data.workspaces:
            workspace.status_text_set(None)
        settle()


def stop() -> None:
    """Cancel the computation, if there is one, and wait for its end (at most 0.3 s)."""
    if _job is not None:
        _job.stop()
        finish(_job)


def show(context: bpy.types.Context) -> None:
    """Stage and percentage in the status bar and the panel."""
    if _job is not None and context.workspace is not None:
        share = f"{100 * _job.fraction:.0f} %"
        what = f"{say(_product.title())}: {_job.name}, {doing(_job.stage)}, {share}"
        hint = say("Esc: Cancel")
        context.workspace.status_text_set(f"{what}    {hint}")
    redraw()


def redraw() -> None:
    """Draw the sidebars again, not the viewports: a large scene would take Blender's time."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            for area in window.screen.areas:
                for region in area.regions:
                    if area.type == "VIEW_3D" and region.type == "UI":
                        region.tag_redraw()


def settle() -> None:
    """Draw the sidebars now and a few times more: something was made, and panels appear or grow."""
    redraw()
    if not bpy.app.background:
        bpy.app.timers.register(_Settling(), first_interval=_A_MOMENT)


class _Settling:
    """A timer for that; panels take more than one drawing until none of them overlaps another."""

    def __init__(self) -> None:
        self._left = 30

    def __call__(self) -> float | None:
        redraw()
        self._left -= 1
        return _A_MOMENT if self._left and _job is None else None


def obstacle() -> str:
    """Why nothing can be computed now, in one sentence, or an empty string."""
    if problem := native.problem():
        return problem
    if _job is not None:
        return f"A {_product} is being computed; wait for it, or press Esc to cancel it"
    return ""


@persistent
def _before_load(*_: object) -> None:
    stop()
    CACHE.clear()


def register() -> None:
    bpy.app.handlers.load_pre.append(_before_load)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(_before_load)
    stop()
    CACHE.clear()
