# SPDX-License-Identifier: GPL-3.0-or-later
"""Which points are analysed: the vertices as they are, or samples of the faces that lie densely enough."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from ..errors import DegenerateInputError, MemoryLimitError
from ..machine import native
from ..machine.beside import Beside
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..settings import SamplingMode, Settings, SidesFrom
from .analysis import (
    AnalysedSamples,
    Request,
    analyse,
    betti_by_faces,
    kept_or_made,
    used_by_sides,
)
from .check_faces import check_faces, check_not_flat
from .density import LOOKED_AT, estimate, percent
from .sample_spacing import first_amount, first_count, first_spacing, next_amount
from .sides import Sides, decided, resolve_sides, resolve_sides_of_samples
from .surface_pass import surface_pass
from .thinning import fewer_samples, thinned_rows
from .walls import Walls, walls_of_faces

if TYPE_CHECKING:
    from ..machine.progress import Progress
    from .shape import Shape


@dataclass(frozen=True)
class _Effort:
    """How hard a choice of Sampling tries.

    Parameters
    ----------
    passes : int
        How often the faces are sampled at most.
    at_edges, elsewhere, walls : float
        The smallest spacing at sharp edges, elsewhere, and between walls where it takes that much to see the axis,
        as shares of the first pass's spacing.
    """

    passes: int
    at_edges: float
    elsewhere: float
    walls: float


# Automatic asks for little, so that a first click is fast.
_EFFORT = {
    SamplingMode.VERTICES: _Effort(0, 0.0, 0.0, 0.0),
    SamplingMode.SURFACE: _Effort(1, 1.0, 1.0, 1.0),
    SamplingMode.AUTOMATIC: _Effort(2, 1.0, 0.5, 0.0625),
    SamplingMode.ADAPTIVE: _Effort(4, 0.25, 0.0625, 0.0625),
}
# The budget counts as spent from this share on: it is met by scaling all spacings, which is not exact.
_SPENT = 0.97


@dataclass(frozen=True, eq=False)
class ChosenSamples:
    """The samples that are used, and why these.

    Parameters
    ----------
    samples : AnalysedSamples
    sampling : SamplingMode
        What was done; never AUTOMATIC.
    reason : str
        A sentence for people.
    sides : Sides
        What told inside from outside, and why.
    gaps : int
        The number of edges at which the faces are open.
    thinned : str
        Why there are fewer samples than the settings ask for, a sentence; or empty.
    sparse : bool
        The faces were sampled because their vertices are too few.
    """

    samples: AnalysedSamples
    sampling: SamplingMode
    reason: str
    sides: Sides
    gaps: int
    thinned: str = ""
    sparse: bool = False


class OfChosenSamples:
    """How many samples there are, for whatever was computed of them."""

    chosen: ChosenSamples

    @property
    def points(self) -> int:
        """Rows that were analysed, duplicates included."""
        return len(self.chosen.samples.points)

    @property
    def duplicates(self) -> int:
        """Those of them that were merged into an earlier row with the same coordinates."""
        return int(self.chosen.samples.analysis.duplicates)


def choose_samples(
    shape: Shape, settings: Settings, progress: Progress, limit: MemoryLimit = WHAT_IS_FREE
) -> ChosenSamples:
    """Choose and analyse samples of a shape.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress
    limit : MemoryLimit

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    try:
        return _choose(_request(shape, settings, progress, limit))
    except MemoryLimitError as error:
        shape, settings, thinned = _thinned(shape, settings, limit, error)
    return replace(_choose(_request(shape, settings, progress, limit)), thinned=thinned)


def _request(shape: Shape, settings: Settings, progress: Progress, limit: MemoryLimit) -> Request:
    with native.own_errors() as module:
        gaps = module.open_edges(shape.points, shape.triangles) if len(shape.triangles) else 0
    return Request(shape, settings, progress, limit, gaps)


def _thinned(
    shape: Shape, settings: Settings, limit: MemoryLimit, error: MemoryLimitError
) -> tuple[Shape, Settings, str]:
    """A shape and settings that fit into the limit, and a sentence that says what was thinned."""
    if len(shape.triangles):
        first = first_count(shape, settings)
        return shape, *fewer_samples(shape, settings, first, limit, error)
    rows, sentence = thinned_rows(shape.points, limit, error)
    normals = None if shape.normals is None else shape.normals[rows]
    return replace(shape, points=shape.points[rows], normals=normals, rows=rows), settings, sentence


def _choose(request: Request) -> ChosenSamples:
    wanted, shape = request.settings.sampling, request.shape
    if wanted is SamplingMode.VERTICES:
        return _vertices(request, "as chosen")
    check_faces(shape, wanted)
    if not len(shape.triangles):
        return _vertices(request, "there are no faces")
    if wanted is not SamplingMode.AUTOMATIC:
        return _samples_of_faces(request, "as chosen")
    if not shape.of_samples:
        return _samples_of_faces(request, "the object has no vertices of its own")
    return _whichever_is_dense(request)


def _whichever_is_dense(request: Request) -> ChosenSamples:
    """The vertices where they are dense enough and enclose something, or where samples would be no denser."""
    try:
        chosen = _vertices(request, "dense enough", 0.2)
    except DegenerateInputError:  # the faces may span a volume all the same
        reason = "the vertices alone span no volume"
        return replace(_samples_of_faces(request, reason), sparse=True)
    density, cocone = chosen.samples.density, chosen.samples.analysis.tight_cocone
    walls = chosen.samples.walls
    if walls is not None and walls.are_missed:
        return _samples_of_faces(request, "the walls are closer than the vertices are apart")
    dense = density.dense_enough
    if not dense and density.is_improved_by(first_spacing(request.shape, request.settings)):
        reason = (
            f"the vertices are too sparse, epsilon above {density.limit:g} at "
            f"{percent(density.share)} of them"
        )
        return replace(_samples_of_faces(request, reason), sparse=True)
    if cocone is not None and not cocone.encloses:
        return _samples_of_faces(request, "the vertices alone enclose nothing")
    if dense:
        return chosen
    return replace(chosen, reason=_vertices_reason(request, "as dense as samples would be"))


# --- vertices


def _vertices(request: Request, why: str, share: float = 1.0) -> ChosenSamples:
    """The vertices of the shape; their analysis is a `share` of the work that is left."""
    shape = request.shape
    sides = resolve_sides(request.settings.sides, shape.triangles, request.gaps, shape.normals)
    samples = kept_or_made(
        request,
        (
            *(sides.source.name, shape.points, shape.rows),
            *used_by_sides(sides, shape.triangles, shape.normals),
        ),
        lambda: _analysed_vertices(request, sides, share),
    )
    reason = _vertices_reason(request, why)
    samples, sides = _judged(request, samples), decided(sides, samples.analysis)
    return ChosenSamples(samples, SamplingMode.VERTICES, reason, sides, request.gaps)


def _vertices_reason(request: Request, why: str) -> str:
    return f"The {len(request.shape.points):,} vertices, {why}"


def _analysed_vertices(request: Request, sides: Sides, share: float) -> AnalysedSamples:
    points, normals = request.shape.points, request.shape.normals
    with Beside(partial(_of_faces, request, sides)) as beside:
        analysis = analyse(request, points, normals, sides, request.progress.part(share))
        no_edges, epsilon = points[:0], request.settings.epsilon
        density = estimate(analysis, points, no_edges, 0.0, epsilon, most=LOOKED_AT)
    walls, by_faces = beside.result()
    return AnalysedSamples(
        points,
        None,
        normals,
        analysis,
        density,
        walls=walls,
        rows=request.shape.rows,
        by_faces=by_faces,
    )


def _of_faces(
    request: Request, sides: Sides, progress: Any
) -> tuple[Walls | None, tuple[int, int, int] | None]:
    """What the faces tell without an analysis: `AnalysedSamples.walls` and `by_faces`."""
    walls = None
    if sides.source is SidesFrom.SURFACE and request.shape.volume > 0:
        walls = walls_of_faces(request.shape, progress)
    return walls, betti_by_faces(request, sides)


# --- samples of the faces


def _samples_of_faces(request: Request, why: str) -> ChosenSamples:
    """Even samples; then, for Adaptive and Automatic, as many passes as it takes."""
    shape, settings = request.shape, request.settings
    check_not_flat(shape)
    spacing = first_spacing(shape, settings)
    sides = resolve_sides_of_samples(settings.sides, shape, request.gaps, spacing)
    samples, passes = _passes(request, sides)
    kind = SamplingMode.SURFACE if passes == 1 else SamplingMode.ADAPTIVE
    reason = f"{len(samples.points):,} samples of the surface: {why}"
    if passes > 1:
        reason += f"; closer together where it is thin, in {passes} passes"
    most = _EFFORT[settings.sampling].passes
    if most > 1 and not samples.density.dense_enough and _is_spent(request, samples):
        reason += f", until the budget of {settings.budget:,} was spent"
    return ChosenSamples(samples, kind, reason, sides, request.gaps)


def _passes(request: Request, sides: Sides) -> tuple[AnalysedSamples, int]:
    """The samples of the last pass, and how many passes it took."""
    settings, effort = request.settings, _EFFORT[request.settings.sampling]
    share = 1.0 if effort.passes == 1 else 0.4
    amount = first_amount(request.shape, settings)
    samples, passes = _judged(request, surface_pass(request, sides, amount, share)), 1
    while (
        passes < effort.passes
        and (not samples.density.dense_enough or _are_worth_more(request, samples))
        and not _is_spent(request, samples)
    ):
        request.progress.begin_pass(passes + 1)
        amount = next_amount(samples, effort.elsewhere, effort.walls, settings.budget)
        found = surface_pass(request, sides, amount, 0.6, samples.spacing)
        samples, passes = _judged(request, found), passes + 1
    request.progress.begin_pass(1)
    return samples, passes


def _are_worth_more(request: Request, samples: AnalysedSamples) -> bool:
    """Whether the axis is missing between walls that are close, and the budget can do something about it."""
    walls = samples.walls_to_show
    return (
        walls is not None
        and walls.are_missed
        and walls.are_reached_by(request.settings.budget, request.shape.area)
    )


def _is_spent(request: Request, samples: AnalysedSamples) -> bool:
    """Whether the budget allows no more samples."""
    return len(samples.points) >= _SPENT * request.settings.budget


def _judged(request: Request, samples: AnalysedSamples) -> AnalysedSamples:
    """The samples with their density as the settings judge it; the cache may have kept them for another epsilon."""
    settings = request.settings
    finest = _EFFORT[settings.sampling].at_edges * samples.spacing
    density = replace(samples.density, limit=settings.epsilon, finest=finest)
    return replace(samples, density=density)
