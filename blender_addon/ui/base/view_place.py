# SPDX-License-Identifier: GPL-3.0-or-later
"""Turning the eye to a place, and to selected faces."""

import bpy

_AROUND = 3.0  # how much more than a thing is seen


def show_place(context, place, size):
    """Move the 3D viewport of the context to a place in the world where something so large is to be seen."""
    space = viewport_of(context)
    if space is None:
        return
    region = space.region_3d
    region.view_location = place
    region.view_distance = max(_AROUND * size, 2 * space.clip_start)
    if region.view_perspective == "CAMERA":
        region.view_perspective = "PERSP"


def viewport_of(context):
    """The viewport that was clicked in, else the first of the window; None where there is none."""
    if getattr(context.space_data, "type", "") == "VIEW_3D":
        return context.space_data
    areas = context.screen.areas if context.screen else ()
    return next((area.spaces.active for area in areas if area.type == "VIEW_3D"), None)


def edit_faces(context, thing):
    """Enter edit mode of a mesh with faces as what is selected, for other modes show no selected faces.

    What is not to be seen, as in another scene, stays as it is.
    """
    if not thing.visible_get():
        return
    if context.object is not None and context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    thing.select_set(True)
    context.view_layer.objects.active = thing
    context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.object.mode_set(mode="EDIT")
