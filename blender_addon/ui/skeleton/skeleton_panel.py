# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of skeletons and armatures."""

import bpy

from ...bridge.mesh import stored
from ...bridge.skeleton.armature_object import armature_of, is_armature
from ...bridge.skeleton.skeleton_object import is_skeleton, skeleton_of
from ..base.plain_words import draw_told, warned
from ..base.tab import Closed, draw_setting, draws_buttons, settings_column
from ..base.wrapped_text import draw_figures
from .skeleton_operators import SKELETON_OPERATORS, copy_all


class VIEW3D_PT_medial_axis_skeleton(Closed, bpy.types.Panel):
    bl_label = "Rig"

    def draw(self, context):
        column = settings_column(self.layout)
        # The others are in the panels of the operators.
        for name in ("detail", "per_limb", "mirror", "fill", "bind"):
            draw_setting(column, context.scene.medial_axis_skeleton, name)
        converts = bpy.ops.object.medial_axis_to_curve.poll()
        if draws_buttons(self.layout, len(SKELETON_OPERATORS) + converts):
            for operator, icon in SKELETON_OPERATORS.items():
                copy_all(context, self.layout.operator(operator, icon=icon))
            if converts:
                self.layout.operator("object.medial_axis_to_curve", icon="OUTLINER_OB_CURVE")
        for thing in _shown(context):
            _draw_figures(context, self.layout.column(), thing)


def _shown(context):
    """The skeleton and the armature that the panel describes: the active object, or those made of it."""
    active = getattr(context, "object", None)
    if active is None:
        return []
    if is_skeleton(active) or is_armature(active):
        return [active]
    return [found for found in (skeleton_of(active), armature_of(active)) if found is not None]


def _draw_figures(context, layout, thing):
    figures = {"Bones": thing.get(stored.BONES, 0)}
    if is_skeleton(thing):
        names = {"Ends": stored.ENDS, "Branches": stored.BRANCHES, "Loops": stored.LOOPS}
        figures = {label: thing.get(name, 0) for label, name in names.items()}
    layout.label(text=thing.name, icon="DOT", translate=False)
    draw_figures(layout, {label: f"{number:,}" for label, number in figures.items()})
    for warning in thing.get(stored.WARNINGS, "").splitlines():
        draw_told(context, layout, warning, "ERROR", warned)
