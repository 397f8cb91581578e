# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects from which an operator computes, and the reason why there may be none."""

from dataclasses import dataclass

import bpy

from ...bridge.axis.axis_object import is_result
from ...bridge.axis.reduced_object import is_reduced
from ...bridge.axis.report_object import is_report
from ...bridge.balls_object import is_balls
from ...bridge.mid_surface_object import is_mid_surface, is_thick
from ...bridge.objects.output_object import first_of_family, is_gone, source_of
from ...bridge.objects.read_object import SOURCE_TYPES
from ...bridge.skeleton.armature_object import is_armature
from ...bridge.skeleton.skeleton_object import is_skeleton
from ...bridge.thickness.thickness_object import is_copy
from ..base import current_job

_KINDS = "a mesh, point cloud, curve, surface, text or metaball"


# Objects of these kinds are made of a source and have no surface of their own.
_MADE = {
    is_result: "a medial axis",
    is_reduced: "a medial axis",
    is_report: "a report",
    is_copy: "a report",
    is_skeleton: "a skeleton",
    is_armature: "an armature",
    is_balls: "balls",
    is_mid_surface: "a middle surface",
    is_thick: "thick parts",
}


def _is_made(thing) -> bool:
    return any(is_kind(thing) for is_kind in _MADE)


@dataclass(frozen=True)
class Source:
    """A source that is found again later; `uid` is Blender's number for it, from 4.1 or so."""

    name: str
    uid: int | None
    frame: object  # (4, 4) float64
    world: object  # its matrix when it was read
    state: object = None  # its shape and scale when it was read, as source_state has them
    part: str = ""  # the connected part of it that is computed; empty for the whole

    def find(self):
        """The object, or None when it is gone."""
        if self.uid is None:
            found = bpy.data.objects.get(self.name)
        else:
            found = next((o for o in bpy.data.objects if o.session_uid == self.uid), None)
        return None if is_gone(found) else found


def sources(context) -> list:
    """The chosen objects that have a surface or points; instead of a medial axis, a report of samples, a skeleton, an
    armature or balls, what it was made of."""
    found = []
    for thing in _chosen(context):
        source = source_of(thing) if _is_made(thing) else thing
        if source is not None and source.type in SOURCE_TYPES and not is_gone(source):
            found.append(first_of_family(source))
    return list(dict.fromkeys(found))


def _chosen(context) -> list:
    """All that is selected or in edit mode, else what is seen of the active object: H hides and deselects a source."""
    chosen = [*_of(context, "selected_objects"), *_of(context, "objects_in_mode")]
    active = getattr(context, "object", None)
    if chosen or active is None:
        return chosen
    return [thing for thing in _of(context, "visible_objects") if source_of(thing) == active][:1]


def has_faces(thing) -> bool:
    """Whether a source is more than points, judged without evaluating it."""
    return thing.type != "POINTCLOUD" and (thing.type != "MESH" or bool(thing.data.polygons))


def obstacle(context) -> str:
    """Why an operator cannot run now, in one sentence, or an empty string."""
    if reason := current_job.obstacle():
        return reason
    if sources(context):
        return ""
    chosen = _chosen(context)
    if not chosen:
        return f"Select {_KINDS}; nothing is selected"
    thing = chosen[0]
    if _is_made(thing):
        kind = next(words for is_kind, words in _MADE.items() if is_kind(thing))
        return f"Select {_KINDS}; '{thing.name}' is {kind} whose source is gone"
    return f"Select {_KINDS}; '{thing.name}' is of type {thing.type.capitalize()}"


def _of(context, name) -> list:
    """A list of the context that not every editor has."""
    return getattr(context, name, None) or []
