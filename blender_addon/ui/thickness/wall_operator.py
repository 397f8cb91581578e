# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of the operators that make something of the walls of a solid, which samples find."""

from ...core.settings import LOOKS, OPTIONS
from ..axis.compute_operator import ComputeOperator
from ..settings.properties import SamplingProperties, draw_sampling, prop


class WallOperator(ComputeOperator, SamplingProperties):
    """A subclass names its own options in `shown`; those of sampling come after them, in a box."""

    shown = ()

    sides: prop(OPTIONS["sides"])
    parent: prop(LOOKS["parent"])

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in self.shown:
            self.layout.prop(self, name)
        box = self.layout.box().column()
        for name in ("sides", "sampling"):
            box.prop(self, name)
        draw_sampling(box, self)
