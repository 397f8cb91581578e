# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of skeletons and armatures."""

import bpy

from ...bridge.mesh import stored
from ...bridge.skeleton.armature_object import armature_of, is_armature
from ...bridge.skeleton.skeleton_object import is_skeleton, skeleton_of
from ..base.plain_words import draw_told, warned
from ..base.tab import Closed, draw_setting, draws_buttons, settings_column
from ..base.wrapped_text import counted, draw_wrapped
from .skeleton_operators import SKELETON_OPERATORS, copy_all


class VIEW3D_PT_medial_axis_skeleton(Closed, bpy.types.Panel):
    bl_label = "Rig"

    def draw(self, context):
        column = settings_column(self.layout)
        # The others are in the panels of the operators.
        for name in ("detail", "per_limb", "fill", "bind"):
            draw_setting(column, context.scene.medial_axis_skeleton, name)
        if draws_buttons(self.layout, len(SKELETON_OPERATORS)):
            for operator, icon in SKELETON_OPERATORS.items():
                copy_all(context, self.layout.operator(operator, icon=icon))
        things = _shown(context)
        for thing in things:
            names = {"bones": stored.BONES}
            if is_skeleton(thing):
                names = {"ends": stored.ENDS, "branches": stored.BRANCHES, "loops": stored.LOOPS}
            text = counted({word: thing.get(name, 0) for word, name in names.items()})
            draw_wrapped(context, self.layout, text, f"OUTLINER_OB_{thing.type}")
        warnings = (
            line for thing in things for line in thing.get(stored.WARNINGS, "").splitlines()
        )
        for warning in dict.fromkeys(warnings):
            draw_told(context, self.layout, warning, "ERROR", warned)


def _shown(context):
    """The skeleton and the armature that the panel describes: the active object, or those made of it."""
    active = getattr(context, "object", None)
    if active is None:
        return []
    if is_skeleton(active) or is_armature(active):
        return [active]
    return [found for found in (skeleton_of(active), armature_of(active)) if found is not None]
