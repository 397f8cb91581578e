# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab of the 3D viewport: its panels, in the order of work."""

import bpy

from ..bridge import axis_object, output_object, sequence_objects
from ..bridge.wires import width_of, wires_of
from ..core.machine import native
from ..core.settings import Form, Side, SidesFrom
from . import current_job
from .auto_update import draw_auto_update
from .figures import (
    draw_details,
    draw_report,
    draw_report_details,
    draw_result,
    draw_sequence,
    draw_surface,
)
from .form_panel import draw_form, draw_more_of_form
from .guide import draw_guide
from .presets import VIEW3D_PT_medial_axis_presets
from .properties import (
    copy_settings,
    draw_sampling,
    settings_from,
    shown_report,
    shown_result,
    shown_surface,
)
from .selected_sources import has_faces, obstacle, sources
from .show import shows_colours
from .tab import MAIN, Closed, Inside, Tab, settings_column
from .translation import say
from .wrapped_text import draw_wrapped

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
            draw_wrapped(context, layout.box(), problem, "ERROR")
        _draw_compute(context, layout)
        for note in context.scene.medial_axis.note.splitlines():
            draw_wrapped(context, layout, note, "INFO")
        draw_guide(layout)
        _draw_settings(context, layout)


class VIEW3D_PT_medial_axis_sampling(Closed, bpy.types.Panel):
    """How faces are sampled, and the report"""

    bl_label = (
        ""  # the header shows it before the choice, which is visible also while the panel is closed
    )
    bl_idname = "VIEW3D_PT_medial_axis_sampling"

    def draw_header(self, context):
        self.layout.label(text="Sampling")
        choice = self.layout.row()
        choice.ui_units_x = 4.5
        choice.prop(context.scene.medial_axis, "sampling", text="")

    def draw(self, context):
        settings = context.scene.medial_axis
        of_faces = settings_from(settings).options_of_faces
        draw_sampling(settings_column(self.layout), settings, of_faces)
        if current_job.job() is None:  # Blender keeps a button grey that was so below the mouse
            button = self.layout.operator("object.medial_axis_sampling_report", icon="VIEWZOOM")
            copy_settings(settings, button)


class VIEW3D_PT_medial_axis_method(Closed, bpy.types.Panel):
    """Choices that the published method leaves open"""

    bl_label = "Method"
    bl_idname = "VIEW3D_PT_medial_axis_method"

    def draw(self, context):
        settings, column = context.scene.medial_axis, settings_column(self.layout)
        draw_more_of_form(context, column, settings)
        for name in ("rule", "criteria", "limit_set", "sides"):
            column.prop(settings, name)
        if settings.sides == SidesFrom.WRAP.name:
            column.prop(settings, "wrap_opening")
        column.prop(settings, "each_part")


class VIEW3D_PT_medial_axis_show(Closed, bpy.types.Panel):
    """How the result is seen"""

    bl_label = "Show"
    bl_idname = "VIEW3D_PT_medial_axis_show"

    @classmethod
    def poll(cls, context):
        return _shown(context) is not None

    def draw(self, context):
        thing, settings = _shown(context), context.scene.medial_axis
        _draw_colours(context, self.layout)
        column = settings_column(self.layout)
        column.prop(thing, "show_in_front", text="In Front")
        if output_object.source_of(thing) is not None:
            _draw_source(column, thing)
        column.prop(settings, "parent")
        if Form[settings.form] is Form.PUBLISHED:
            column.prop(settings, "smallest_island", slider=True)
        else:
            column.prop(settings, "crumbs", slider=True)
        modifier = wires_of(thing)
        if modifier is not None and (width := width_of(modifier)):
            column.prop(*width, text="Wire Width")


class VIEW3D_PT_medial_axis_result(Inside, bpy.types.Panel):
    """The most important figures of the result, and files"""

    bl_label = "Result"
    bl_idname = "VIEW3D_PT_medial_axis_result"

    @classmethod
    def poll(cls, context):
        return _shown(context) is not None

    def draw_header_preset(self, context):
        if result := shown_result(context):
            draw_auto_update(self.layout, result)

    def draw(self, context):
        layout = self.layout
        result, report, frame = shown_result(context), shown_report(context), _frame(context)
        if not shows_colours(context.space_data):
            _draw_colours(context, layout)
        if frame is not None:
            draw_sequence(context, layout, frame)
        if result is not None:
            draw_result(context, layout, result)
        if report is not None:
            draw_report(context, layout, report)
        if result is not None:
            layout.operator("export_scene.medial_axis", icon="EXPORT")


class VIEW3D_PT_medial_axis_details(Closed, bpy.types.Panel):
    """All other figures, and every sentence"""

    bl_label = "Details"
    bl_idname = "VIEW3D_PT_medial_axis_details"

    @classmethod
    def poll(cls, context):
        return shown_result(context) is not None or shown_report(context) is not None

    def draw(self, context):
        if result := shown_result(context):
            draw_details(context, self.layout, result)
        if report := shown_report(context):
            draw_report_details(context, self.layout, report)


class VIEW3D_PT_medial_axis_surface(Inside, bpy.types.Panel):
    """Figures of the reconstructed surface"""

    bl_label = "Surface"
    bl_idname = "VIEW3D_PT_medial_axis_surface"

    @classmethod
    def poll(cls, context):
        return shown_surface(context) is not None

    def draw(self, context):
        draw_surface(context, self.layout, shown_surface(context))


def _settle_when_changed(context):
    """Have the sidebar drawn again where the panels will be taller or shorter than they were: Blender leaves those
    below where they were at first, over what has grown."""
    active, space = context.object, context.space_data
    now = (
        active and active.name,
        obstacle(context),
        context.scene.medial_axis.note,
        current_job.job() is None,
        space is not None and shows_colours(space),
    )
    sidebar = context.region.as_pointer()
    if _drawn.get(sidebar) != now:
        _drawn[sidebar] = now
        current_job.settle()


def _frame(context):
    """The active object, where it is one of a sequence."""
    active = context.object
    return active if active is not None and sequence_objects.FRAME in active else None


def _shown(context):
    """The object that the panel describes: a frame of a sequence, a medial axis, or a report."""
    return _frame(context) or shown_result(context) or shown_report(context)


def _draw_settings(context, layout):
    settings, column = context.scene.medial_axis, settings_column(layout)
    draw_form(context, column, settings)
    for name in ("theta", "rho"):
        column.prop(settings, name, slider=True)
    if result := shown_result(context):
        _draw_what_binds(context, column, result)
    column.prop(settings, "side")
    if Side[settings.side] in (Side.OUTER, Side.BOTH):
        column.prop(settings, "within")


def _draw_what_binds(context, layout, result):
    """Why a slider that is dragged does little: the other condition keeps what its own drops."""
    ratio, angle = result.get(axis_object.ONLY_RATIO, 0.0), result.get(axis_object.ONLY_ANGLE, 0.0)
    if ratio > _BINDS:
        draw_wrapped(context, layout, "Rho binds, not Theta", "INFO")
    elif angle > _BINDS:
        draw_wrapped(context, layout, "Theta binds, not Rho", "INFO")


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
    if not all(map(has_faces, sources(context))):
        button = layout.operator(
            "object.tight_cocone_surface", text="Reconstruct Surface", icon="MESH_ICOSPHERE"
        )
        copy_settings(context.scene.medial_axis, button)
    reason = obstacle(context)
    if reason and reason != native.problem():
        draw_wrapped(context, layout, reason, "INFO")


def _draw_progress(context, layout, job):
    whole = layout.row(align=True)
    whole.scale_y = 1.5  # as the button that is here otherwise, so that nothing below moves
    if bpy.app.version >= (5, 0):  # after such a bar, 4.3 draws the next label as a full one
        whole.progress(factor=job.fraction, text=f"{say(job.stage)}, {100 * job.fraction:.0f} %")
    else:
        row = whole.row(align=True)
        row.enabled = False
        bar = context.window_manager.medial_axis_progress
        row.prop(bar, "percentage", text=say(job.stage), slider=True)
    whole.operator("object.medial_axis_cancel", text="", icon="CANCEL")


def _draw_colours(context, layout):
    layout.operator(
        "view3d.medial_axis_show_colours",
        icon="COLOR",
        depress=shows_colours(context.space_data),
    )


def _draw_source(layout, thing):
    source = output_object.source_of(thing)
    layout.operator(
        "object.medial_axis_source_as_wire",
        icon="SHADING_WIRE",
        depress=source.display_type == "WIRE",
    ).name = thing.name


CLASSES = (
    VIEW3D_PT_medial_axis,
    VIEW3D_PT_medial_axis_sampling,
    VIEW3D_PT_medial_axis_method,
    VIEW3D_PT_medial_axis_show,
    VIEW3D_PT_medial_axis_result,
    VIEW3D_PT_medial_axis_surface,
    VIEW3D_PT_medial_axis_details,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
