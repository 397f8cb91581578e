# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab of the 3D viewport."""

import bpy

from ..bridge import axis_object, output_object, report_object, surface_object
from ..bridge.material import LIMIT
from ..core.machine import native
from . import current_job
from .form_panel import draw_form
from .presets import VIEW3D_PT_medial_axis_presets
from .properties import copy_settings, draw_sampling, shown_report, shown_result, shown_surface
from .selected_sources import obstacle
from .translation import say
from .wrapped_text import draw_wrapped


class _Tab:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Medial Axis"


class VIEW3D_PT_medial_axis(_Tab, bpy.types.Panel):
    """Settings, the button, progress"""

    bl_label = "Medial Axis"
    bl_idname = "VIEW3D_PT_medial_axis"

    def draw_header_preset(self, _context):
        VIEW3D_PT_medial_axis_presets.draw_panel_header(self.layout)

    def draw(self, context):
        layout = self.layout
        if problem := native.problem():
            draw_wrapped(context, layout.box(), problem, "ERROR")
        _draw_settings(context, layout)
        _draw_compute(context, layout)
        for note in context.scene.medial_axis.note.splitlines():
            draw_wrapped(context, layout, note, "INFO")


class VIEW3D_PT_medial_axis_sampling(_Tab, bpy.types.Panel):
    """How faces are sampled, and the report"""

    bl_label = "Sampling"
    bl_idname = "VIEW3D_PT_medial_axis_sampling"
    bl_parent_id = "VIEW3D_PT_medial_axis"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        settings = context.scene.medial_axis
        column = self.layout.column()
        column.use_property_split = True
        column.use_property_decorate = False
        draw_sampling(column, settings)
        if current_job.job() is None:  # Blender keeps a button grey that was so below the mouse
            button = self.layout.operator("object.medial_axis_sampling_report", icon="VIEWZOOM")
            copy_settings(settings, button)
        report = shown_report(context)
        if report is not None:
            _draw_report(context, self.layout, report)


class VIEW3D_PT_medial_axis_result(_Tab, bpy.types.Panel):
    """Figures of the result, and files"""

    bl_label = "Result"
    bl_idname = "VIEW3D_PT_medial_axis_result"
    bl_parent_id = "VIEW3D_PT_medial_axis"

    def draw(self, context):
        layout = self.layout
        result = shown_result(context)
        if result is None:
            layout.label(text="No medial axis yet", icon="INFO")
        else:
            _draw_figures(context, layout, result)
        layout.operator("export_scene.medial_axis", icon="EXPORT")


class VIEW3D_PT_medial_axis_surface(_Tab, bpy.types.Panel):
    """Figures of the reconstructed surface"""

    bl_label = "Surface"
    bl_idname = "VIEW3D_PT_medial_axis_surface"
    bl_parent_id = "VIEW3D_PT_medial_axis"

    @classmethod
    def poll(cls, context):
        return shown_surface(context) is not None

    def draw(self, context):
        _draw_surface(context, self.layout, shown_surface(context))


def _draw_settings(context, layout):
    panel = context.scene.medial_axis
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    draw_form(column, panel)
    for name in ("theta", "rho"):
        column.prop(panel, name, slider=True)
    for name in ("side", "sides", "sampling", "rule", "criteria", "limit_set"):
        column.prop(panel, name)


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
    layout.operator(
        "object.tight_cocone_surface", text="Reconstruct Surface", icon="MESH_ICOSPHERE"
    )
    reason = obstacle(context)
    if reason and reason != native.problem():
        draw_wrapped(context, layout, reason, "INFO")


def _draw_progress(context, layout, job):
    if hasattr(layout, "progress"):  # from 4.0
        layout.progress(factor=job.fraction, text=f"{say(job.stage)}, {100 * job.fraction:.0f} %")
    else:
        row = layout.row()
        row.enabled = False
        bar = context.window_manager.medial_axis_progress
        row.prop(bar, "percentage", text=say(job.stage), slider=True)
    layout.operator("object.medial_axis_cancel", icon="CANCEL")


def _draw_figures(context, layout, result):
    smallest, largest = axis_object.radius_range(result)
    _draw_table(
        layout,
        result,
        {
            "Points": f"{result.get(output_object.POINTS, 0):,}",
            "Duplicates": f"{result.get(output_object.DUPLICATES, 0):,}",
            "Facets": f"{len(result.data.polygons):,}",
            "Vertices": f"{len(result.data.vertices):,}",
            "Unbounded": f"{result.get(axis_object.UNBOUNDED, 0):,}",
            "Without Area": f"{result.get(axis_object.ZERO_AREA, 0):,}",
            "Radius": f"{smallest:.3g} to {largest:.3g}",
        },
    )
    for name in (
        axis_object.TOPOLOGY,
        output_object.SAMPLED,
        output_object.DENSITY,
        axis_object.INSIDE,
    ):
        if sentence := result.get(name):
            draw_wrapped(context, layout, sentence, "INFO")
    _draw_warnings(context, layout, result)


def _draw_surface(context, layout, surface):
    _draw_table(
        layout,
        surface,
        {
            "Points": f"{surface.get(output_object.POINTS, 0):,}",
            "Duplicates": f"{surface.get(output_object.DUPLICATES, 0):,}",
            "Off Surface": f"{surface.get(surface_object.OFF_SURFACE, 0):,}",
            "Triangles": f"{len(surface.data.polygons):,}",
            "Non-Manifold": f"{surface.get(surface_object.NONMANIFOLD_EDGES, 0):,} edges",
            "": f"{surface.get(surface_object.NONMANIFOLD_VERTICES, 0):,} points",
            "Cavities": f"{surface.get(surface_object.CAVITIES, 0):,}",
        },
    )
    _draw_warnings(context, layout, surface)


def _draw_report(context, layout, report):
    limit = report.get(LIMIT, 0.0)
    worst = report.get(report_object.WORST) or [0.0]
    _draw_table(
        layout,
        report,
        {
            "Samples": f"{report.get(output_object.POINTS, 0):,}",
            "Epsilon": f"{report.get(report_object.MEDIAN, 0.0):.2f} (median)",
            "95 % Below": f"{report.get(report_object.P95, 0.0):.2f}",
            f"Above {limit:g}": f"{100 * report.get(report_object.SHARE, 0.0):.1f} %",
            "And at Edges": f"{100 * report.get(report_object.SHARE_OF_ALL, 0.0):.1f} %",
            "Worst": f"{worst[0]:.2g}",
        },
    )
    draw_wrapped(context, layout, report.get(output_object.SAMPLED, ""), "INFO")
    _draw_warnings(context, layout, report)


def _draw_table(layout, thing, figures):
    layout.label(text=thing.name, icon="OUTLINER_OB_MESH", translate=False)
    column = layout.column(align=True)
    for label, text in figures.items():
        row = column.split(factor=0.45)
        row.label(text=say(label), translate=False)
        row.label(text=say(text), translate=False)


def _draw_warnings(context, layout, thing):
    for warning in thing.get(output_object.WARNINGS, "").splitlines():
        draw_wrapped(context, layout, warning, "ERROR")


CLASSES = (
    VIEW3D_PT_medial_axis,
    VIEW3D_PT_medial_axis_sampling,
    VIEW3D_PT_medial_axis_result,
    VIEW3D_PT_medial_axis_surface,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
