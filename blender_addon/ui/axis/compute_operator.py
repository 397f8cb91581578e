# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of the operators that compute: modal in the user interface, where a timer watches a thread; from scripts
they run in one go."""

import time
from dataclasses import dataclass
from functools import partial

import bpy

from ...bridge.objects.output_object import follow
from ...bridge.objects.read_object import read_object
from ...bridge.objects.source_state import remember_state, state_of
from ...bridge.objects.step_back import seen
from ...core.errors import Cancelled, MedialAxisError
from ...core.machine.job import Task, run_task
from ...core.settings import OPTIONS
from ...core.shape.shape import Shape
from ..base import current_job
from ..base.plain_words import told, warned
from ..base.select_made import select_made
from ..base.translation import say
from ..base.watched_job import CANCELLED, WatchedJob
from ..settings.properties import SamplingProperties, draw_sampling, prop
from .selected_sources import Source, obstacle, sources

KEPT = "Cancelled, the draft stays"  # one row


class FromSelection:
    """An operator that computes from the selection; where it cannot, its poll message is the reason."""

    @classmethod
    def poll(cls, context):
        reason = obstacle(context)
        if reason:
            cls.poll_message_set(told(reason))
        return not reason


class Alone:
    """An operator that hides what its product takes the place of; a button does so when the product is new."""

    alone: bpy.props.BoolProperty(
        name="Alone",
        description="Hide what fills the same place, and select what was made",
        default=False,
        options={"SKIP_SAVE"},
    )


@dataclass(frozen=True)
class Read:
    """A shape, and what else was read of its object for `work`; the base of what operators add."""

    shape: Shape

    @property
    def frame(self):
        return self.shape.frame


class ComputeOperator(FromSelection, WatchedJob):
    """An operator that computes one object of each source; the base of those that are registered.

    A subclass names its `product` and has three steps: `check_writable(thing)` raises MedialAxisError when the
    product of a source cannot be written now; `work(shape)` gives the function that a task calls with
    its progress; `write(thing, value, frame)` makes an object of the value that this function returned, or returns
    None when there is nothing to make. A subclass that does not compute from a shape has its own `read`; one that
    computes parts of a shape by themselves has its own `divided`, and `write_part` for these.
    An operator may have `draft(shape, thing)`, which returns quick work whose product is shown, in a window, until the
    exact one takes its place.
    `summary(value)` and `value.warnings` are for people.

    In a script the result is selected afterwards, as with Blender's own operators. In a window the source stays
    selected, because the outline of a selected result hides the result.
    """

    bl_options = {"REGISTER", "UNDO"}

    product = ""
    alone = False  # a property, where the product fills the place of what it is made of

    select_result: bpy.props.BoolProperty(
        name="Select Result",
        description="Select what was made and nothing else; off: the selection stays as it is",
        default=True,
        options={"SKIP_SAVE"},
    )

    def execute(self, context):
        found, tasks = self._read(context)
        return self._write(context, found, [run_task(task) for task in tasks])

    def invoke(self, context, _event):
        if bpy.app.background or context.window is None:
            return self.execute(context)
        if not self.properties.is_property_set("select_result"):
            self.select_result = False
        if isinstance(self, Alone) and not self.properties.is_property_set("alone"):
            self.alone = True
        self._sources, tasks = self._read(context)
        if not tasks:
            return {"CANCELLED"}
        self._gone, self._kept = "", ""
        self._awaited = [s for s, task in zip(self._sources, tasks, strict=True) if task.draft]
        return self.watch(context, tasks, self.product)

    def meanwhile(self):
        if self._awaited and (drafts := self._job.drafts):
            for source, outcome in zip(self._awaited, drafts, strict=True):
                self._show_draft(source, outcome)
            self._awaited = []
        for source in self._sources:
            if source.find() is None and not self._gone:
                self._gone = (
                    f"'{source.name}' was deleted while its {self.product} was computed; "
                    "nothing was changed"
                )
                self._job.cancel()

    def ended(self, context):
        try:
            return self._write(context, self._sources, self._job.outcomes())
        except Cancelled:
            self._tell(context, "WARNING", self._gone or self._kept or CANCELLED)
            return {"FINISHED"} if self._kept else {"CANCELLED"}

    def sources(self, context):
        """The objects to compute from."""
        return sources(context)

    def read(self, thing, depsgraph):
        """The argument of `work`; it has the `frame` that `write` gets."""
        return read_object(thing, depsgraph)

    def divided(self, shape):
        """The shapes to compute, by the names of the parts, and warnings; the whole shape has no name."""
        return {"": shape}, ()

    def draft(self, _thing, _shape):
        """Quick work whose product people see until the exact one takes its place; None where there is none."""
        return None

    def _show_draft(self, source, outcome):
        """Write a draft; what is wrong with it, the exact computation tells."""
        thing = source.find()
        if outcome.error is not None or thing is None:
            return
        try:
            made = self.write_draft(thing, outcome.value, source.frame)
        except MedialAxisError:
            return
        if made is not None:
            follow(made, thing, source.world, self.parent)
            remember_state(made, source.state)
            self._kept = KEPT
            current_job.settle()

    def settle(self, made):
        """Called when all is written, with the objects that were made or updated."""

    def _tell(self, context, kind, text):
        """Report, and keep what went wrong in the panel: Blender's message fades in seconds."""
        self.report({kind}, told(text))
        if kind != "INFO":
            panel = context.scene.medial_axis
            panel.note = f"{panel.note}\n{text}".strip()

    def _read(self, context):
        """The sources that can be read, and what to compute of them; the others are reported."""
        context.scene.medial_axis.note = ""
        things = self.sources(context)
        with seen(things):
            return self._read_seen(context, things)

    def _read_seen(self, context, things):
        found, tasks = [], []
        depsgraph = context.evaluated_depsgraph_get()
        for thing in things:
            try:
                self.check_writable(thing)
                shape = self.read(thing, depsgraph)
                parts, warnings = self.divided(shape)
            except MedialAxisError as error:
                self._tell(context, "ERROR", f"'{thing.name}': {error}")
                continue
            world = thing.evaluated_get(depsgraph).matrix_world.copy()
            uid = getattr(thing, "session_uid", None)
            state = state_of(thing, depsgraph)
            for warning in warnings:
                self._tell(context, "WARNING", f"'{thing.name}': {warning}")
            for name, part in parts.items():
                draft = None if name else self.draft(thing, part)
                tasks.append(Task(f"{thing.name} {name}".rstrip(), self.work(part), draft))
                found.append(Source(thing.name, uid, shape.frame, world, state, name))
        return found, tasks

    def _write(self, context, found, outcomes):
        made, failed = [], {}
        for source, outcome in zip(found, outcomes, strict=True):
            try:
                made.append(self._write_one(context, source, outcome))
            except MedialAxisError as error:
                failed.setdefault(source.name, []).append((source.part, error))
        for name, errors in failed.items():
            self._tell(context, "ERROR", f"'{name}': {_sentence(errors)}")
        made = [thing for thing in made if thing is not None]
        self.settle(made)
        if self.select_result or self.alone:
            select_made(context, made)
        current_job.settle()
        return {"FINISHED"} if made else {"CANCELLED"}

    def _write_one(self, context, source, outcome):
        if outcome.error is not None:
            raise outcome.error
        thing = source.find()
        if thing is None:
            self._tell(
                context, "WARNING", f"'{source.name}' is gone; its {self.product} was dropped"
            )
            return None
        start, before = time.perf_counter(), set(bpy.data.objects)
        write = partial(self.write_part, source.part) if source.part else self.write
        made = write(thing, outcome.value, source.frame)
        if made is not None and made != thing:
            follow(made, thing, source.world, self.parent)
        if made is not None:
            remember_state(made, source.state)
        if self.alone and made is not None and made not in before and thing.visible_get():
            thing.hide_set(True)
        seconds = outcome.value.seconds + time.perf_counter() - start
        for warning in outcome.value.warnings:
            text = f"'{source.name}': {warning}"
            if made is None:
                self._tell(context, "WARNING", text)
            else:  # the panel shows them with the result
                short = f"'{source.name}': {warned(warning)}"
                self.report({"WARNING"}, say(text if bpy.app.background else short))
        if made is not None:
            self._tell(context, "INFO", f"Done: {self.summary(outcome.value)}, {seconds:.1f} s")
        return made


def _sentence(errors):
    """The error of a source, or of its parts together."""
    part, error = errors[0]
    return f"{len(errors):,} parts have no result: {error}" if part else str(error)


class SampledOperator(ComputeOperator, SamplingProperties):
    """An operator that samples faces; it names its own options in `shown`, and those of sampling come after them."""

    shown = ()

    sides: prop(OPTIONS["sides"])

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in filter(self.acts, self.shown):
            self.layout.prop(self, name)
        box = self.layout.box().column()
        for name in ("sides", "sampling"):
            box.prop(self, name)
        draw_sampling(box, self, self.of_faces())

    def acts(self, _name):
        """Whether an option matters with the others as they are; else it is not drawn."""
        return True

    def of_faces(self):
        """The options of sampling that matter for Vertices, too."""
        return ()
