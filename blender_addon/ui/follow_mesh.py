# SPDX-License-Identifier: GPL-3.0-or-later
"""Follow Mesh: the bones of an object follow it through the frames of the scene, as keys."""

import time

import bpy
from bpy.props import BoolProperty, StringProperty

from ..bridge.armature_object import rig_of
from ..bridge.follow_mesh import MeshFollower
from ..core.batch.frames import parse_frames
from ..core.errors import MedialAxisError
from . import current_job
from .selected_sources import obstacle, sources
from .translation import say
from .watched_job import CANCELLED

FOLLOW = {"object.medial_axis_follow": "ACTION"}
_AT_ONCE = 0.1  # seconds of work before Blender may draw again
_FAR = 0.02  # a share of the diagonal: the message is a warning where the mesh is farther off

NOT_TWICE = (
    "The modifier that binds it to its bones is off now, because it moves by itself; turn that on and its own motion "
    "off where the bones shall move it"
)


class OBJECT_OT_medial_axis_follow(bpy.types.Operator):
    bl_idname = "object.medial_axis_follow"
    bl_label = "Follow Mesh"
    bl_description = (
        "Key the bones of the selected objects so that they follow the mesh through the frames"
    )
    bl_options = {"REGISTER", "UNDO"}

    frames: StringProperty(
        name="Frames", description="Such as 1-250, 1-250:10 or 1,5,9-12; empty: those of the scene"
    )
    stretch: BoolProperty(
        name="Stretch",
        description="Bones also change their lengths and thicknesses, and do not inherit those of their parents",
        default=False,
    )

    @classmethod
    def poll(cls, context):
        reason = obstacle(context) or _lacks_bones(context)
        if reason:
            cls.poll_message_set(say(reason))
        return not reason

    def execute(self, context):
        if not self._start(context):
            return {"CANCELLED"}
        for _ in self._steps:
            pass
        return self._end()

    def invoke(self, context, _event):
        if bpy.app.background or context.window is None:
            return self.execute(context)
        if not self._start(context):
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Keep all events, so that nothing else changes the scene meanwhile."""
        if event.type == "ESC" and event.value == "PRESS":
            self.cancel(context)
            self.report({"WARNING"}, say(CANCELLED))
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        until = time.perf_counter() + _AT_ONCE
        for text in self._steps:
            if time.perf_counter() > until:
                context.workspace.status_text_set(f"{text}    {say('Esc: Cancel')}")
                return {"RUNNING_MODAL"}
        self._stop_watching(context)
        return self._end()

    def cancel(self, context):
        """Blender ends the operator, or Esc does: no key was made."""
        self._steps.close()
        self._stop_watching(context)

    def _start(self, context):
        """Look at what is to be done; returns False when it cannot be, which was reported."""
        scene = context.scene
        try:
            whole = f"{scene.frame_start}-{scene.frame_end}:{scene.frame_step}"
            frames = parse_frames(self.frames or whole)
        except ValueError as error:
            self.report({"ERROR"}, say(error))
            return False
        self._followed, self._count = [], len(frames)
        self._steps = self._follow([thing.name for thing in sources(context)], frames)
        return True

    def _follow(self, names, frames):
        """Fit all frames of all sources; yields what is done after each frame, in words."""
        for name in names:
            try:
                follower = MeshFollower(bpy.data.objects[name], self.stretch)
                try:
                    for number, frame in enumerate(frames, 1):
                        follower.add(frame)
                        yield f"{say(self.bl_label)}: {name}, {number} / {len(frames)}"
                    follower.check_motion()
                finally:
                    follower.close()
            except MedialAxisError as error:
                self.report({"ERROR"}, say(f"'{name}': {error}"))
            else:
                self._followed.append(follower)

    def _stop_watching(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)

    def _end(self):
        """Key the bones of all sources that were followed to the end."""
        for follower in self._followed:
            follower.bake()
            self._tell(follower)
        current_job.settle()
        return {"FINISHED"} if self._followed else {"CANCELLED"}

    def _tell(self, follower):
        frame, off = follower.found.worst
        text = (
            f"'{follower.source.name}': {follower.count} bones follow it in {self._count} frames; the mesh is "
            f"{100 * off:.2g} % of its size off at frame {frame}, and nearer at others"
        )
        self.report({"WARNING"} if off > _FAR else {"INFO"}, say(text))
        if follower.was_bound:
            self.report({"INFO"}, say(NOT_TWICE))
        for warning in follower.warnings:
            self.report({"WARNING"}, say(f"'{follower.source.name}': {warning}"))


def _lacks_bones(context):
    """Why no selected object has bones that could follow it, in one sentence, or an empty string."""
    things = sources(context)
    if any(rig_of(thing) is not None for thing in things):
        return ""
    return f"'{things[0].name}' has no bones yet; press Make Armature"


CLASSES = (OBJECT_OT_medial_axis_follow,)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
