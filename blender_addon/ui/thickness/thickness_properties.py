# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of thickness as Blender properties; the limit acts on what was measured at once."""

import bpy

from ...bridge.mesh import stored
from ...bridge.objects.output_object import is_gone, source_of
from ...bridge.thickness.thickness_object import carrier_of, is_copy, show_limit
from ...core.errors import MedialAxisError
from ...core.settings import THICKNESS_OPTIONS
from ...core.thickness.thickness import kept_measurement
from ...core.thickness.thin_parts import find_thin_parts
from ..base import current_job
from ..settings.properties import with_options


def shown_thickness(context):
    """The object that carries the thickness of the active object; None where it was not measured."""
    return carrier_of(getattr(context, "object", None))


def _apply_limit(panel, context):
    """Show a new limit on what was measured, as long as it is kept."""
    panel.note = ""
    carrier = shown_thickness(context)
    if carrier is None or current_job.job() is not None:
        return
    found = kept_measurement(carrier[stored.THICKNESS_KEY])
    if found is None:
        panel.note = "Press Measure Thickness to apply this: the measurement is no longer in memory"
        return
    if _is_edited(carrier):
        panel.note = "Leave Edit Mode to see the new limit"
        return
    try:
        show_limit(carrier, found, find_thin_parts(found, panel.limit, panel.minimum_patch))
    except MedialAxisError as error:
        panel.note = str(error)


def _is_edited(carrier) -> bool:
    source = source_of(carrier) if is_copy(carrier) else carrier
    return carrier.mode == "EDIT" or (not is_gone(source) and source.mode == "EDIT")


@with_options({name: THICKNESS_OPTIONS[name] for name in ("limit", "minimum_patch")}, _apply_limit)
@with_options(THICKNESS_OPTIONS)
class MedialAxisThicknessSettings(bpy.types.PropertyGroup):
    """The settings of the panel; the limit and the smallest patch act at once."""

    note: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})


PROPERTIES = {
    (bpy.types.Scene, "medial_axis_thickness"): bpy.props.PointerProperty(
        type=MedialAxisThicknessSettings
    )
}
