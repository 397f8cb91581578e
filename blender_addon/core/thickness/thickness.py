# SPDX-License-Identifier: GPL-3.0-or-later
"""The thickness of a shape at every sample of its surface, or the width of the gaps between its walls."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import astuple, replace

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..axis.solid_warnings import solid_warnings
from ..machine import native
from ..machine.cache import CACHE, key_of
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.choose_samples import begin
from ..samples.chosen import ChosenSamples
from ..samples.density import percent
from ..samples.noise import noise_of
from ..samples.sides import resolve_sides
from ..samples.surface_normals import (
    SurfaceNormals,
    measured_surface,
    surface_normals,
)
from ..settings import Between, Edges, Form, Noise, SamplingMode, Settings, ThicknessSettings
from ..shape.nearness import sample_of_row
from ..shape.outward_faces import outward_shape, reading_warnings
from ..shape.shape import Shape
from ..shape.triangles import FEW, area_vectors, unit_vectors
from .bounded_lengths import MeasuredSurface, bounded
from .close_walls import close_walls, no_close_walls
from .face_lengths import MeasuredFaces, are_enough, lengths_by_faces
from .measurement import Measurement

# From this noise on, in spacings, the mode Clean measures too small lengths, and every mode measures wrong lengths.
_SOME, _TOO_MUCH = 0.05, 0.18  # chosen: unseen


def measure_thickness(
    shape: Shape,
    settings: Settings,
    wanted: ThicknessSettings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> Measurement:
    """Measure a shape by its faces, or where these do not enclose a solid by its axis, unless the cache has that.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        Its options of sampling and of inside and outside are used; the side follows from `wanted`.
    wanted : ThicknessSettings
    progress : Progress, optional
    limit : MemoryLimit
    """
    settings = replace(settings, side=wanted.side)
    start, progress, shape = time.perf_counter(), progress or Progress(), outward_shape(shape)
    key = _key_by_faces(shape, settings, wanted)
    if kept := kept_measurement(key):
        seconds = time.perf_counter() - start
        again = replace(kept, shape=shape, settings=wanted, seconds=seconds)
        return replace(again, warnings=(*reading_warnings(shape), *_warnings(again)))
    if are_enough(shape, settings, wanted):
        return _kept(replace(_by_faces(shape, settings, wanted, progress, start), key=key))
    return _kept(_by_axis(shape, settings, wanted, progress, limit))


def _key_by_faces(shape: Shape, settings: Settings, wanted: ThicknessSettings) -> str:
    """The name of a measurement by the faces, of all that it depends on."""
    return key_of(
        "thickness by faces",
        (
            shape.points,
            shape.triangles,
            shape.sharp_edges,
            shape.shaded_smooth,
            shape.of_samples,
            shape.single,
        ),
        astuple(settings),
        astuple(replace(wanted, limit=0.0)),
    )


def _kept(found: Measurement) -> Measurement:
    CACHE.put(found.key, found, found.bytes)
    return found


def _by_faces(
    shape: Shape, settings: Settings, wanted: ThicknessSettings, progress: Progress, start: float
) -> Measurement:
    surface, measured, row, cut = lengths_by_faces(shape, settings, wanted, progress)
    count = len(surface.points)
    reason = f"{count:,} places on the faces" if cut else f"The {count:,} vertices, by the faces"
    sides = resolve_sides(settings.sides, shape.triangles, 0, None)
    noise = 0.0
    if not cut:
        _, normals = area_vectors(surface.points, surface.triangles)
        noise = noise_of(surface.points, surface.triangles, unit_vectors(normals)[0])
    found = Measurement(
        shape=shape,
        chosen=MeasuredFaces(reason, sides, row),
        settings=wanted,
        surface=surface,
        measured=measured,
        normals="The normals are those of the faces",
        noise=noise,
        warnings=(),
        seconds=time.perf_counter() - start,
        walls=no_close_walls(shape),
    )
    return replace(found, warnings=(*reading_warnings(shape), *_warnings(found)))


def _by_axis(
    shape: Shape,
    settings: Settings,
    wanted: ThicknessSettings,
    progress: Progress,
    limit: MemoryLimit,
) -> Measurement:
    # A thickness needs no level, so Automatic need not see to the topology of one.
    begun = begin(shape, replace(settings, form=Form.PUBLISHED), progress, limit)
    shape, chosen = begun.shape, begun.chosen
    surface = measured_surface(shape, chosen)
    known = surface_normals(shape, chosen, surface, settings.sharp_angle)
    lengths, measured = _lengths(chosen, known, wanted, begun.progress)
    walls = close_walls(shape, chosen, lengths, wanted.between)
    plain = MeasuredSurface(
        points=chosen.samples.points,
        triangles=surface,
        lengths=lengths,
        at_edge=known.at_edge,
        faces=chosen.samples.faces,
        at_most=np.full(len(surface), np.inf),
    )
    found = Measurement(
        shape=shape,
        chosen=chosen,
        settings=wanted,
        surface=bounded(shape, chosen, plain, walls, wanted.edges),
        measured=measured,
        normals=known.source,
        noise=_noise(chosen, surface, known),
        warnings=(),
        seconds=begun.seconds,
        walls=walls,
        key=key_of(
            "thickness",
            chosen.samples.kept.key,
            astuple(settings),
            astuple(replace(wanted, limit=0.0)),
        ),
    )
    found = _up_to_faces(found)
    return replace(
        found,
        warnings=(
            *solid_warnings(shape, wanted.side, chosen.sides.source, chosen),
            *_warnings(found),
        ),
    )


def _up_to_faces(found: Measurement) -> Measurement:
    """Return lengths between the faces, inside of a wrap or outside of it, instead of those between its walls."""
    if not (more := _wider(found)):
        return found

    def widened(lengths: Floats) -> Floats:
        return np.maximum(lengths + more, 0.0)

    surface, walls = found.surface, found.walls
    return replace(
        found,
        surface=replace(
            surface,
            lengths=widened(surface.lengths),
            at_most=widened(surface.at_most),
        ),
        walls=replace(
            walls, distance=widened(walls.distance), at_vertices=widened(walls.at_vertices)
        ),
    )


def _wider(found: Measurement) -> float:
    """How much farther apart than the walls of a wrap its faces are."""
    gap = found.settings.between is Between.GAP
    return (2.0 if gap else -2.0) * found.shape.offset


def kept_measurement(key: str) -> Measurement | None:
    """Return a measurement that is still in memory, or None."""
    found = CACHE.get(key)
    return found if isinstance(found, Measurement) else None


def _lengths(
    chosen: ChosenSamples, known: SurfaceNormals, wanted: ThicknessSettings, progress: Progress
) -> tuple[Floats, Flags]:
    """(n,) the length at every row, and (n,) whether it was measured there."""
    analysis = chosen.samples.analysis
    scan = wanted.noise is Noise.SCAN
    with native.own_errors() as module:
        mode = "SCAN" if scan else "BALL" if wanted.edges is Edges.BALL else "WALL"
        found = analysis.thickness(
            None if scan else known.normals,
            edges=known.at_edge,
            mode=getattr(module.ThicknessMode, mode),
            side=getattr(module.Side, wanted.side.name),
            progress=progress.part(),
        )
    values, measured = found.values, found.measured
    if wanted.edges is Edges.GREY and not scan:
        values = np.where(measured, values, np.inf)
    rows = sample_of_row(chosen.samples.points, analysis.samples)
    return values[rows], measured[rows]


def _noise(chosen: ChosenSamples, surface: Ints, known: SurfaceNormals) -> float:
    """Measure the noise of vertices; samples that were laid on faces have none."""
    if chosen.sampling is not SamplingMode.VERTICES:
        return 0.0
    return noise_of(chosen.samples.points, surface, unit_vectors(known.normals)[0])


def _warnings(found: Measurement) -> Iterator[str]:
    if (more := _wider(found)) > 0.0:
        yield f"gaps are those between the faces: wider by {more:.3g} than between the walls of the wrap"
    elif more < 0.0:
        yield (
            f"thickness is that of the faces: less by {-more:.3g} than between the walls of the wrap; "
            "sheets have none"
        )
    if found.noise >= _TOO_MUCH:
        yield (
            "the points scatter by a fifth of their spacing or more: no figure is honest; smooth them "
            "first, or scan more finely"
        )
    elif not np.isfinite(found.minimum):
        yield _nothing(found)
    elif isinstance(found.chosen, ChosenSamples) and found.chosen.gaps and not found.measured.any():
        yield (
            "no two walls that face each other were found, so every length is that of the largest ball, which the lids "
            "of openings stop, too; close the openings where they should be"
        )
    if len(found.walls.distance):
        yield (
            f"at {percent(float(found.walls.share.sum()))} of the surface the walls are closer than the axis "
            f"shows, down to {found.walls.distance.min():.3g}; there the distance straight through the solid counts"
        )
    if found.slack > 0.0 and found.slack > FEW * (found.settings.limit or found.minimum):
        yield (
            f"coordinates so far from the origin are rounded by {found.slack:.2g}, and so is every length; move the "
            "shape to the origin where it is made"
        )
    if found.unmeasured > FEW:
        yield (
            f"at {percent(found.unmeasured)} of the surface no thickness could be measured; take more "
            "samples, or look at the place"
        )
    if _SOME < found.noise < _TOO_MUCH and found.settings.noise is Noise.CLEAN:
        yield (
            f"the points scatter by {percent(found.noise)} of their spacing, so that single figures are "
            "too small; choose Noise Scan"
        )


def _nothing(found: Measurement) -> str:
    if found.settings.between is Between.GAP:
        return "no two walls face each other across a gap"
    if found.settings.noise is Noise.SCAN:
        return "no ball is clear of the noise; choose Noise Clean, or scan more finely"
    return "no two walls that face each other were found; take more samples, or a smaller Spacing"
