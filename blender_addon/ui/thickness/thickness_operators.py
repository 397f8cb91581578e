# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure Thickness, and the operators that lead to thin places."""

from functools import partial

import bpy
from mathutils import Vector

from ...bridge.mesh import stored
from ...bridge.objects.output_object import is_gone, source_of
from ...bridge.thickness.heat_map import show_thickness
from ...bridge.thickness.thickness_object import (
    THIN,
    check_thickness_writable,
    is_copy,
    write_thickness,
)
from ...bridge.thickness.thin_selection import least_of, patch_at, patches_of, select_thin
from ...core.settings import LOOKS, THICKNESS_OPTIONS, Noise, ThicknessSettings
from ...core.thickness.thickness import measure_thickness
from ...core.thickness.thin_parts import find_thin_parts
from ..axis.compute_operator import SampledOperator
from ..base.plain_words import Needing
from ..base.show import show_colours, shows_colours
from ..base.translation import say
from ..base.view_place import edit_faces, show_place, viewport_of
from ..settings.preferences import memory_limit
from ..settings.properties import prop, settings_from, with_options
from .thickness_properties import shown_thickness


@with_options(THICKNESS_OPTIONS)
class OBJECT_OT_medial_axis_thickness(SampledOperator, bpy.types.Operator):
    bl_idname = "object.medial_axis_thickness"
    bl_label = "Measure Thickness"
    bl_description = (
        "Measure how thick the selected objects are, or how wide their gaps, and show where they are "
        "thinner than the limit"
    )

    product = "thickness"
    check_writable = staticmethod(check_thickness_writable)

    shown = THICKNESS_OPTIONS
    parent: prop(LOOKS["parent"])

    def modal(self, context, event):
        ended = super().modal(context, event)
        if ended == {"FINISHED"}:
            _colour_view(viewport_of(context))
        return ended

    def acts(self, name):
        return name != "edges" or self.noise == Noise.CLEAN.name

    def work(self, shape):
        wanted = settings_from(self, ThicknessSettings)
        return partial(measure_thickness, shape, settings_from(self), wanted, limit=memory_limit())

    def write(self, thing, found, frame):
        return write_thickness(thing, found, find_thin_parts(found, self.limit), frame)

    def settle(self, made):
        if not self.select_result:  # in a window
            for carrier in made:
                show_thickness(carrier)

    def summary(self, found):
        parts = find_thin_parts(found, self.limit)
        text = f"Minimum {found.minimum:.4g}"
        if self.limit > 0.0:
            text += f"; {100 * parts.share:.1f} % of the area thinner than {self.limit:.4g}"
        return text


class OBJECT_OT_medial_axis_thin_place(Needing, bpy.types.Operator):
    bl_idname = "object.medial_axis_thin_place"
    bl_label = "Show Thin Place"
    bl_description = "Select the faces of a thin place in edit mode, and look at it"
    bl_options = {"REGISTER", "UNDO"}

    which: bpy.props.EnumProperty(
        name="Place",
        description="Which place is shown",
        items=[
            ("MINIMUM", "Minimum", "Where it is thinnest"),
            ("NEXT", "Next", "The next thin patch; the thinnest comes first"),
            ("PREVIOUS", "Previous", "The thin patch before"),
            ("ALL", "All", "Every thin face; the view stays"),
        ],
        default="MINIMUM",
        options={"SKIP_SAVE"},
    )

    needs = "Select an object whose thickness was measured before"

    @classmethod
    def find(cls, context):
        carrier = shown_thickness(context)
        return carrier if carrier is not None and stored.THICKNESS_PLACE in carrier else None

    def execute(self, context):
        carrier = shown_thickness(context)
        target = _selected_on(context, carrier)
        if self.which == "ALL":
            count = select_thin(target)
            edit_faces(context, target)
            self.report({"INFO"}, say(f"{count:,} faces are thin"))
            return {"FINISHED"}
        found = self._place(carrier)
        if found is None:
            self.report({"INFO"}, say("Nothing is thinner than the limit"))
            return {"CANCELLED"}
        place, size = found
        world = carrier.matrix_world
        local = target.matrix_world.inverted_safe() @ world @ Vector(place)
        select_thin(target, tuple(local))
        edit_faces(context, target)
        show_place(context, world @ Vector(place), size)
        return {"FINISHED"}

    def _place(self, carrier):
        """The place to look at, in the carrier's own frame, and its size; None where nothing is thin."""
        if self.which == "MINIMUM":
            return least_of(carrier)
        count = patches_of(carrier)
        if not count:
            return None
        step = 1 if self.which == "NEXT" else -1
        current = carrier[stored.THICKNESS_CURRENT]
        carrier[stored.THICKNESS_CURRENT] = (
            (current + step) % count if current >= 0 or step > 0 else count - 1
        )
        place, area, minimum = patch_at(carrier, carrier[stored.THICKNESS_CURRENT])
        return place, max(area**0.5, 4 * minimum)


def _colour_view(space):
    """Show colours in Solid view; other views show materials, which somebody may have chosen."""
    if space is not None and space.shading.type == "SOLID" and not shows_colours(space):
        show_colours(space)


def _selected_on(context, carrier):
    """The object whose faces are selected: the active object where it has the attribute, else the carrier."""
    active = context.object
    source = source_of(carrier) if is_copy(carrier) else carrier
    on_source = active == source and not is_gone(source) and source.type == "MESH"
    return source if on_source and THIN in source.data.attributes else carrier
