# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab of the 3D viewport: its panels, in the order of work."""

import bpy

from ...bridge.mesh import stored
from ...core.machine import native
from ...core.settings import Side
from ..axis.auto_update import draw_auto_update
from ..axis.figures import (
    draw_details,
    draw_report,
    draw_report_details,
    draw_result,
    draw_sequence,
    draw_surface,
)
from ..axis.parts import draw_parts
from ..axis.selected_sources import has_faces, obstacle, sources
from ..base import current_job
from ..base.plain_words import doing, draw_told
from ..base.show import draw_colours, shows_colours
from ..base.tab import MAIN, RESULT, InResult, Inside, Tab, draws_buttons, settings_column
from ..settings.guide import draw_guide
from ..settings.presets import VIEW3D_PT_medial_axis_presets
from ..settings.properties import (
    copy_settings,
    note_of,
    shown_frame,
    shown_report,
    shown_result,
    shown_surface,
    shown_thing,
)
from .form_panel import draw_form

_drawn = {}  # a sidebar -> what its panels were drawn for
_BINDS = 0.5  # a condition that keeps a larger share of the facets alone is why the other one does little


class VIEW3D_PT_medial_axis(Tab, bpy.types.Panel):
    """The button, progress, and the settings that matter most"""

    bl_label = "Medial Axis"
    bl_idname = MAIN

    def draw_header_preset(self, _context):
        VIEW3D_PT_medial_axis_presets.draw_panel_header(self.layout)

    def draw(self, context):
        layout = self.layout
        _settle_when_changed(context)
        if problem := native.problem():
            draw_told(context, layout.box(), problem, "ERROR")
        _draw_compute(context, layout)
        _draw_status(context, layout)
        _draw_settings(context, layout)


class VIEW3D_PT_medial_axis_result(Inside, bpy.types.Panel):
    """The most important figures of the result or of a reconstructed surface, and files"""

    bl_label = "Result"
    bl_idname = RESULT

    @classmethod
    def poll(cls, context):
        return (shown_thing(context) or shown_surface(context)) is not None

    def draw_header_preset(self, context):
        if result := shown_result(context):
            draw_auto_update(self.layout, result)

    def draw(self, context):
        layout = self.layout
        result, report, frame = shown_result(context), shown_report(context), shown_frame(context)
        if shown_thing(context):
            draw_colours(context, layout)
        if frame is not None:
            draw_sequence(context, layout, frame)
        if result is not None:
            draw_result(context, layout, result)
        if report is not None:
            draw_report(context, layout, report)
        if surface := shown_surface(context):
            draw_surface(context, layout, surface)
        if result is not None:
            layout.operator("export_scene.medial_axis", icon="EXPORT")


class VIEW3D_PT_medial_axis_details(InResult, bpy.types.Panel):
    """All other figures, and every sentence"""

    bl_label = "Details"
    bl_idname = "VIEW3D_PT_medial_axis_details"

    @classmethod
    def poll(cls, context):
        return shown_result(context) is not None or shown_report(context) is not None

    def draw(self, context):
        if result := shown_result(context):
            draw_details(context, self.layout, result)
            draw_parts(context, self.layout)
        if report := shown_report(context):
            draw_report_details(context, self.layout, report)


def _settle_when_changed(context):
    """Have the sidebar drawn again where the panels will be taller or shorter than they were: Blender leaves those
    below where they were at first, over what has grown."""
    active, space = context.object, context.space_data
    now = (
        active and active.name,
        obstacle(context),
        *note_of(context),
        current_job.job() is None,
        space is not None and shows_colours(space),
    )
    sidebar = context.region.as_pointer()
    if _drawn.get(sidebar) != now:
        _drawn[sidebar] = now
        current_job.settle()


def _draw_settings(context, layout):
    settings, column = context.scene.medial_axis, settings_column(layout)
    draw_form(context, column, settings)
    result = shown_result(context)
    split = column.split(factor=0.4)  # as Blender divides the other rows
    label = split.row()
    label.alignment = "RIGHT"
    label.label(text="Theta, Rho")
    both = split.row(align=True)
    both.use_property_split = False
    for name, does_little in _thresholds(result).items():
        cell = both.row(align=True)
        cell.active = not does_little
        cell.prop(settings, name, text="", slider=True)
    column.prop(settings, "side")
    if Side[settings.side] in (Side.OUTER, Side.BOTH):
        column.prop(settings, "within")


def _thresholds(result):
    """The two thresholds, and whether each does little for a result: the other one keeps what it drops."""
    only = {"theta": stored.ONLY_RATIO, "rho": stored.ONLY_ANGLE}
    return {
        name: result is not None and result.get(key, 0.0) > _BINDS for name, key in only.items()
    }


def _draw_compute(context, layout):
    job = current_job.job()
    if job is not None:
        _draw_progress(context, layout, job)
        return
    row = layout.row()
    row.scale_y = 1.5
    copy_settings(
        context.scene.medial_axis,
        row.operator("object.medial_axis", icon="OUTLINER_DATA_MESH"),
    )


def _draw_status(context, layout):
    """A row that is always there, so that nothing below it moves: an obstacle, a note, or whose axis is computed."""
    job = current_job.job()
    if not all(map(has_faces, sources(context))) and draws_buttons(layout):
        button = layout.operator("object.tight_cocone_surface", icon="MESH_ICOSPHERE")
        copy_settings(context.scene.medial_axis, button)
    reason = "" if job is not None else obstacle(context)
    told = [reason] if reason and reason != native.problem() else []
    told += note_of(context)
    for sentence in told:
        draw_told(context, layout, sentence, "INFO")
    if not told and (job is not None or not draw_guide(layout)):
        names = job.name if job is not None else ", ".join(thing.name for thing in sources(context))
        layout.label(text=names, icon="OBJECT_DATA", translate=False)


def _draw_progress(context, layout, job):
    whole = layout.row(align=True)
    whole.scale_y = 1.5  # as the button that is here otherwise, so that nothing below moves
    if bpy.app.version >= (5, 0):  # after such a bar, 4.3 draws the next label as a full one
        whole.progress(factor=job.fraction, text=f"{doing(job.stage)}, {100 * job.fraction:.0f} %")
    else:
        row = whole.row(align=True)
        row.enabled = False
        bar = context.window_manager.medial_axis_progress
        row.prop(bar, "percentage", text=doing(job.stage), slider=True)
    whole.operator("object.medial_axis_cancel", text="", icon="CANCEL")
