# SPDX-License-Identifier: GPL-3.0-or-later
"""Hollow: selected solids with a wall, and a hole through which what is inside flows out."""

from functools import partial

import bpy

from ..bridge.hollow_object import HOLLOW, hole_of, unhollowed, write_hollow
from ..core.hollow.hollow import hollow
from ..core.samples.density import share_text
from ..core.settings import DRAIN_OPTIONS, HOLLOW_OPTIONS, LOOKS, DrainAt, HollowSettings
from .axis.compute_operator import Alone, ComputeOperator
from .settings.properties import prop, settings_from, with_options


@with_options(HOLLOW_OPTIONS | DRAIN_OPTIONS)
class OBJECT_OT_medial_axis_hollow(ComputeOperator, Alone, bpy.types.Operator):
    bl_idname = "object.medial_axis_hollow"
    bl_label = "Hollow"
    bl_description = "Make a hollow copy of a solid with a wall of one thickness and a drain hole whose cylinder moves"

    product = "hollow solid"
    check_writable = staticmethod(HOLLOW.check_writable)

    parent: prop(LOOKS["parent"])

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in (*HOLLOW_OPTIONS, "drain"):
            self.layout.prop(self, name)
        if self.drain > 0.0:
            self.layout.prop(self, "drain_at")
        self.layout.prop(self, "parent")

    def sources(self, context):
        """A hollow solid leads back to what it was made of; for other operators it is a solid as any other."""
        return list(dict.fromkeys(map(unhollowed, super().sources(context))))

    def work(self, shape):
        return partial(hollow, shape, settings_from(self, HollowSettings))

    def write(self, thing, found, frame):
        at_cursor = self.drain_at == DrainAt.CURSOR.name
        hole = hole_of(found, frame, self.drain, at_cursor) if self.drain > 0.0 else None
        return write_hollow(thing, found, frame, hole)

    def summary(self, found):
        return (
            f"Wall {found.wall:.4g}, nowhere thinner than {found.least:.4g}; "
            f"{share_text(found.volume / found.solid_volume)} of the volume is left"
        )
