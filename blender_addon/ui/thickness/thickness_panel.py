# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Thickness: the limit, the button, and what was found, as rows that lead to it."""

import bpy

from ...bridge.mesh import stored
from ...bridge.objects.source_state import has_changed
from ...bridge.thickness.thin_selection import patch_at, patches_of
from ...core.axis.verdict import Light
from ...core.samples.density import share_text
from ...core.settings import THICKNESS_OPTIONS
from ..axis.figures import draw_thickness, length_text
from ..base.legend import light
from ..base.plain_words import draw_told, warned
from ..base.show import draw_colours, shows_colours
from ..base.tab import Closed, draws_buttons, settings_column
from ..base.translation import say
from ..base.wrapped_text import draw_wrapped
from ..settings.properties import copy_settings, shown_result
from .thickness_limits import unit_note
from .thickness_properties import shown_thickness


class VIEW3D_PT_medial_axis_thickness(Closed, bpy.types.Panel):
    """How thick the selected object is, and where it is thin"""

    bl_label = "Thickness"
    bl_idname = "VIEW3D_PT_medial_axis_thickness"

    def draw(self, context):
        layout, settings = self.layout, context.scene.medial_axis_thickness
        _draw_options(layout, settings)
        if context.object is not None and (note := unit_note(context, context.object)):
            draw_wrapped(context, layout, note, "INFO")
        if draws_buttons(layout):
            button = layout.operator("object.medial_axis_thickness", icon="DRIVER_DISTANCE")
            copy_settings(context.scene.medial_axis, button)
            copy_settings(settings, button, THICKNESS_OPTIONS)
        if settings.note:
            draw_told(context, layout, settings.note, "INFO")
        _draw_made(context, layout)
        carrier = shown_thickness(context)
        if carrier is not None:
            _draw_found(context, layout, carrier)


def _draw_options(layout, settings):
    column = settings_column(layout)
    # The others are in the panel of the operator.
    for name in ("limit", "between", "minimum_patch"):
        row = column.row()
        row.prop(settings, name)
        if name == "limit":
            row.menu("VIEW3D_MT_medial_axis_thickness_limits", text="", icon="DOWNARROW_HLT")


def _draw_made(context, layout):
    """The buttons of what is made of walls, measured or not."""
    if not draws_buttons(layout):
        return
    column = layout.column(align=True)
    button = column.operator("object.medial_axis_unsolidify", icon="MOD_SOLIDIFY")
    copy_settings(context.scene.medial_axis, button)
    limit = context.scene.medial_axis_thickness.limit
    column.operator("object.medial_axis_hollow", icon="MESH_UVSPHERE").wall = limit
    column.operator("object.medial_axis_solidify", icon="MOD_SOLIDIFY").thickness = limit


def _draw_found(context, layout, carrier):
    if has_changed(carrier, context.view_layer.depsgraph):
        draw_wrapped(context, layout, "The source has changed", icon_value=light(Light.LOOK.name))
    column = layout.column(align=True)
    least = carrier[stored.THICKNESS_MINIMUM]
    if stored.THICKNESS_PLACE in carrier and least < float("inf"):
        _draw_place(column, f"Minimum: {length_text(context, least)}", "MINIMUM", "ZOOM_SELECTED")
    if carrier[stored.THICKNESS_LIMIT] > 0.0:
        if thin := carrier[stored.THICKNESS_AREA]:
            share = share_text(carrier[stored.THICKNESS_SHARE])
            text = say(f"Thin: {_area(context, thin)} ({share})")
            column.label(text=text, icon="MESH_PLANE", translate=False)
        _draw_patches(context, column, carrier)
        if thin and not carrier[stored.THICKNESS_GAP]:
            _draw_thicken(context, layout)
    if shown_result(context) is None:  # else the panel of the result has both
        draw_colours(context, layout)
        legend = layout.column()  # always there, so that no row below moves
        legend.active = shows_colours(context.space_data)
        draw_thickness(context, legend, carrier)
    layout.operator("export_scene.medial_axis_thickness", icon="EXPORT")
    for warning in carrier.get(stored.WARNINGS, "").splitlines():
        draw_told(context, layout, warning, "ERROR", warned)


def _draw_thicken(context, layout):
    if not draws_buttons(layout):
        return
    column, operator = layout.column(align=True), "object.medial_axis_thicken"
    for text, icon, divides in (
        ("Thicken to the Limit", "MOD_SOLIDIFY", False),
        ("Subdivide and Thicken", "MOD_SUBSURF", True),
    ):
        button = column.operator(operator, text=say(text), icon=icon, translate=False)
        copy_settings(context.scene.medial_axis, button)
        button.limit = context.scene.medial_axis_thickness.limit
        button.subdivide = divides


def _draw_patches(context, column, carrier):
    count, current = patches_of(carrier), carrier[stored.THICKNESS_CURRENT]
    if not count:
        column.label(text="Nothing is too thin", icon="CHECKMARK")
        return
    total = carrier[stored.THICKNESS_PATCHES]
    text = "1 patch" if total == 1 else f"{total:,} patches"
    if current >= 0:
        _, _, minimum = patch_at(carrier, current)
        text = f"Patch {current + 1:,} of {total:,}: {length_text(context, minimum)}"
    row = column.row(align=True)
    _draw_place(row, "", "PREVIOUS", "TRIA_LEFT")
    _draw_place(row, text, "NEXT", "NONE")
    _draw_place(row, "", "NEXT", "TRIA_RIGHT")
    _draw_place(column, "Select All Thin Faces", "ALL", "RESTRICT_SELECT_OFF")


def _draw_place(layout, text, which, icon):
    operator = "object.medial_axis_thin_place"
    button = layout.operator(operator, text=say(text), icon=icon, translate=False)
    button.which = which


def _area(context, area):
    """An area in the unit of the scene, squared."""
    units = context.scene.unit_settings
    if units.system == "NONE":
        return f"{area:.3g}"
    return bpy.utils.units.to_string(
        units.system, "AREA", area * units.scale_length**2, precision=3
    )
