# SPDX-License-Identifier: GPL-3.0-or-later
"""The place of the panels of this add-on, and the column of their settings."""

from . import current_job

MAIN = "VIEW3D_PT_medial_axis"  # the panel that holds the others
RESULT = "VIEW3D_PT_medial_axis_result"
SETTINGS = "VIEW3D_PT_medial_axis_settings"
# Letters of a label beside its value or its box, in a sidebar as wide as it is at first.
_FITS, _FITS_A_SWITCH = 10, 14


class Tab:
    """A panel in the sidebar of the 3D viewport."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Medial Axis"


class Inside(Tab):
    """A panel inside the main one."""

    bl_parent_id = MAIN


class Closed(Inside):
    """A panel that is closed until someone opens it."""

    bl_options = {"DEFAULT_CLOSED"}


class InResult(Closed):
    """A panel inside that of the result."""

    bl_parent_id = RESULT


class InSettings(Closed):
    """A panel inside that of the settings."""

    bl_parent_id = SETTINGS


def draws_buttons(layout, count=1):
    """Whether to draw buttons that begin a computation; while there is one, their places are left empty.

    Blender keeps a button grey that was so below the mouse, and panels must not move when a computation begins or ends.
    """
    if current_job.job() is None:
        return True
    for _ in range(count):
        layout.label(text="")
    return False


def draw_setting(column, owner, name, **words):
    """A setting in such a column: a label that does not fit beside its value stands in it, or above it."""
    prop = getattr(owner, "properties", owner).bl_rna.properties[name]  # those of an operator
    if len(prop.name) <= (_FITS_A_SWITCH if prop.type == "BOOLEAN" else _FITS):
        column.prop(owner, name, **words)
    elif prop.type == "ENUM":
        column.label(text=prop.name, text_ctxt=prop.translation_context)
        column.prop(owner, name, text="", **words)
    else:
        row = column.row()
        row.use_property_split = False
        row.prop(owner, name, **words)


def settings_column(layout):
    """A column of settings: labels at the left, values at the right, no dots for keyframes."""
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    return column
