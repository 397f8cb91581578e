# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduce to Few Vertices: a small medial mesh for games and animation."""

import bpy

from ..bridge.axis_object import is_result, result_of
from ..bridge.output_object import is_gone, source_of
from ..bridge.read_axis import read_axis
from ..bridge.read_object import read_object
from ..bridge.rebuilt_object import in_frame_of, is_rebuilt
from ..bridge.reduced_object import is_reduced, write_reduced
from ..core.axis.reduce import reduce_axis, reduced_difference
from ..core.errors import MedialAxisError
from .translation import say


def _axis(context):
    """The whole axis that the active object is, has, or was made of."""
    thing = context.active_object
    if thing is not None and is_rebuilt(thing):
        thing = source_of(thing)
    if not is_gone(thing) and is_reduced(thing):
        thing = source_of(thing)
    if is_gone(thing):
        return None
    return thing if is_result(thing) else result_of(thing)


class OBJECT_OT_medial_axis_reduce(bpy.types.Operator):
    bl_idname = "object.medial_axis_reduce"
    bl_label = "Reduce to Few Vertices"
    bl_description = (
        "Make a small medial mesh of the medial axis: triangles and edges between few balls, "
        "with the same topology and nearly the same solid"
    )
    bl_options = {"REGISTER", "UNDO"}

    vertices: bpy.props.IntProperty(
        name="Vertices",
        description="How many vertices there are at most; where less would change the topology, more stay",
        default=200,
        min=1,
        soft_max=5000,
    )

    @classmethod
    def poll(cls, context):
        if _axis(context) is None:
            cls.poll_message_set(
                say("Select a medial axis, or an object whose medial axis was computed before")
            )
            return False
        return True

    def execute(self, context):
        context.view_layer.update()
        result = _axis(context)
        try:
            axis = reduce_axis(read_axis(result), self.vertices)
            made = write_reduced(result, axis, self.vertices)
            found = _difference(context, result, axis)
        except MedialAxisError as error:
            self.report({"ERROR"}, say(error))
            return {"CANCELLED"}
        self.report({"INFO"}, say(_sentence(made.name, axis, found)))
        return {"FINISHED"}


def _difference(context, result, axis):
    """How far the solid is from the object that the axis was computed of; None where that has no faces, or is gone."""
    source = source_of(result)
    if is_gone(source):
        return None
    shape = read_object(source, context.evaluated_depsgraph_get())
    if not len(shape.triangles):
        return None
    return reduced_difference(axis, in_frame_of(shape, result))


def _sentence(name, axis, found):
    known = f"'{name}': {len(axis.vertices):,} vertices, {axis.facets:,} triangles, edges alone {len(axis.edges):,}"
    if found is None:
        return known
    return (
        f"{known}; {100 * found.mean:.3f} % of the diagonal away (mean), at most "
        f"{100 * found.largest:.2f} %"
    )


def _menu(self, _context):
    self.layout.operator("object.medial_axis_reduce", icon="MOD_DECIM")


CLASSES = (OBJECT_OT_medial_axis_reduce,)


def _menus():
    return (bpy.types.VIEW3D_MT_object, bpy.types.VIEW3D_MT_object_context_menu)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for menu in _menus():
        menu.append(_menu)


def unregister():
    for menu in _menus():
        menu.remove(_menu)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
