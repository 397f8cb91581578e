# SPDX-License-Identifier: GPL-3.0-or-later
"""A source has two heat maps, the radii of its axis and its thickness; a window shows the one asked for last.

The axis is hidden behind thickness; thickness on a source of its own is grey behind the axis, and a copy is hidden.
"""

from __future__ import annotations

import bpy
import numpy as np

from ..axis.axis_object import result_of
from ..mesh import stored
from ..mesh.colours import colour_mesh, remember_colours
from ..objects.output_object import is_gone, source_of
from .thickness_object import carrier_of, is_copy


def show_thickness(carrier: bpy.types.Object) -> None:
    """Show the thickness that was written on a carrier, and hide the axis of its source."""
    axis = result_of(source_of(carrier) if is_copy(carrier) else carrier)
    _hide(axis, True)
    _hide(carrier, False)


def show_axis(axis: bpy.types.Object) -> None:
    """Show an axis, and no thickness of its source."""
    _hide(axis, False)
    carrier = carrier_of(source_of(axis))
    if carrier is None or not carrier.get(stored.COLOUR_OF):
        return
    if is_copy(carrier):
        _hide(carrier, True)
    elif carrier.mode == "OBJECT":
        none = np.full(len(carrier.data.vertices), np.nan)
        colour_mesh(carrier.data, none, 0.0, 1.0, render=False)
        remember_colours(carrier, "", 0.0, 0.0)
        carrier.data.update()


def shown_heat(axis: bpy.types.Object) -> bpy.types.Object | None:
    """The carrier of the thickness that is seen instead of an axis; None where the axis is."""
    carrier = carrier_of(source_of(axis))
    if (
        carrier is None
        or not carrier.get(stored.COLOUR_OF)
        or axis.visible_get()
        or not carrier.visible_get()
    ):
        return None
    return carrier


def _hide(thing: bpy.types.Object | None, hidden: bool) -> None:
    if not is_gone(thing) and thing.name in bpy.context.view_layer.objects:
        thing.hide_set(hidden)
