# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders of large results: the new axis is extracted in the job's thread, and the old one stays until it is there.

Blender draws nothing while a property's update runs, so small results alone are updated in it. An update of a large
one begins when the slider has rested for a moment.
"""

import time

import bpy

from ...bridge.mesh import stored
from ...bridge.objects.output_object import is_gone
from ...core.errors import Cancelled, MedialAxisError
from ...core.machine.job import Task
from ..base import current_job
from ..base.watched_job import CANCELLED, WatchedJob

SAMPLES = 60_000  # results of more samples are updated in the thread
THRESHOLD_SAMPLES = 30_000  # the same where another hierarchy is needed
WIRES_AND_LOOPS = 10_000  # results of more wires, or of a tenth as many pieces and loops
_REST = 0.25  # seconds that a slider rests before the update begins

_wanted = None  # the update that waits: (name of the result, settings)
_asked = 0.0
_work = None  # what the thread does
_write = None  # called with the result, the settings, and what the work returned
_running = False
_applied = set()  # (name of the result, settings) of updates whose meshes are in no undo step


def needs_thread(result, levels_stay):
    """Whether an update of this result takes longer than a moment; `levels_stay` where the settings choose among the
    levels of the same hierarchy.
    """
    if bpy.app.background or not bpy.context.window_manager.windows:
        return False
    loops = sum(result.get(stored.BETTI, (0,)))
    most = SAMPLES if levels_stay else THRESHOLD_SAMPLES
    many = max(result.get(stored.WIRES, 0), 10 * loops) > WIRES_AND_LOOPS
    return many or result.get(stored.POINTS, 0) > most


def request(result, settings, work, write):
    """Have a result updated soon; a later request takes the place of this one.

    `work(progress)` extracts another axis in the thread; `write(result, settings, found)` gives it to the result in the
    main thread and returns a sentence or "".
    """
    global _wanted, _asked, _work, _write
    _wanted, _asked = (result.name, settings), time.monotonic()
    _work, _write = work, write
    if not bpy.app.timers.is_registered(_begin):
        bpy.app.timers.register(_begin, first_interval=_REST)


def was_applied(result, settings):
    """Whether the thread has given a result these settings before."""
    return (result.name, settings) in _applied


def waits():
    """Whether an update waits for its beginning."""
    return _wanted is not None


def runs():
    """Whether the computation that runs is such an update."""
    return _running


def _begin():
    """Begins the update that waits, or looks again in a moment."""
    if _wanted is None:
        return None
    rested = time.monotonic() - _asked >= _REST
    if not rested or current_job.job() is not None:
        return _REST
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window):
        bpy.ops.object.medial_axis_apply("INVOKE_DEFAULT")
    return None


class OBJECT_OT_medial_axis_apply(WatchedJob, bpy.types.Operator):
    """Apply the settings of the panel to the medial axis"""

    bl_idname = "object.medial_axis_apply"
    bl_label = "Apply to Medial Axis"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        return waits() and current_job.job() is None

    def invoke(self, context, _event):
        global _wanted, _running
        (self._name, self._settings), _wanted = _wanted, None
        result = bpy.data.objects.get(self._name)
        if is_gone(result):
            return {"CANCELLED"}
        self._key, _running = result[stored.ANALYSIS], True
        return self.watch(context, [Task(self._name, _work)], "medial axis")

    def meanwhile(self):
        if waits():  # the slider went on, so this is for nothing
            self._job.cancel()

    def ended(self, context):
        context.scene.medial_axis.note = self._apply()
        return {"FINISHED"}

    def stop_watching(self, context):
        global _running
        _running = False
        super().stop_watching(context)

    def _apply(self):
        """Write what was extracted; returns a sentence for the panel, or nothing."""
        try:
            (outcome,) = self._job.outcomes()
            if outcome.error is not None:
                raise outcome.error
            result = bpy.data.objects.get(self._name)
            if is_gone(result) or result.get(stored.ANALYSIS) != self._key:
                return ""
            _applied.add((self._name, self._settings))
            return _write(result, self._settings, outcome.value)
        except Cancelled:
            return "" if waits() else CANCELLED
        except MedialAxisError as error:
            return str(error)


def unregister():
    global _wanted, _running
    _wanted, _running = None, False
    _applied.clear()
    if bpy.app.timers.is_registered(_begin):
        bpy.app.timers.unregister(_begin)
