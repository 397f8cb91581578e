# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of what is analysed: the vertices or samples of the faces, what decides the inside, and how much effort."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..settings import Form, SamplingMode, Side, SidesFrom
from ..shape.check_faces import check_faces, check_not_a_sheet, check_not_flat, check_some_left
from .analysed import Sides
from .prepare import Input
from .sample_spacing import Amount
from .sides import resolve_sides, resolve_sides_of_samples


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
        return plan_of(given, "as chosen", of_faces=False)
    if not len(shape.triangles):
        check_faces(shape, wanted)
        return plan_of(given, "there are no faces", of_faces=False)
    if wanted is not SamplingMode.AUTOMATIC:
        return plan_of(given, "as chosen", of_faces=True)
    if not shape.of_samples:
        return plan_of(given, "the object has no vertices of its own", of_faces=True)
    if given.by_open_faces:
        why = "the mesh is open, and samples close its openings"
        return plan_of(given, why, of_faces=True)
    return plan_of(given, "dense enough", of_faces=False, is_trial=True)


def plan_of(
    given: Input, why: str, *, of_faces: bool, is_trial: bool = False, is_sparse: bool = False
) -> Plan:
    """Plan samples of the faces, or the vertices.

    Raises
    ------
    DegenerateInputError
        Faces are to decide what is inside, and bound nothing.
    """
    settings, shape, sides = given.settings, given.shape, _sides(given, of_faces)
    effort, by_surface = _EFFORT[settings.sampling], sides.source is SidesFrom.SURFACE
    if of_faces or by_surface:
        check_some_left(shape, settings.sampling)
    if of_faces:
        first = replace(given.first, share=1.0 if effort.passes == 1 else _FIRST)
    else:
        first = Amount(len(shape.points), 0.0, _TRIAL if is_trial else 1.0)
    is_level = settings.side is Side.INNER and settings.form is not Form.PUBLISHED
    return Plan(
        given=given,
        sides=replace(sides, reason=given.wrap or sides.reason),
        why=why,
        of_faces=of_faces,
        first=first,
        effort=effort,
        has_sphere=settings.side is not Side.INNER,
        closes_openings=of_faces and by_surface and shape.open_edges > 0,
        compares=settings.sampling is SamplingMode.AUTOMATIC and is_level,
        is_trial=is_trial,
        is_sparse=is_sparse,
    )


def _sides(given: Input, of_faces: bool) -> Sides:
    """Decide what tells inside from outside; without a choice the faces of a sheet do so for both sides alone."""
    shape, settings = given.shape, given.settings
    if of_faces:
        check_not_flat(shape)
    if of_faces or given.by_open_faces:
        sides = resolve_sides_of_samples(settings.sides, shape, given.first.spacing)
        if sides.source is SidesFrom.NORMALS and not sides.is_chosen:
            check_not_a_sheet(shape, settings.side)
        if of_faces or sides.source is SidesFrom.SURFACE:
            return sides
    return resolve_sides(settings.sides, shape.triangles, shape.open_edges, shape.normals)
