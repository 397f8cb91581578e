# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of what is analysed: the vertices or samples of the faces, what decides the inside, and how much effort."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..settings import Form, SamplingMode, Side, SidesFrom
from ..shape.check_faces import check_faces, check_not_flat
from ..shape.outward_faces import none_left
from .analysed import Sides
from .prepare import Input
from .sample_spacing import Amount
from .sides import check_not_a_sheet, resolve_sides, resolve_sides_of_samples


@dataclass(frozen=True)
class Effort:
    """The effort that a choice of Sampling allows."""

    passes: int  # The largest number of times that the faces are sampled
    # The smallest spacing at sharp edges, elsewhere, and between walls where that much is needed to see the axis, as
    # shares of the first pass's spacing
    at_edges: float
    elsewhere: float
    walls: float


# The shares of the work left that vertices and the first of several passes are.
_TRIAL, _FIRST = 0.2, 0.4  # work: progress
# The effort of Automatic is small, so that a first click is fast.
_EFFORT = {
    SamplingMode.VERTICES: Effort(0, 0.0, 0.0, 0.0),
    SamplingMode.SURFACE: Effort(1, 1.0, 1.0, 1.0),
    SamplingMode.AUTOMATIC: Effort(2, 1.0, 0.5, 0.0625),
    SamplingMode.ADAPTIVE: Effort(4, 0.25, 0.0625, 0.0625),
}


@dataclass(frozen=True, eq=False)
class Plan:
    """A decision about the samples of an input."""

    given: Input
    sides: Sides  # The source that will decide between inside and outside
    why: str  # Why the vertices, or samples of the faces
    of_faces: bool  # Samples of the faces, and not the vertices
    first: Amount
    effort: Effort
    # A sphere of further points surrounds the samples, which gives every sample an outer pole
    has_sphere: bool
    closes_openings: bool  # Samples close the openings of the faces
    compares: bool  # Automatic sees to the topology, for a level is wanted
    is_trial: bool = False  # Vertices that do not show the shape give way to samples of its faces
    is_sparse: bool = False  # The faces are sampled because their vertices are too few


def decide(given: Input) -> Plan:
    """Plan what is analysed first: the vertices, as a trial where samples of the faces may show more, or samples."""
    shape, wanted = given.shape, given.settings.sampling
    if wanted is SamplingMode.VERTICES:
        return _of_vertices(given, "as chosen")
    if not len(shape.triangles):
        check_faces(shape, wanted)
        return _of_vertices(given, "there are no faces")
    if wanted is not SamplingMode.AUTOMATIC:
        return decide_on_faces(given, "as chosen")
    if not shape.of_samples:
        return decide_on_faces(given, "the object has no vertices of its own")
    if _by_open_faces(given):
        return decide_on_faces(given, "the mesh is open, and samples close its openings")
    return _of_vertices(given, "dense enough", is_trial=True)


def decide_on_faces(given: Input, why: str, is_sparse: bool = False) -> Plan:
    """Plan samples of the faces."""
    shape = given.shape
    check_not_flat(shape)
    sides = resolve_sides_of_samples(
        given.settings.sides, shape, shape.open_edges, given.first.spacing
    )
    check_not_a_sheet(sides, given.settings.side, shape.open_edges)
    if shape.left_out.all():
        raise none_left(shape)
    return _plan(given, sides, why, given.first, of_faces=True, is_sparse=is_sparse)


def _of_vertices(given: Input, why: str, is_trial: bool = False) -> Plan:
    first = Amount(len(given.shape.points), 0.0, _TRIAL if is_trial else 1.0)
    sides = _sides_of_vertices(given)
    if sides.source is SidesFrom.SURFACE and given.shape.left_out.all():
        if is_trial:
            check_not_flat(given.shape)
        raise none_left(given.shape)
    return _plan(given, sides, why, first, of_faces=False, is_trial=is_trial)


def _plan(
    given: Input, sides: Sides, why: str, first: Amount, *, of_faces: bool, **kind: bool
) -> Plan:
    settings = given.settings
    effort, by_surface = _EFFORT[settings.sampling], sides.source is SidesFrom.SURFACE
    if of_faces:
        first = replace(first, share=1.0 if effort.passes == 1 else _FIRST)
    is_level = settings.side is Side.INNER and settings.form is not Form.PUBLISHED
    return Plan(
        given=given,
        sides=replace(sides, reason=given.wrap or sides.reason),
        why=why,
        of_faces=of_faces,
        first=first,
        effort=effort,
        has_sphere=settings.side is not Side.INNER,
        closes_openings=of_faces and by_surface and given.shape.open_edges > 0,
        compares=settings.sampling is SamplingMode.AUTOMATIC and is_level,
        **kind,
    )


def _by_open_faces(given: Input) -> bool:
    """Return whether open faces decide what is inside, unless they are a sheet: no other source was chosen or given."""
    shape, wanted = given.shape, given.settings.sides
    is_given = shape.normals is not None and bool(shape.normals.any())
    return wanted is SidesFrom.AUTOMATIC and shape.open_edges > 0 and not is_given


def _sides_of_vertices(given: Input) -> Sides:
    shape, settings = given.shape, given.settings
    gaps = shape.open_edges
    if _by_open_faces(given):
        sides = resolve_sides_of_samples(settings.sides, shape, gaps, given.first.spacing)
        if sides.source is SidesFrom.NORMALS:
            check_not_flat(shape)
        check_not_a_sheet(sides, settings.side, gaps)
        if sides.source is SidesFrom.SURFACE:
            return sides
    return resolve_sides(settings.sides, shape.triangles, gaps, shape.normals)
