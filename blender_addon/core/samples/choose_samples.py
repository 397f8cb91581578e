# SPDX-License-Identifier: GPL-3.0-or-later
"""The choice of the points that are analysed: the vertices as they are, or dense enough samples of the faces.

This is the only file that looks for analyses in the cache and keeps new ones there.
"""

from __future__ import annotations

import time
from dataclasses import replace
from functools import partial
from typing import Any

from ..errors import DegenerateInputError, MemoryLimitError
from ..machine.cache import CACHE, key_of
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..settings import SamplingMode, Settings, Side, SidesFrom
from ..shape.check_faces import check_faces, check_not_flat
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from ..shape.sharp_angle import sharp_angle_of
from ..shape.wrapped_faces import without_wrap, wrap_reason, wrapped_shape
from .analysed import AnalysedSamples, Request, Sides
from .analysis import analyse_samples, analyse_vertices, used_by_sides
from .chosen import Begun, ChosenSamples
from .closing_samples import close_openings
from .density import percent
from .effort import EFFORT
from .mesh_parts import without_sheets
from .sample_spacing import FirstPass, first_pass, next_amount
from .scan import prepared
from .sides import check_not_a_sheet, decided, resolve_sides, resolve_sides_of_samples
from .surface_samples import sample_faces
from .thinning import fewer_samples, thinned_rows
from .topology_loop import are_close, closed, closes

_WRAPPING = 0.4  # of the analysis; work: progress
_PREPARING = 0.3  # of the analysis of points without faces; work: progress
# The budget counts as spent from this share on: all spacings are scaled to meet it, which is not exact.
_SPENT = 0.97  # work: progress


def begin(
    shape: Shape,
    settings: Settings,
    progress: Progress | None,
    limit: MemoryLimit,
    share: float = 1.0,
    levels: bool = False,
) -> Begun:
    """Begin a computation: turn the faces of a shape outward, choose samples and analyse them.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress or None
    limit : MemoryLimit
    share : float
        The share of the whole work that the analysis is.
    levels : bool
        The hierarchy will be needed.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    progress = progress or Progress()
    progress.until(share)
    given = shape
    if settings.sides is SidesFrom.WRAP:
        shape = wrapped_shape(shape, settings, progress.part(_WRAPPING))
        chosen = choose_samples(shape, without_wrap(settings), progress, limit, levels)
        sides = replace(chosen.sides, reason=wrap_reason(shape, settings))
        chosen = replace(chosen, sides=sides)
    else:
        given = outward_shape(shape)
        shape = without_sheets(given, settings)
        chosen = choose_samples(shape, settings, progress, limit, levels)
    progress.until(1.0)
    return Begun(shape, chosen, progress, start, given)


def choose_samples(
    shape: Shape,
    settings: Settings,
    progress: Progress,
    limit: MemoryLimit = WHAT_IS_FREE,
    levels: bool = False,
) -> ChosenSamples:
    """Choose and analyse samples of a shape.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress
    limit : MemoryLimit
    levels : bool
        As in `begin`.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    shape, scan = prepared(shape, settings, progress.part(_PREPARING))
    try:
        chosen = _choose(_request(shape, settings, progress, limit, levels))
    except MemoryLimitError as error:
        shape, settings, thinned = _thinned(shape, settings, limit, error)
        chosen = _choose(_request(shape, settings, progress, limit, levels))
        return replace(chosen, thinned=thinned, scan=scan)
    return replace(chosen, scan=scan)


def _request(
    shape: Shape, settings: Settings, progress: Progress, limit: MemoryLimit, levels: bool
) -> Request:
    sphere = settings.side is not Side.INNER
    return Request(shape, settings, progress, limit, shape.open_edges, sphere, levels)


def _thinned(
    shape: Shape, settings: Settings, limit: MemoryLimit, error: MemoryLimitError
) -> tuple[Shape, Settings, str]:
    """Return a shape and settings that fit into the limit, and a sentence about what was thinned."""
    if len(shape.triangles):
        first = first_pass(shape, settings).count
        return shape, *fewer_samples(shape, settings, first, limit, error)
    rows, sentence = thinned_rows(shape.points, limit, error)
    normals = None if shape.normals is None else shape.normals[rows]
    of_caller = rows if shape.rows is None else shape.rows[rows]
    thin = replace(shape, points=shape.points[rows], normals=normals, rows=of_caller)
    return thin, settings, sentence


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
    """Choose the vertices if they are dense enough and enclose a volume, or if samples would be no denser."""
    if _by_open_faces(request):
        return _samples_of_faces(request, "the mesh is open, and samples close its openings")
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
    first = first_pass(request.shape, request.settings)
    if not dense and density.is_improved_by(first.spacing):
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
    """Choose the vertices of the shape; their analysis is a `share` of the remaining work."""
    shape = request.shape
    sides = _sides_of_vertices(request)
    used = used_by_sides(sides.source, shape.triangles, shape.normals)
    edges = (shape.triangles, sharp_angle_of(shape, request.settings), shape.sharp_edges)
    divided = edges if sides.source is SidesFrom.SURFACE else None
    key = key_of(
        request.bounding_sphere,
        sides.source,
        shape.points,
        shape.rows,
        used,
        divided,
        shape.offset,
    )
    samples = CACHE.get(key)
    if samples is None:
        samples = _kept(key, analyse_vertices(request, sides, share))
    samples, sides = _judged(request, samples), decided(sides, samples.analysis)
    reason = _vertices_reason(request, why)
    return ChosenSamples(samples, SamplingMode.VERTICES, reason, sides, request.gaps)


def _by_open_faces(request: Request) -> bool:
    """Return whether open faces decide what is inside, unless they are a sheet: no other source was chosen or given."""
    shape, wanted = request.shape, request.settings.sides
    given = shape.normals is not None and bool(shape.normals.any())
    return wanted is SidesFrom.AUTOMATIC and request.gaps > 0 and not given


def _sides_of_vertices(request: Request) -> Sides:
    shape, settings = request.shape, request.settings
    if _by_open_faces(request):
        spacing = first_pass(shape, settings).spacing
        sides = resolve_sides_of_samples(settings.sides, shape, request.gaps, spacing)
        if sides.source is SidesFrom.NORMALS:
            check_not_flat(shape)
        check_not_a_sheet(sides, settings.side, request.gaps)
        if sides.source is SidesFrom.SURFACE:
            return sides
    return resolve_sides(settings.sides, shape.triangles, request.gaps, shape.normals)


def _vertices_reason(request: Request, why: str) -> str:
    return f"The {len(request.shape.points):,} vertices, {why}"


# --- samples of the faces


def _samples_of_faces(request: Request, why: str) -> ChosenSamples:
    """Choose even samples; then, for Adaptive and Automatic, make as many passes as are needed."""
    shape, settings = request.shape, request.settings
    check_not_flat(shape)
    first = first_pass(shape, settings)
    sides = resolve_sides_of_samples(settings.sides, shape, request.gaps, first.spacing)
    check_not_a_sheet(sides, settings.side, request.gaps)
    samples, passes = _passes(request, sides, first)
    closing = closes(request, sides)
    found = closed(request, samples, partial(_in_pairs, request, sides, first)) if closing else None
    if found is not None:
        reason = f"{len(found.samples.points):,} samples of the surface: {why}; {found}"
        return ChosenSamples(
            found.samples,
            SamplingMode.ADAPTIVE,
            reason,
            sides,
            request.gaps,
            differs=found.differs,
            worst=found.worst,
        )
    kind = SamplingMode.SURFACE if passes == 1 else SamplingMode.ADAPTIVE
    reason = f"{len(samples.points):,} samples of the surface: {why}"
    if passes > 1:
        reason += f"; closer together where it is thin, in {passes} passes"
    most = EFFORT[settings.sampling].passes
    if most > 1 and not samples.density.dense_enough and _is_spent(request, samples):
        reason += f", until the budget of {settings.budget:,} was spent"
    return ChosenSamples(samples, kind, reason, sides, request.gaps)


def _passes(request: Request, sides: Sides, first: FirstPass) -> tuple[AnalysedSamples, int]:
    """Return the samples of the last pass, and the number of passes."""
    settings, effort = request.settings, EFFORT[request.settings.sampling]
    share = 1.0 if effort.passes == 1 else 0.4
    samples, passes = _pass(request, sides, first.amount, share, first.count), 1
    if closes(request, sides) and are_close(samples):
        return samples, passes  # pairs see more between walls than smaller spacings
    while (
        passes < effort.passes
        and (not samples.density.dense_enough or _are_worth_more(request, samples))
        and not _is_spent(request, samples)
    ):
        request.progress.begin_pass(passes + 1)
        amount = next_amount(samples, effort.elsewhere, effort.walls, settings.budget)
        samples, passes = _pass(request, sides, amount, 0.6, spacing=samples.spacing), passes + 1
    request.progress.begin_pass(1)
    return samples, passes


def _in_pairs(
    request: Request, sides: Sides, first: FirstPass, amount: dict[str, Any] | None, flat: float
) -> AnalysedSamples:
    """One pass with pairs, on flat faces with edges from an angle `flat`; without an amount it is as a first pass."""
    settings = replace(request.settings, pairs=True)
    if flat:
        sharp = min(settings.sharp_angle, flat)
        settings = replace(settings, smooth=False, sharp_angle=sharp)
    request = replace(request, settings=settings)
    if amount is None:
        return _pass(request, sides, first.amount, 0.4, first.count)
    return _pass(request, sides, amount, 0.6, spacing=first.spacing)


def _pass(
    request: Request,
    sides: Sides,
    amount: dict[str, Any],
    share: float,
    count: int = 0,
    spacing: float = 0.0,
) -> AnalysedSamples:
    """One pass: the faces are sampled, openings are closed, and the samples are analysed and judged.

    Parameters
    ----------
    request : Request
    sides : Sides
    amount : dict
        The arguments of `_medial.sample_surface` that determine how many samples there are.
    share : float
        The share of the remaining work that this pass is.
    count : int
        The expected number of samples, which has to fit into the memory; 0 where the budget bounds it.
    spacing : float
        The spacing of the first pass; 0.0 in the first pass itself.
    """
    shape, settings, progress = request.shape, request.settings, request.progress
    options = {**_options(shape, settings), **amount}
    surface = (shape.points, shape.triangles, shape.sharp_edges, shape.offset)
    key = key_of(request.bounding_sphere, sides.source, surface, tuple(options.items()), spacing)
    found = CACHE.get(key)
    if found is None:
        if count:
            request.limit.check(count)
        closed = request.gaps > 0 and sides.source is SidesFrom.SURFACE
        part = progress.part(0.2 * share)
        samples = sample_faces(shape, options, request.gaps, closed, part)
        if closed:
            samples = close_openings(samples, shape, settings.seed, progress.part(0.1 * share))
        first = spacing or samples.spacing
        found = _kept(key, analyse_samples(request, sides, samples, first, share))
    return _judged(request, found)


def _options(shape: Shape, settings: Settings) -> dict[str, Any]:
    """Return the arguments of `_medial.sample_surface` that are the same in every pass."""
    options = {
        name: getattr(settings, name) for name in ("smooth", "keep_vertices", "pairs", "seed")
    }
    return {"sharp_angle": sharp_angle_of(shape, settings), **options}


def _are_worth_more(request: Request, samples: AnalysedSamples) -> bool:
    """Return whether the axis is missing between walls that are close, and the budget allows to change that."""
    walls = samples.walls_to_show
    return (
        walls is not None
        and walls.are_missed
        and walls.are_reached_by(request.settings.budget, request.shape.area)
    )


def _is_spent(request: Request, samples: AnalysedSamples) -> bool:
    """Return whether the budget allows no more samples."""
    return len(samples.points) >= _SPENT * request.settings.budget


# --- vertices and samples


def _kept(key: str, samples: AnalysedSamples) -> AnalysedSamples:
    """Put new samples into the cache."""
    samples = replace(samples, key=key)
    CACHE.put(key, samples, samples.bytes)
    return samples


def _judged(request: Request, samples: AnalysedSamples) -> AnalysedSamples:
    """Judge the density by the settings of the request: the cache may have kept the samples for another epsilon."""
    settings = request.settings
    finest = EFFORT[settings.sampling].at_edges * samples.spacing
    density = replace(samples.density, limit=settings.epsilon, finest=finest)
    return replace(samples, density=density)
