# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes or skeletons of an animated object over a range of frames, and their playback."""

import time
from dataclasses import replace
from functools import partial
from pathlib import Path

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ...bridge.objects import read_scene
from ...bridge.skeleton.sequence_objects import AXES, SKELETONS, sequences, write_sequence
from ...core.batch.batch import Item, begin, finish
from ...core.batch.frames import output_path, parse_frames
from ...core.errors import Cancelled, InvalidInputError, MedialAxisError
from ...core.machine.job import run_task
from ...core.products.axis import Axis
from ...core.products.skeleton import Skeletons
from ...core.settings import SamplingMode, SkeletonSettings
from ..base import current_job
from ..base.paths import chosen_files
from ..base.plain_words import Telling, told
from ..base.tab import InSettings
from ..base.translation import IN_CONTEXT, say
from ..settings.preferences import memory_limit
from ..settings.properties import settings_from
from .compute_operator import FromSelection
from .selected_sources import has_faces, sources

_PRODUCTS = {"AXES": "medial axis", "SKELETONS": "skeleton"}
_AT_ONCE = 0.1  # seconds for which finished frames are passed over before Blender may draw again


def _of():
    return EnumProperty(
        name="Of",
        description="What is computed at every frame",
        items=(
            ("AXES", "Medial Axes", "Those of the settings above, as .npz"),
            (
                "SKELETONS",
                "Skeletons",
                "Those of the panel Rig, as .json; bones are not tracked",
            ),
        ),
        default="AXES",
        **IN_CONTEXT,
    )


class OBJECT_OT_medial_axis_sequence(FromSelection, bpy.types.Operator):
    bl_idname = "object.medial_axis_sequence"
    bl_label = "Compute Sequence"
    bl_description = (
        "Compute the medial axis or the skeleton of the selected objects at every frame, with the settings "
        "of the panels, into a file each; files that are finished are kept"
    )
    bl_options = {"REGISTER", "UNDO"}

    of: _of()
    directory: StringProperty(
        name="Folder", description="Where the files are written", subtype="DIR_PATH"
    )
    frames: StringProperty(
        name="Frames", description="Such as 1-250, 1-250:10 or 1,5,9-12; empty: those of the scene"
    )
    playback: BoolProperty(
        name="Playback",
        description="Also make objects of the files, of which each frame shows its own",
        default=True,
    )
    fast: BoolProperty(
        name="Draft",
        description="Sample faces once, where Sampling is Automatic: no look at the vertices, no second "
        "pass for thin parts; and no exact places",
    )

    def execute(self, context):
        if not self._start(context):
            return {"CANCELLED"}
        while self._items:
            if begun := self._begin():
                self._finish(begun, run_task(begun.task))
        return self._end(context)

    def invoke(self, context, _event):
        if bpy.app.background or context.window is None:
            return self.execute(context)
        if not self._start(context):
            return {"CANCELLED"}
        self._begun = self._job = None
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._stop(context)
            self.report({"WARNING"}, say("The sequence was cancelled; finished frames are kept"))
            return self._end(context)
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if self._job is not None:
            if not self._job.done:
                current_job.show(context)
                return {"PASS_THROUGH"}
            self._take()
        self._next(context)
        if self._job is not None or self._items:
            return {"PASS_THROUGH"}
        self._stop(context)
        return self._end(context)

    def cancel(self, context):
        """Blender ends the operator: its window closes, a file is loaded, Blender quits."""
        self._stop(context)

    def _start(self, context):
        """Prepares the work, frame by frame; returns False when it cannot be done, which was reported."""
        try:
            self._work = {thing.name: self._work_of(context, thing) for thing in sources(context)}
            self._limit = memory_limit()
            suffix = SKELETONS if self.of == "SKELETONS" else AXES
            pattern = _folder(self.directory) / f"{{name}}_####{suffix}"
            self._items = list(_items(sources(context), self._frames(context.scene), str(pattern)))
        except (MedialAxisError, ValueError) as error:
            self.report({"ERROR"}, told(error))
            return False
        self._count, self._shown = len(self._items), context.scene.frame_current
        # Values that were changed without a key are of no frame.
        context.scene.frame_set(self._shown)
        self._done, self._failed, self._kept = {}, 0, 0
        return True

    def _work_of(self, context, thing):
        settings = settings_from(context.scene.medial_axis)
        settings = _faster(settings) if self.fast and has_faces(thing) else settings
        if self.of == "AXES":
            return Axis(settings)
        return Skeletons(
            settings, settings_from(context.scene.medial_axis_skeleton, SkeletonSettings)
        )

    def _frames(self, scene):
        whole = f"{scene.frame_start}-{scene.frame_end}:{scene.frame_step}"
        return parse_frames(self.frames or whole)

    def _begin(self):
        """The next item, read; None when there is nothing to compute of it."""
        item = self._items.pop(0)
        try:
            begun = begin(item, self._work[item.object], limit=self._limit)
        except MedialAxisError as error:
            self._fail(item, error)
            return None
        if begun.kept is None:
            return begun
        self._kept += 1
        self._remember(item)
        return None

    def _finish(self, begun, outcome):
        try:
            finish(begun, outcome)
        except MedialAxisError as error:
            self._fail(begun.item, error)
        else:
            self._remember(begun.item)

    def _fail(self, item, error):
        self._failed += 1
        self.report({"WARNING"}, told(f"'{item.name}': {error}"))

    def _remember(self, item):
        self._done.setdefault(item.object, {})[item.frame] = item.output

    def _next(self, context):
        """Start to compute the next frame that is not finished, if one is found in a moment."""
        until = time.perf_counter() + _AT_ONCE
        self._begun = self._job = None
        while self._items:
            if begun := self._begin():
                self._begun = begun
                self._job = current_job.start([begun.task], _PRODUCTS[self.of])
                current_job.show(context)
                return
            if time.perf_counter() > until:
                return

    def _take(self):
        """The outcome of the thread; Cancel in the sidebar cancels all frames."""
        current_job.finish(self._job)
        try:
            self._finish(self._begun, self._job.outcomes()[0])
        except Cancelled:
            self._items.clear()
            self.report({"WARNING"}, say("The sequence was cancelled; finished frames are kept"))

    def _stop(self, context):
        if self._job is not None:
            self._job.stop()
            current_job.finish(self._job)
        self._items.clear()
        self._job = None
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None

    def _end(self, context):
        """Playback, and the frame that was shown before."""
        context.scene.frame_set(self._shown)
        written = sum(map(len, self._done.values()))
        for name, files in self._done.items() if self.playback else ():
            try:
                write_sequence(name, dict(sorted(files.items())))
            except MedialAxisError as error:
                self.report({"ERROR"}, told(error))
                return {"CANCELLED"}
        if not written:
            self.report({"ERROR"}, told(f"Expected results of {self._count} frames, found none"))
            return {"CANCELLED"}
        text = f"{written} of {self._count} frames are there, {self._kept} were before"
        self.report({"WARNING"} if self._failed else {"INFO"}, say(text))
        return {"FINISHED"}


def _faster(settings):
    """The same without exact places, and with one pass of samples where that is not already chosen otherwise."""
    automatic = settings.sampling is SamplingMode.AUTOMATIC
    sampling = SamplingMode.SURFACE if automatic else settings.sampling
    return replace(settings, sampling=sampling, crisp=False)


def _items(things, frames, pattern):
    for frame in frames:
        for thing in things:
            output = output_path(pattern, thing.name, "", frame)
            read = partial(read_scene.read, thing.name, frame)
            yield Item(read_scene.open_file(), thing.name, frame, output, read)


def _folder(directory):
    if directory.startswith("//") and not bpy.data.filepath:
        raise InvalidInputError(
            "Expected a saved file for a folder that begins with //, found one that was never "
            "saved; save it or choose another folder"
        )
    return Path(bpy.path.abspath(directory or "//medial_axis"))


class IMPORT_SCENE_OT_medial_axis_sequence(Telling, bpy.types.Operator, ImportHelper):
    bl_idname = "import_scene.medial_axis_sequence"
    bl_label = "Import Medial Axis Sequence"
    bl_description = (
        "Make objects of .npz files of axes or .json files of skeletons, one per frame, of which each "
        "frame shows its own"
    )
    bl_options = {"UNDO"}

    filename_ext = ".npz"
    filter_glob: StringProperty(default="*.npz;*.json", options={"HIDDEN"})
    files: CollectionProperty(
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})

    def run(self, _context):
        for name, files in sequences(map(Path, chosen_files(self))):
            collection = write_sequence(name, files)
            self.report({"INFO"}, say(f"'{collection.name}': {len(files)} frames"))


def copy_sequence(scene, button):
    """Set the properties of an operator button to those of the panel."""
    button.directory, button.fast = scene.medial_axis_folder, scene.medial_axis_fast
    button.of = scene.medial_axis_sequence_of


class VIEW3D_PT_medial_axis_sequence(InSettings, bpy.types.Panel):
    """Frames of an animation"""

    bl_label = "Sequence"
    bl_idname = "VIEW3D_PT_medial_axis_sequence"

    def draw(self, context):
        scene = context.scene
        column = self.layout.column()
        column.prop(scene, "medial_axis_sequence_of", text="")
        column.prop(scene, "medial_axis_folder")
        column.prop(scene, "medial_axis_fast")
        copy_sequence(
            scene, column.operator("object.medial_axis_sequence", icon="RENDER_ANIMATION")
        )


def menu_func_import(self, _context):
    self.layout.operator(
        IMPORT_SCENE_OT_medial_axis_sequence.bl_idname, text="Medial Axis Sequence (.npz)"
    )


PROPERTIES = {
    (bpy.types.Scene, "medial_axis_folder"): StringProperty(
        name="Folder",
        description="Where the files of a sequence are written; // is the folder of the open file",
        subtype="DIR_PATH",
        default="//medial_axis/",
    ),
    (bpy.types.Scene, "medial_axis_sequence_of"): _of(),
    (bpy.types.Scene, "medial_axis_fast"): BoolProperty(
        name="Draft",
        description="Sample faces once at every frame, without exact places: quicker, and coarser at thin parts "
        "and edges",
    ),
}
ENTRIES = {bpy.types.TOPBAR_MT_file_import: menu_func_import}
