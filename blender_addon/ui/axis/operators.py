# SPDX-License-Identifier: GPL-3.0-or-later
"""Compute Medial Axis, Report Sampling, Reconstruct Surface, and Cancel."""

from functools import partial

import bpy

from ...bridge.axis.axes_of_parts import remove_other_parts, write_result_of_part
from ...bridge.axis.axis_object import check_writable, result_of, write_result
from ...bridge.axis.parts_objects import MOST
from ...bridge.axis.report_object import (
    check_report_writable,
    check_source_writable,
    report_of,
    shows_well,
    write_on_source,
    write_report,
)
from ...bridge.axis.shown_axis import compute_draft, compute_shown
from ...bridge.mesh import stored
from ...bridge.objects.output_object import is_gone, source_of
from ...bridge.surface_object import check_surface_writable, is_surface, write_surface
from ...bridge.thickness.heat_map import show_axis
from ...core.axis.topology import betti_in_short
from ...core.errors import InvalidInputError, MedialAxisError
from ...core.rebuild.reconstruction import reconstruct
from ...core.samples.mesh_parts import split
from ...core.samples.sampling_report import report_sampling
from ...core.samples.thinning import is_coarse
from ...core.settings import (
    DIVISION,
    LOOKS,
    OPTIONS,
    SAMPLING_OPTIONS,
    Form,
    applies_to_form,
)
from ..base import current_job
from ..base.translation import say
from ..settings.guide import end_guide
from ..settings.preferences import memory_limit
from ..settings.properties import (
    draw_sampling,
    look_from,
    prop,
    settings_from,
    with_options,
)
from .compute_operator import ComputeOperator, SampledOperator


@with_options(OPTIONS | LOOKS | DIVISION)
class OBJECT_OT_medial_axis(ComputeOperator, bpy.types.Operator):
    """Compute the medial axis of the selected objects, with the radius at every point"""

    bl_idname = "object.medial_axis"
    bl_label = "Compute Medial Axis"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    product = "medial axis"
    check_writable = staticmethod(check_writable)

    def draw(self, _context):
        self.layout.use_property_split = True
        settings = settings_from(self)
        for name in (*OPTIONS, "each_part", "parent"):
            acts = applies_to_form(name, Form[self.form])
            if name == "crisp":
                acts = settings.crisp_is_possible
            if acts and name not in SAMPLING_OPTIONS:
                self.layout.prop(self, name)
        draw_sampling(self.layout.box().column(), self, settings.options_of_faces)

    def divided(self, shape):
        if not self.each_part:
            return super().divided(shape)
        found = split(shape, settings_from(self))
        if len(found.parts) > MOST:
            raise InvalidInputError(
                f"Expected at most {MOST:,} connected parts, found {len(found.parts):,}; delete or "
                "merge some of them, or switch Each Part by Itself off"
            )
        return {found.words(part.number): part.shape for part in found.parts}, found.warnings

    def work(self, shape):
        return partial(compute_shown, shape, settings_from(self), look_from(self), memory_limit())

    def draft(self, thing, shape):
        """The first click shows an axis of few samples, unless the exact one needs no more."""
        settings = settings_from(self)
        if result_of(thing) is not None or is_coarse(shape, settings):
            return None
        return partial(compute_draft, shape, settings, look_from(self), memory_limit())

    def write_draft(self, thing, found, frame):
        made = self.write(thing, found, frame)
        if made is not None:
            made[stored.DRAFT] = True
        return made

    def write(self, thing, found, frame):
        if found.shown is None:
            return None
        return write_result(thing, found.computation, frame, look_from(self), shown=found.shown)

    def write_part(self, part, thing, found, frame):
        if found.shown is None:
            raise MedialAxisError(found.warnings[-1])
        look = look_from(self)
        return write_result_of_part(thing, part, found.computation, frame, look, found.shown)

    def settle(self, made):
        if made:
            end_guide(bpy.context)
        if self.each_part:
            remove_other_parts(made)
        if not self.select_result:  # in a window
            for axis in made:
                show_axis(axis)

    def summary(self, found):
        level = found.shown.axis.level
        betti = (found.shown.pieces, 0, 0) if level is None else level.betti
        return ", ".join(betti_in_short(betti))


class OBJECT_OT_medial_axis_sampling_report(SampledOperator, bpy.types.Operator):
    bl_idname = "object.medial_axis_sampling_report"
    bl_label = "Report Sampling"
    bl_description = (
        "Show how densely the selected objects are sampled for their shape: the samples as a mesh, "
        "coloured by epsilon"
    )

    product = "report"

    shown = ("target", "side", "colours", "parent")
    side: prop(OPTIONS["side"])
    target: bpy.props.EnumProperty(
        name="Write To",
        description="Where the attribute ma_epsilon is written",
        items=[
            (
                "AUTOMATIC",
                "Automatic",
                "The object itself where its vertices can show it; else a copy",
            ),
            ("COPY", "Copy", "A new object, or the one that was made before, of the samples"),
            (
                "SOURCE",
                "Source",
                "The vertices of the object itself: the largest epsilon of the samples to which "
                "each is nearest",
            ),
        ],
        default="AUTOMATIC",
    )
    colours: prop(LOOKS["colours"])
    parent: prop(LOOKS["parent"])

    def check_writable(self, thing):
        check_source_writable(thing) if self.target == "SOURCE" else check_report_writable(thing)

    def work(self, shape):
        return partial(report_sampling, shape, settings_from(self), limit=memory_limit())

    def write(self, thing, found, frame):
        on_source = self.target == "SOURCE"
        if self.target == "AUTOMATIC":
            on_source = report_of(thing) is None and shows_well(thing, found)
        if on_source:
            return write_on_source(thing, found, self.colours)
        return write_report(thing, found, frame, self.colours)

    def summary(self, found):
        return f"{len(found.vertices):,} samples"


class OBJECT_OT_tight_cocone_surface(ComputeOperator, bpy.types.Operator):
    bl_idname = "object.tight_cocone_surface"
    bl_label = "Reconstruct Surface"
    bl_description = (
        "Make a watertight surface through the points of the selected objects; "
        "faces and normals are not used"
    )

    product = "surface"
    check_writable = staticmethod(check_surface_writable)
    write = staticmethod(write_surface)

    parent: prop(LOOKS["parent"])

    def sources(self, context):
        return list(dict.fromkeys(map(_made_anew, super().sources(context))))

    def work(self, shape):
        return partial(reconstruct, shape.points, limit=memory_limit())

    def summary(self, found):
        return f"{len(found.triangles):,} triangles"


class OBJECT_OT_medial_axis_cancel(bpy.types.Operator):
    """Stop the computation; nothing is changed"""

    bl_idname = "object.medial_axis_cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        if current_job.job() is None:
            cls.poll_message_set(say("Nothing is being computed"))
        return current_job.job() is not None

    def execute(self, _context):
        current_job.job().cancel()
        return {"FINISHED"}


def _made_anew(thing):
    """The source of a surface that was reconstructed, as long as it exists; else the object itself."""
    source = source_of(thing) if is_surface(thing) else None
    return thing if is_gone(source) else source
