# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduce to Few Vertices: a small medial mesh for games and animation."""

import time
from dataclasses import dataclass

import bpy

from ..bridge.axis.read_axis import find_axis, read_axis
from ..bridge.axis.reduced_object import check_reduced_writable, is_reduced, write_reduced
from ..bridge.objects.output_object import is_gone, source_of
from ..bridge.objects.read_object import read_object
from ..bridge.rebuilt_object import in_frame_of, unrebuilt
from ..core.axis.medial_axis import MedialAxis
from ..core.machine.progress import Progress
from ..core.rebuild.reduce import reduce_axis, reduced_difference
from ..core.rebuild.solid_difference import PointDifference
from ..core.shape.shape import Shape
from .axis.compute_operator import Alone, ComputeOperator
from .base import current_job
from .base.translation import say


@dataclass(frozen=True, eq=False)
class _Whole:
    """The axis that is reduced and, where there are any, the faces from which it was computed, in its frame."""

    axis: MedialAxis
    shape: Shape | None
    frame: None = None


@dataclass(frozen=True, eq=False)
class _Reduced:
    """The small axis, and how far its solid is from the faces."""

    axis: MedialAxis
    difference: PointDifference | None
    seconds: float
    warnings: tuple[str, ...] = ()


def _axis(context):
    """The whole axis that the active object is, has, or was made of."""
    axis = find_axis(unrebuilt(context.object))
    return find_axis(source_of(axis)) if axis is not None and is_reduced(axis) else axis


class OBJECT_OT_medial_axis_reduce(ComputeOperator, Alone, bpy.types.Operator):
    bl_idname = "object.medial_axis_reduce"
    bl_label = "Reduce to Few Vertices"
    bl_description = (
        "Make a small medial mesh of the medial axis: faces and edges between few balls, "
        "with the same topology and nearly the same solid"
    )

    product = "small medial mesh"
    parent = False  # it lies where its axis lies
    check_writable = staticmethod(check_reduced_writable)

    vertices: bpy.props.IntProperty(
        name="Vertices",
        description="How many vertices there are at most; where less would change the topology, more stay",
        default=200,
        min=1,
        soft_max=5000,
    )

    @classmethod
    def poll(cls, context):
        reason = current_job.obstacle()
        if not reason and _axis(context) is None:
            reason = "Select a medial axis, or an object whose medial axis was computed before"
        if reason:
            cls.poll_message_set(say(reason))
        return not reason

    def sources(self, context):
        context.view_layer.update()
        return [_axis(context)]

    def read(self, thing, depsgraph):
        return _Whole(read_axis(thing), _faces(thing, depsgraph))

    def work(self, whole):
        count = self.vertices
        return lambda progress: _reduced(whole, count, progress)

    def write(self, thing, found, _frame):
        return write_reduced(thing, found.axis, self.vertices)

    def summary(self, found):
        axis, away = found.axis, found.difference
        known = f"{len(axis.vertices):,} vertices, {axis.facets:,} faces, edges alone {len(axis.edges):,}"
        if away is None:
            return known
        return (
            f"{known}; {100 * away.mean:.3f} % of the diagonal away (mean), at most "
            f"{100 * away.largest:.2f} %"
        )


def _faces(result, depsgraph):
    """The object that an axis was computed of, in the frame of the axis; None where that has no faces, or is gone."""
    source = source_of(result)
    if is_gone(source):
        return None
    shape = read_object(source, depsgraph)
    return in_frame_of(shape, result) if len(shape.triangles) else None


def _reduced(whole, vertices, progress):
    start = time.perf_counter()
    progress = progress or Progress()
    progress.begin_share(0.5)
    axis = reduce_axis(whole.axis, vertices, progress)
    progress.begin_share(1.0)
    away = None if whole.shape is None else reduced_difference(axis, whole.shape, progress)
    return _Reduced(axis, away, time.perf_counter() - start)
