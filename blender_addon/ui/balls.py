# SPDX-License-Identifier: GPL-3.0-or-later
"""Cover with Balls, and its panel: the number of balls, their promise, and their figures."""

from functools import partial

import bpy

from ..bridge.axis.read_axis import find_axis
from ..bridge.balls_object import balls_of, check_balls_writable, is_balls, write_balls
from ..bridge.mesh import stored
from ..bridge.objects.output_object import is_gone, source_of
from ..core.cover.ball_cover import cover_by_balls
from ..core.settings import BALL_OPTIONS, LOOKS, OPTIONS, BallSettings
from .axis.compute_operator import SampledOperator
from .axis.figures import length_text
from .base.tab import Closed, draws_buttons, settings_column
from .base.wrapped_text import counted, draw_wrapped
from .settings.preferences import memory_limit
from .settings.properties import (
    copy_settings,
    prop,
    settings_from,
    with_options,
)


@with_options(BALL_OPTIONS)
class BallProperties:
    """The number of balls, and what they promise."""


@with_options({name: OPTIONS[name] for name in ("theta", "rho", "rule", "criteria")})
class OBJECT_OT_medial_axis_balls(SampledOperator, BallProperties, bpy.types.Operator):
    bl_idname = "object.medial_axis_balls"
    bl_label = "Cover with Balls"
    bl_description = (
        "Make few balls that stand for the selected objects: for collisions, physics, robots"
    )

    product = "balls"
    check_writable = staticmethod(check_balls_writable)
    write = staticmethod(write_balls)

    shown = (*BALL_OPTIONS, "parent")
    parent: prop(LOOKS["parent"])

    def of_faces(self):
        return settings_from(self).options_of_faces  # balls are those of a clean form

    def work(self, shape):
        wanted = settings_from(self, BallSettings)
        return partial(cover_by_balls, shape, settings_from(self), wanted, limit=memory_limit())

    def summary(self, found):
        balls = found.balls
        return (
            f"{balls.words}, {100 * balls.covered:.1f} % of the volume, "
            f"at most {balls.outside:.4g} outside"
        )


class MedialAxisBallSettings(BallProperties, bpy.types.PropertyGroup):
    """The settings of the panel of balls."""


class VIEW3D_PT_medial_axis_balls(Closed, bpy.types.Panel):
    """Few balls that stand for the object"""

    bl_label = "Balls"
    bl_idname = "VIEW3D_PT_medial_axis_balls"

    @classmethod
    def poll(cls, context):
        active = context.object
        return find_axis(active) is not None or _shown(context) is not None

    def draw(self, context):
        settings = context.scene.medial_axis_balls
        column = settings_column(self.layout)
        for name in ("count", "shapes", "mode"):  # the others are in the panel of the operator
            column.prop(settings, name)
        if draws_buttons(self.layout):
            button = self.layout.operator("object.medial_axis_balls", icon="META_BALL")
            copy_settings(context.scene.medial_axis, button)
            copy_settings(settings, button, BALL_OPTIONS)
        if (thing := _shown(context)) is not None:
            _draw_figures(context, self.layout.column(align=True), thing)


def _shown(context):
    """The balls that the panel describes: the active object, or the balls of it or of its source."""
    active = context.object
    if active is None:
        return None
    if is_balls(active):
        return active
    source = source_of(active)
    return balls_of(active) or (None if is_gone(source) else balls_of(source))


def _draw_figures(context, layout, thing):
    capsules = len(thing.data.edges)
    single = max(0, len(thing.data.vertices) - 2 * capsules)
    number = counted({"capsules": capsules, "balls": single})
    text = f"{number} hold {100 * thing[stored.BALLS_COVERED]:.1f} % of the volume"
    if (out := thing[stored.BALLS_OUTSIDE]) > 0.0:
        text += f", reach out by at most {length_text(context, out)}"
    if (away := thing[stored.BALLS_FARTHEST]) > 0.0:
        text += f", leave no place farther than {length_text(context, away)} away"
    draw_wrapped(context, layout, text, "META_BALL")


PROPERTIES = {
    (bpy.types.Scene, "medial_axis_balls"): bpy.props.PointerProperty(type=MedialAxisBallSettings)
}
