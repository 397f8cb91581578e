# SPDX-License-Identifier: GPL-3.0-or-later
"""The place of the panels of this add-on, and the column of their settings."""

MAIN = "VIEW3D_PT_medial_axis"  # the panel that holds the others


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


def settings_column(layout):
    """A column of settings: labels at the left, values at the right, no dots for keyframes."""
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    return column
