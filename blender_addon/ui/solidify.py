# SPDX-License-Identifier: GPL-3.0-or-later
"""Solidify: selected sheets, or selected faces, as closed solids of an even wall."""

from dataclasses import dataclass
from functools import partial

import bpy

from ..bridge.objects.read_object import read_object
from ..bridge.solidify_object import SOLID, chosen_triangles, write_solid
from ..core.arrays import Flags
from ..core.samples.density import share_text
from ..core.settings import LOOKS, SOLIDIFY_OPTIONS, SolidifySettings
from ..core.solidify.solidify import solidify
from .axis.compute_operator import Alone, ComputeOperator, Read
from .settings.properties import prop, settings_from, with_options


@dataclass(frozen=True)
class _Sheet(Read):
    """A shape, and which of its triangles are selected."""

    selected: Flags | None


@with_options(SOLIDIFY_OPTIONS)
class OBJECT_OT_medial_axis_solidify(ComputeOperator, Alone, bpy.types.Operator):
    bl_idname = "object.medial_axis_solidify"
    bl_label = "Solidify"
    bl_description = (
        "Make a closed solid of a sheet, with an even wall that does not cross itself and is thinner where there is no "
        "room for it"
    )

    product = "solid"
    check_writable = staticmethod(SOLID.check_writable)
    write = staticmethod(write_solid)

    parent: prop(LOOKS["parent"])

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in (*SOLIDIFY_OPTIONS, "parent"):
            self.layout.prop(self, name)

    def read(self, thing, depsgraph):
        shape = read_object(thing, depsgraph)
        return _Sheet(shape, chosen_triangles(thing) if self.only_selected else None)

    def work(self, sheet):
        wanted = settings_from(self, SolidifySettings)
        return partial(solidify, sheet.shape, wanted, sheet.selected)

    def summary(self, found):
        if found.without_room == 0.0:
            return f"Wall {found.wall:.4g}, everywhere"
        return f"Wall {found.wall:.4g}, but {found.least:.4g} at least on {share_text(found.without_room)} of the sheet"
