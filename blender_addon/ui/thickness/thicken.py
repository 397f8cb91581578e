# SPDX-License-Identifier: GPL-3.0-or-later
"""Thicken to the Limit: the thin walls of the selected objects, moved apart and measured again."""

from dataclasses import dataclass, replace
from functools import partial

import bpy

from ...bridge.objects.output_object import source_of
from ...bridge.objects.read_object import read_object
from ...bridge.objects.source_state import remember_state, state_of
from ...bridge.thickness.divided_faces import Division, divide, divided
from ...bridge.thickness.thicken_modifier import (
    check_thickenable,
    reserve_moves,
    selected_triangles,
    write_moves,
)
from ...bridge.thickness.thickness_object import check_thickness_writable, write_thickness
from ...core.samples.density import share_text
from ...core.settings import LOOKS, THICKEN_OPTIONS, Moving, ThickenSettings
from ...core.thickness.thicken import Thickened, thicken
from ...core.thickness.thin_in_part import DIVISIONS, faces_to_divide
from ..axis.compute_operator import Read, SampledOperator
from ..settings.preferences import memory_limit
from ..settings.properties import prop, settings_from, with_options


@dataclass(frozen=True)
class _Walls(Read):
    """A shape, which of its triangles are selected, and how the faces of the mesh were divided for it."""

    selected: object
    divisions: tuple[Division, ...]


@dataclass(frozen=True)
class _Found:
    """Thicker walls, and how the faces of the mesh have to be divided for them."""

    thicker: Thickened
    divisions: tuple[Division, ...]

    @property
    def seconds(self):
        return self.thicker.seconds

    @property
    def warnings(self):
        return self.thicker.warnings


def _thickened(walls, settings, wanted, limit, progress):
    found = thicken(walls.shape, settings, wanted, walls.selected, progress, limit)
    return _Found(found, walls.divisions)


@with_options(THICKEN_OPTIONS)
class OBJECT_OT_medial_axis_thicken(SampledOperator, bpy.types.Operator):
    bl_idname = "object.medial_axis_thicken"
    bl_label = "Thicken to the Limit"
    bl_description = (
        "Move walls that are thinner than the limit apart until they are as thick, by a modifier that keeps the mesh, "
        "and measure them again"
    )

    @classmethod
    def description(cls, _context, properties):
        """Return the text of a tooltip; where it is empty, Blender takes the description above."""
        if not properties.subdivide:
            return ""
        return bpy.app.translations.pgettext_tip(
            "Subdivide the large faces of the mesh that are thinner than the limit in one part only, then thicken to "
            "the limit"
        )

    product = "thicker walls"
    parent: prop(LOOKS["parent"])
    shown = THICKEN_OPTIONS

    @staticmethod
    def check_writable(thing):
        check_thickness_writable(thing)
        check_thickenable(thing)

    def read(self, thing, depsgraph):
        if not self.subdivide:
            return self._walls(thing, depsgraph, ())
        plan = partial(faces_to_divide, settings=settings_from(self), limit=self.limit)
        with divided(thing, plan, DIVISIONS) as steps:
            return self._walls(thing, bpy.context.evaluated_depsgraph_get(), steps)

    def _walls(self, thing, depsgraph, steps):
        by_selection = self.moving == Moving.SELECTED.name
        chosen = selected_triangles(thing) if by_selection else None
        return _Walls(read_object(thing, depsgraph), chosen, steps)

    def work(self, walls):
        # The mesh itself is divided, so there is nothing left for the core to divide.
        wanted = replace(settings_from(self, ThickenSettings), subdivide=False)
        return partial(_thickened, walls, settings_from(self), wanted, memory_limit())

    def write(self, thing, found, frame):
        thicker = found.thicker
        if thicker.moves.any():
            reserve_moves(thing)
            for step in found.divisions:
                divide(thing.data, step)
            write_moves(thing, thicker.moves)
            bpy.context.view_layer.update()
        return write_thickness(thing, thicker.after, thicker.left, frame)

    def settle(self, made):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for carrier in made:
            remember_state(carrier, state_of(source_of(carrier) or carrier, depsgraph))

    def summary(self, found):
        found = found.thicker
        if not found.moves.any() and not found.left.told:
            return f"Nothing had to move; minimum {found.after.minimum:.4g}"
        text = (
            f"The least thickness was {found.before.minimum:.4g} and is {found.after.minimum:.4g}"
        )
        if found.left.told:
            text += f"; {share_text(found.left.share)} of the area is still thinner than {self.limit:.4g}"
        return text
