# SPDX-License-Identifier: GPL-3.0-or-later
"""Thicken to the Limit: the thin walls of the selected objects, moved apart and measured again."""

from dataclasses import dataclass
from functools import partial

import bpy

from ..bridge.output_object import source_of
from ..bridge.read_object import read_object
from ..bridge.source_state import remember_state, state_of
from ..bridge.thicken_modifier import check_thickenable, selected_triangles, write_moves
from ..bridge.thickness_object import check_thickness_writable, write_thickness
from ..core.samples.density import share_text
from ..core.settings import THICKEN_OPTIONS, Moving, ThickenSettings
from ..core.solid.thicken import thicken
from .preferences import memory_limit
from .properties import settings_from, with_options
from .wall_operator import WallOperator


@dataclass(frozen=True)
class _Walls:
    """A shape, and which of its triangles are selected."""

    shape: object
    selected: object

    @property
    def frame(self):
        return self.shape.frame


@with_options(THICKEN_OPTIONS)
class ThickenProperties:
    """The options of thicker walls."""


class OBJECT_OT_medial_axis_thicken(WallOperator, ThickenProperties, bpy.types.Operator):
    bl_idname = "object.medial_axis_thicken"
    bl_label = "Thicken to the Limit"
    bl_description = (
        "Move walls that are thinner than the limit apart until they are as thick, by a modifier that keeps the mesh, "
        "and measure them again"
    )
    bl_options = {"REGISTER", "UNDO"}

    product = "thicker walls"
    shown = THICKEN_OPTIONS

    @staticmethod
    def check_writable(thing):
        check_thickness_writable(thing)
        check_thickenable(thing)

    def read(self, thing, depsgraph):
        by_selection = self.moving == Moving.SELECTED.name
        chosen = selected_triangles(thing) if by_selection else None
        return _Walls(read_object(thing, depsgraph), chosen)

    def divided(self, walls):
        return {"": walls}, ()

    def work(self, walls):
        wanted = settings_from(self, ThickenSettings)
        return partial(
            thicken,
            walls.shape,
            settings_from(self),
            wanted,
            walls.selected,
            limit=memory_limit(),
        )

    def write(self, thing, found, frame):
        if found.moves.any():
            write_moves(thing, found.moves)
            bpy.context.view_layer.update()
        return write_thickness(thing, found.after, found.left, frame)

    def settle(self, made):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for carrier in made:
            remember_state(carrier, state_of(source_of(carrier) or carrier, depsgraph))

    def summary(self, found):
        if not found.moves.any() and not found.left.patches:
            return f"Nothing had to move; minimum {found.after.minimum:.4g}"
        text = (
            f"The least thickness was {found.before.minimum:.4g} and is {found.after.minimum:.4g}"
        )
        if found.left.patches:
            text += f"; {share_text(found.left.share)} of the area is still thinner than {self.limit:.4g}"
        return text


CLASSES = (OBJECT_OT_medial_axis_thicken,)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
