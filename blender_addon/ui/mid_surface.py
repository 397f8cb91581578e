# SPDX-License-Identifier: GPL-3.0-or-later
"""Unsolidify: the sheets of thin solids, with their thickness."""

from functools import partial

import bpy

from ..bridge.mid_surface_object import (
    check_mid_surface_writable,
    place_thick_parts,
    write_mid_surface,
)
from ..core.mid_surface.mid_surface import mid_surface
from ..core.samples.density import share_text
from ..core.settings import LOOKS, MID_SURFACE_OPTIONS, MidSurfaceSettings
from .axis.compute_operator import Alone, SampledOperator
from .settings.preferences import memory_limit
from .settings.properties import prop, settings_from, with_options


@with_options(MID_SURFACE_OPTIONS)
class OBJECT_OT_medial_axis_unsolidify(SampledOperator, Alone, bpy.types.Operator):
    bl_idname = "object.medial_axis_unsolidify"
    bl_label = "Unsolidify"
    bl_description = (
        "Make one sheet of each wall of a thin solid, with its thickness and a Solidify modifier that gives the solid "
        "back"
    )

    product = "middle surface"
    parent: prop(LOOKS["parent"])
    shown = (*MID_SURFACE_OPTIONS, "parent")
    check_writable = staticmethod(check_mid_surface_writable)
    write = staticmethod(write_mid_surface)

    def work(self, shape):
        wanted = settings_from(self, MidSurfaceSettings)
        return partial(mid_surface, shape, settings_from(self), wanted, limit=memory_limit())

    def settle(self, made):
        for sheets in made:
            place_thick_parts(sheets)

    def summary(self, found):
        sheets = "1 sheet" if found.sheets == 1 else f"{found.sheets:,} sheets"
        low, high = float(found.thickness.min()), float(found.thickness.max())
        same = high - low <= 1e-3 * high
        thick = f"{high:.4g}" if same else f"{low:.4g} to {high:.4g}"
        return f"{sheets}, {thick} thick, with {share_text(found.share)} of the volume"
