# SPDX-License-Identifier: GPL-3.0-or-later
"""Turning the eye to a place."""

_AROUND = 3.0  # how much more than a thing is seen


def show_place(context, place, size):
    """Move the 3D viewport of the context to a place in the world where something so large is to be seen."""
    space = _viewport(context)
    if space is None:
        return
    region = space.region_3d
    region.view_location = place
    region.view_distance = max(_AROUND * size, 2 * space.clip_start)
    if region.view_perspective == "CAMERA":
        region.view_perspective = "PERSP"


def _viewport(context):
    """The viewport that was clicked in, else the first of the window; None where there is none."""
    if getattr(context.space_data, "type", "") == "VIEW_3D":
        return context.space_data
    areas = context.screen.areas if context.screen else ()
    return next((area.spaces.active for area in areas if area.type == "VIEW_3D"), None)
