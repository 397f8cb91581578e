"""Compute Medial Axis, Reconstruct Surface, and Cancel."""

from functools import partial

import bpy

from ..bridge.made import is_gone, source_of
from ..bridge.results import check_writable, write_result
from ..bridge.surfaces import check_surface_writable, is_surface, write_surface
from ..core.analysis import compute
from ..core.reconstruction import reconstruct
from ..core.settings import OPTIONS
from . import running
from .properties import choice, number, settings_from, switch
from .watched import Watched


class OBJECT_OT_medial_axis(Watched, bpy.types.Operator):
    """Compute the medial axis of the selected meshes and point clouds, with the radius at every point"""

    bl_idname = "object.medial_axis"
    bl_label = "Compute Medial Axis"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    product = "medial axis"
    check_writable = staticmethod(check_writable)

    theta: number("theta")
    rho: number("rho")
    side: choice("side")
    sides: choice("sides")
    rule: choice("rule")
    criteria: choice("criteria")
    limit_set: switch("limit_set")

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in OPTIONS:
            self.layout.prop(self, name)

    def work(self, shape):
        return partial(
            compute, shape.points, shape.triangles, settings_from(self), normals=shape.normals
        )

    def write(self, thing, computation, frame):
        return write_result(thing, computation, frame) if computation.axis.facets else None

    def summary(self, computation):
        axis = computation.axis
        return (
            f"{computation.points:,} points, {axis.facets:,} facets, duplicates merged "
            f"{computation.duplicates:,}, unbounded facets {axis.unbounded:,}, facets "
            f"without area {axis.zero_area:,}; {computation.sides}"
        )


class OBJECT_OT_tight_cocone_surface(Watched, bpy.types.Operator):
    bl_idname = "object.tight_cocone_surface"
    bl_label = "Reconstruct Surface (Tight Cocone)"
    bl_description = (
        "Make a watertight surface through the points of the selected meshes and point clouds; "
        "faces and normals are not used"
    )
    bl_options = {"REGISTER", "UNDO"}

    product = "surface"
    check_writable = staticmethod(check_surface_writable)

    def sources(self, context):
        return list(dict.fromkeys(map(_made_anew, super().sources(context))))

    def work(self, shape):
        return partial(reconstruct, shape.points)

    def write(self, thing, found, frame):
        return write_surface(thing, found, frame)

    def summary(self, found):
        return (
            f"{found.points:,} points, {len(found.triangles):,} triangles, duplicates merged "
            f"{found.duplicates:,}, points off the surface {found.off_surface:,}, non-manifold "
            f"edges {found.nonmanifold_edges:,}, non-manifold points {found.nonmanifold_vertices:,}"
        )


class OBJECT_OT_medial_axis_cancel(bpy.types.Operator):
    """Stop the computation; nothing is changed"""

    bl_idname = "object.medial_axis_cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        if running.job() is None:
            cls.poll_message_set("Nothing is being computed")
        return running.job() is not None

    def execute(self, _context):
        running.job().cancel()
        return {"FINISHED"}


def _made_anew(thing):
    """Instead of a surface, what it was made of, as long as that exists."""
    source = source_of(thing) if is_surface(thing) else None
    return thing if is_gone(source) else source


CLASSES = (OBJECT_OT_medial_axis, OBJECT_OT_tight_cocone_surface, OBJECT_OT_medial_axis_cancel)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
