"""Compute Medial Axis: watched from the user interface, in one go from scripts."""

import time
from dataclasses import dataclass

import bpy

from ..bridge.read_object import read_object
from ..bridge.results import check_writable, is_gone, is_result, source_of, write_result
from ..core.errors import Cancelled, MedialAxisError
from ..core.job import Task, run_task
from ..core.settings import OPTIONS
from . import running
from .properties import choice, number, settings_from, switch


@dataclass(frozen=True)
class Source:
    """A source that is found again later; `uid` is Blender's number for it, from 4.1 or so."""

    name: str
    uid: int | None
    frame: object  # (4, 4) float64

    def find(self):
        """The object, or None when it is gone."""
        if self.uid is None:
            found = bpy.data.objects.get(self.name)
        else:
            found = next((o for o in bpy.data.objects if o.session_uid == self.uid), None)
        return None if is_gone(found) else found


def sources(context) -> list:
    """The selected meshes and those in edit mode; instead of a result, the mesh it was made of."""
    found = []
    for thing in [*_of(context, "selected_objects"), *_of(context, "objects_in_mode")]:
        source = source_of(thing) if is_result(thing) else thing
        if source is not None and source.type == "MESH" and not is_gone(source):
            found.append(source)
    return list(dict.fromkeys(found))


def _of(context, name) -> list:
    """A list of the context that not every editor has."""
    return getattr(context, name, None) or []


def obstacle(context) -> str:
    """Why the operator cannot run now, in one sentence, or an empty string."""
    if reason := running.obstacle():
        return reason
    if sources(context):
        return ""
    chosen = _of(context, "selected_objects")
    if not chosen:
        return "Select a mesh object; nothing is selected"
    thing = chosen[0]
    if is_result(thing):
        return f"Select a mesh object; '{thing.name}' is a medial axis whose source is gone"
    return (
        f"Select a mesh object; '{thing.name}' is of type {thing.type.capitalize()} "
        "(Object > Convert may make it a mesh)"
    )


class OBJECT_OT_medial_axis(bpy.types.Operator):
    """Compute the medial axis of the selected meshes, with the radius at every point"""

    bl_idname = "object.medial_axis"
    bl_label = "Compute Medial Axis"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    theta: number("theta")
    rho: number("rho")
    side: choice("side")
    rule: choice("rule")
    criteria: choice("criteria")
    limit_set: switch("limit_set")

    @classmethod
    def poll(cls, context):
        reason = obstacle(context)
        if reason:
            cls.poll_message_set(reason)
        return not reason

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in OPTIONS:
            self.layout.prop(self, name)

    def execute(self, context):
        found, tasks = self._read(context)
        return self._write(context, found, [run_task(task) for task in tasks])

    def invoke(self, context, _event):
        if bpy.app.background or context.window is None:
            return self.execute(context)
        self._sources, tasks = self._read(context)
        if not tasks:
            return {"CANCELLED"}
        self._gone = ""
        self._job = running.start(tasks)
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        running.show(context)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self._job.done:
            self._watch_sources()
            running.show(context)
            return {"PASS_THROUGH"}
        self._stop_watching(context)
        try:
            return self._write(context, self._sources, self._job.outcomes())
        except Cancelled as error:
            self._tell(context, "WARNING", self._gone or str(error))
            return {"CANCELLED"}

    def cancel(self, context):
        """Blender ends the operator: its window closes, a file is loaded, Blender quits."""
        self._job.stop()
        self._stop_watching(context)

    def _stop_watching(self, context):
        context.window_manager.event_timer_remove(self._timer)
        running.finish(self._job)

    def _watch_sources(self):
        for source in self._sources:
            if source.find() is None and not self._gone:
                self._gone = (
                    f"'{source.name}' was deleted while its medial axis was computed; "
                    "nothing was changed"
                )
                self._job.cancel()

    def _tell(self, context, kind, text):
        """Report, and keep what went wrong in the panel: Blender's message fades in seconds."""
        self.report({kind}, text)
        if kind != "INFO":
            panel = context.scene.medial_axis
            panel.note = f"{panel.note}\n{text}".strip()

    def _read(self, context):
        """The sources that can be read, and what to compute of them; the others are reported."""
        context.scene.medial_axis.note = ""
        found, tasks = [], []
        depsgraph = context.evaluated_depsgraph_get()
        for thing in sources(context):
            try:
                settings = settings_from(self)
                check_writable(thing)
                shape = read_object(thing, depsgraph)
            except MedialAxisError as error:
                self._tell(context, "ERROR", f"'{thing.name}': {error}")
                continue
            found.append(Source(thing.name, getattr(thing, "session_uid", None), shape.frame))
            tasks.append(Task(thing.name, shape.points, shape.triangles, settings))
        return found, tasks

    def _write(self, context, found, outcomes):
        results = []
        for source, outcome in zip(found, outcomes, strict=True):
            try:
                results += self._write_one(context, source, outcome)
            except MedialAxisError as error:
                self._tell(context, "ERROR", f"'{source.name}': {error}")
        _select(context, results)
        return {"FINISHED"} if results else {"CANCELLED"}

    def _write_one(self, context, source, outcome):
        if outcome.error is not None:
            raise outcome.error
        thing = source.find()
        if thing is None:
            self._tell(context, "WARNING", f"'{source.name}' is gone; its medial axis was dropped")
            return []
        computation = outcome.computation
        if computation.axis.facets == 0:
            for warning in computation.warnings:
                self._tell(context, "WARNING", f"'{source.name}': {warning}")
            return []
        for warning in computation.warnings:  # the panel shows them with the result
            self.report({"WARNING"}, f"'{source.name}': {warning}")
        start = time.perf_counter()
        result = write_result(thing, computation, source.frame)
        seconds = computation.seconds + time.perf_counter() - start
        self._tell(context, "INFO", _summary(source.name, computation, seconds))
        return [result]


class OBJECT_OT_medial_axis_cancel(bpy.types.Operator):
    """Stop the computation of the medial axis; nothing is changed"""

    bl_idname = "object.medial_axis_cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        if running.job() is None:
            cls.poll_message_set("No medial axis is being computed")
        return running.job() is not None

    def execute(self, _context):
        running.job().cancel()
        return {"FINISHED"}


def _summary(name, computation, seconds):
    axis = computation.axis
    return (
        f"'{name}': {computation.points:,} points, {axis.facets:,} facets, "
        f"{seconds:.2f} s, duplicates merged {computation.duplicates:,}, "
        f"unbounded facets {axis.unbounded:,}"
    )


def _select(context, results):
    """Select the results and nothing else, as Blender does with new objects; not in edit mode."""
    if not results or context.mode != "OBJECT":
        return
    context.view_layer.update()
    for thing in context.selected_objects:
        thing.select_set(False)
    shown = [result for result in results if result.name in context.view_layer.objects]
    for result in shown:
        result.select_set(True)
    if shown:
        context.view_layer.objects.active = shown[0]


CLASSES = (OBJECT_OT_medial_axis, OBJECT_OT_medial_axis_cancel)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
