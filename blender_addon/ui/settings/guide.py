# SPDX-License-Identifier: GPL-3.0-or-later
"""The guided start: one line in the panel until the first success, and an entry in the Help menu."""

import bpy

from ...core.axis.verdict import Light
from ..base import manual
from .preferences import ADDON

PAGE = "tutorial.html"
# These places of the manual explain the traffic lights.
WHY = {
    Light.GOOD.name: "user_guide.html#sampling",
    Light.LOOK.name: "troubleshooting.html",
    Light.WRONG.name: "troubleshooting.html",
}


def draw_guide(layout):
    """The line for those who are new here; returns whether there is one."""
    if not _wanted():
        return False
    row = layout.row(align=True)
    row.operator("wm.medial_axis_tutorial", text="New here? Ten pictures", icon="HELP")
    row.operator("wm.medial_axis_tutorial", text="", icon="X").dismiss = True
    return True


def end_guide(context):
    """Whoever has opened or dismissed the line, or computed an axis, is no longer new here."""
    addon = context.preferences.addons.get(ADDON)
    if addon is not None and not addon.preferences.guided:
        addon.preferences.guided = True


def _wanted():
    addon = bpy.context.preferences.addons.get(ADDON)
    return addon is not None and not addon.preferences.guided and manual.has(PAGE)


class WM_OT_medial_axis_tutorial(bpy.types.Operator):
    bl_idname = "wm.medial_axis_tutorial"
    bl_label = "Medial Axis Tutorial"
    bl_options = {"INTERNAL"}

    dismiss: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})

    @classmethod
    def description(cls, _context, properties):
        if properties.dismiss:
            return bpy.app.translations.pgettext_tip("Hide this line")
        return bpy.app.translations.pgettext_tip(
            "Open the first steps in ten pictures, in the manual that comes with the add-on"
        )

    @classmethod
    def poll(cls, _context):
        return manual.has(PAGE)

    def execute(self, context):
        end_guide(context)
        if not self.dismiss:
            bpy.ops.wm.url_open(url=manual.address(PAGE))
        return {"FINISHED"}


class WM_OT_medial_axis_why(bpy.types.Operator):
    bl_idname = "wm.medial_axis_why"
    bl_label = "Why?"
    bl_description = "What the manual says about this"
    bl_options = {"INTERNAL"}

    light: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, _context):
        bpy.ops.wm.url_open(url=manual.address(WHY[self.light]))
        return {"FINISHED"}


def _help(self, _context):
    self.layout.separator()
    self.layout.operator("wm.medial_axis_tutorial", icon="HELP")


ENTRIES = {bpy.types.TOPBAR_MT_help: _help}
