# SPDX-License-Identifier: GPL-3.0-or-later
"""Auto Update: a result is computed again when its source has rested after an edit.

A handler looks at Blender's changes while some result has Auto Update on, and a timer runs while an edit waits. The
work is done in the job's thread by an operator that makes no step of undo, so Ctrl+Z takes back what an artist did, and
Redo still has its steps. An update uses only what a step of undo has, and fills the mesh that there is (`replace_mesh`
says why). Undo may then bring back the object, its mesh, both or neither as they were when the step was made. So the
handlers of undo look at all live results, and these follow.

Moves need no computation, because results are children.
"""

import time
from dataclasses import replace
from functools import partial

import bpy
from bpy.app.handlers import persistent

from ...bridge.axis.axis_object import settings_of
from ...bridge.axis.live_result import (
    LIVE,
    can_be_live,
    is_at_rest,
    live_results,
    read_live,
    write_live,
)
from ...bridge.axis.shown_axis import compute_draft, compute_shown
from ...bridge.mesh import stored
from ...bridge.nodes.wires import wires_group
from ...bridge.objects.output_object import source_of
from ...bridge.objects.source_state import differs, state_of
from ...core.errors import Cancelled, MedialAxisError
from ...core.machine.job import Task
from ...core.samples.thinning import is_coarse
from ...core.settings import ANALYSED
from ..base import current_job
from ..base.translation import IN_CONTEXT
from ..base.watched_job import CANCELLED, WatchedJob
from ..settings.preferences import memory_limit
from ..settings.properties import needs_analysis, settings_from, shown_result

_REST = 0.5  # seconds without edits
_LOOK = 0.25  # seconds between two looks at an edit that waits

_edited = None  # when the last edit was that waits
_refused = {}  # name of a result -> the wish that was cancelled or failed; it is not tried again


def draw_auto_update(layout, result):
    """Draws the switch of a result, an icon without words."""
    if can_be_live(result):
        layout.prop(result, LIVE, text="", icon="FILE_REFRESH")


# --- which result is computed next


def next_result(context):
    """The first live result that no longer belongs to its source and settings and may be computed now, or None."""
    for result in live_results():
        if (
            is_at_rest(result)
            and _is_outdated(context, result)
            and _refused.get(result.name) != wish(context, result)
        ):
            return result
    return None


def _is_outdated(context, result):
    if differs(result, context.view_layer.depsgraph):
        return True
    is_shown = shown_result(context) == result
    return is_shown and needs_analysis(result, context.scene.medial_axis)


def wish(context, result):
    """The state of the source and the settings for which a result would be computed.

    As with Compute Again the panel has the settings that need another analysis; the others stay those of the result.
    """
    panel = settings_from(context.scene.medial_axis)
    settings = replace(settings_of(result), **{name: getattr(panel, name) for name in ANALYSED})
    return state_of(source_of(result), context.view_layer.depsgraph), settings


# --- what starts an update


def _after_update(_scene, depsgraph):
    if depsgraph.mode != "VIEWPORT":
        return
    sources = {source_of(result) for result in live_results()}
    if not sources:
        _switch_handler(False)
        _touch()  # a job may run for a source that was removed
    elif any(_concerns(update.id.original, sources) for update in depsgraph.updates):
        _touch()


def _concerns(changed, sources):
    """Scenes hold the settings of the panel."""
    return isinstance(changed, bpy.types.Scene) or changed in sources


def _after_undo(_scene, _depsgraph=None):
    """A step may have switched Auto Update on or off, and what it brought back is in no list of changes."""
    _refused.clear()
    _watch()


@persistent
def _after_load(*_):
    _forget()
    _refused.clear()
    _watch()


def _switched(result, _context):
    _refused.pop(result.name, None)
    _watch()


def _watch():
    """Look at changes as long as there is a live result."""
    if bpy.app.background or not live_results():
        _switch_handler(False)
        return
    _switch_handler(True)
    wires_group()  # an update makes none
    for handlers in _undo_handlers():  # Blender removes them when another file is opened
        if _after_undo not in handlers:
            handlers.append(_after_undo)
    _touch()


def _switch_handler(on):
    handlers = bpy.app.handlers.depsgraph_update_post
    if _after_update in handlers:
        handlers.remove(_after_update)
    if on:
        handlers.append(_after_update)


def _undo_handlers():
    return bpy.app.handlers.undo_post, bpy.app.handlers.redo_post


def _touch():
    global _edited
    _edited = time.monotonic()
    if not bpy.app.timers.is_registered(_begin):
        bpy.app.timers.register(_begin, first_interval=_REST)


def _forget():
    global _edited
    _edited = None


def waits():
    """Whether an edit waits to be looked at."""
    return _edited is not None


def _begin():
    """Begins the update that waits, or looks again in a moment."""
    windows = bpy.context.window_manager.windows
    if _edited is None or not windows:
        return _forget()
    rested = time.monotonic() - _edited >= _REST
    if not rested or current_job.job() is not None or _is_busy(windows):
        return _LOOK
    _forget()
    with bpy.context.temp_override(window=windows[0]):
        if OBJECT_OT_medial_axis_auto_update.poll(bpy.context):
            bpy.ops.object.medial_axis_auto_update("INVOKE_DEFAULT")
    return None


def _is_busy(windows):
    """Whether Blender renders, or a modal operator runs, such as a transform; it tells the latter from 4.2 on."""
    if bpy.app.is_job_running("RENDER"):
        return True
    return any(len(getattr(window, "modal_operators", ())) for window in windows)


# --- the work


class OBJECT_OT_medial_axis_auto_update(WatchedJob, bpy.types.Operator):
    """Compute a medial axis again because its source was edited"""

    bl_idname = "object.medial_axis_auto_update"
    bl_label = "Update Medial Axis"
    bl_options = {"INTERNAL"}  # no UNDO: it is no step of an artist

    after_escape = frozenset({"PASS_THROUGH"})  # a transform that runs is cancelled, too

    @classmethod
    def poll(cls, context):
        return not current_job.obstacle() and next_result(context) is not None

    def invoke(self, context, _event):
        result = next_result(context)
        self._name, self._wish, self._seen = result.name, wish(context, result), None
        try:
            self._read = read_live(result, context.view_layer.depsgraph)
        except MedialAxisError as error:
            return self._refuse(context, f"'{self._name}': {error}")
        is_slow = result.get(stored.SECONDS, 0.0) > 1.0
        has_draft = is_slow and not is_coarse(self._read.shape, self._wish[1])
        self._stages = [compute_draft, compute_shown] if has_draft else [compute_shown]
        return self.watch(context, self._tasks(), "medial axis")

    def _tasks(self):
        read, compute = self._read, self._stages.pop(0)
        work = partial(compute, read.shape, self._wish[1], read.look, memory_limit())
        return [Task(self._name, work)]

    def meanwhile(self):
        """An edit makes the work worthless; another update begins when the edits have ended."""
        if waits() and self._seen != _edited:
            self._seen = _edited
            if self._is_for_nothing(bpy.context):
                self._job.cancel()

    def _is_for_nothing(self, context):
        result = bpy.data.objects.get(self._name)
        if result is None or result not in live_results():
            return True
        now = wish(context, result)
        return now[0] is not None and now != self._wish

    def ended(self, context):
        try:
            (outcome,) = self._job.outcomes()
            if outcome.error is not None:
                raise outcome.error
            write_live(self._read, outcome.value, is_coarse=bool(self._stages))
        except Cancelled:
            return {"CANCELLED"} if waits() else self._refuse(context, CANCELLED)
        except MedialAxisError as error:
            return self._refuse(context, f"'{self._name}': {error}")
        if self._stages:
            self.start_job(context, self._tasks(), "medial axis")
            return {"RUNNING_MODAL"}
        context.scene.medial_axis.note = ""
        _touch()  # there may be another live result
        return {"FINISHED"}

    def _refuse(self, context, sentence):
        """Tell it in the panel; the same is tried again only after another edit."""
        _refused[self._name] = self._wish
        context.scene.medial_axis.note = sentence
        return {"CANCELLED"}


PROPERTIES = {
    (bpy.types.Object, "medial_axis_auto_update"): bpy.props.BoolProperty(
        name="Auto Update",
        description="Compute this medial axis again whenever its source was edited and has rested for half a second",
        default=False,
        options=set(),
        update=_switched,
        **IN_CONTEXT,
    )
}


def register():
    bpy.app.handlers.load_post.append(_after_load)
    if (
        not bpy.app.background
    ):  # a file may be open already, which no add-on may look at while it is registered
        bpy.app.timers.register(_watch, first_interval=_LOOK)


def unregister():
    bpy.app.handlers.load_post.remove(_after_load)
    _switch_handler(False)
    for handlers in _undo_handlers():
        if _after_undo in handlers:
            handlers.remove(_after_undo)
    for timer in (_begin, _watch):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    _forget()
    _refused.clear()
