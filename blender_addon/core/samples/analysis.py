# SPDX-License-Identifier: GPL-3.0-or-later
"""The analysis of samples: the one place where a `_medial.MedialAnalysis` is made."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..arrays import Flags, Ints, Longs
from ..machine import native
from ..machine.beside import Beside
from ..settings import SidesFrom
from ..shape.solid_faces import solid_faces
from .analysed import Analysed, Samples
from .decide import Plan
from .density import HOLE, LOOKED_AT, Density, estimate
from .surface_samples import are_paired
from .walls import Places, Walls, find_walls, middles_of_faces


def vertices_of(plan: Plan) -> Samples:
    """Return the vertices as samples."""
    shape = plan.given.shape
    return Samples(shape.points, normals=shape.normals, rows=shape.rows, offset=shape.offset)


def analyse(
    plan: Plan, samples: Samples, first: float, options: dict[str, Any], progress: Any
) -> Analysed:
    """Analyse samples.

    Parameters
    ----------
    plan : Plan
    samples : Samples
    first : float
        The spacing of the first pass.
    options : dict
        Arguments of `_medial.sample_surface`, with which the samples were taken.
    progress : _medial.Progress

    Raises
    ------
    DegenerateInputError
        The points span no volume.
    """
    shape, source = plan.given.shape, plan.sides.source
    with Beside(partial(_by_faces, plan, samples.places)) as beside:
        analysis = _analysis(plan, samples, progress)
        patches = _patches(plan, samples, options["sharp_angle"])
        density = _density(plan, samples, analysis, first)
    walls, by_faces = beside.result()
    plates = None
    if walls is not None and walls.rows is not None:
        plates = _on_plates(density, samples, analysis.samples, walls)
    flat = options["sharp_angle"] if plan.of_faces and not options["smooth"] else 0.0
    left = replace(samples, spacing=first, radius=None, edges=None, places=None)
    return Analysed(
        **vars(left),
        analysis=analysis,
        density=density,
        walls=walls,
        by_faces=by_faces,
        solid=solid_faces(shape, source, samples.faces, flat),
        patches=patches,
        plates=plates,
    )


def _analysis(plan: Plan, samples: Samples, progress: Any) -> Any:
    """Return the `_medial.MedialAnalysis`."""
    shape, source = plan.given.shape, plan.sides.source
    triangles = shape.triangles if source is SidesFrom.SURFACE else None
    separate = triangles is not None and plan.of_faces
    with native.own_errors() as module:
        return module.MedialAnalysis(
            samples.points,
            triangles,
            vertices=shape.points if separate else None,
            normals=samples.normals if source is SidesFrom.NORMALS else None,
            sides=getattr(module.SidesFrom, plan.sides.source.name),
            bounding_sphere=plan.has_sphere,
            progress=progress,
        )


def _density(plan: Plan, samples: Samples, analysis: Any, first: float) -> Density:
    points, limit, partners = samples.points, plan.given.settings.epsilon, samples.partners
    if samples.edges is None:
        return estimate(analysis, points, points[:0], 0.0, limit, most=LOOKED_AT)
    paired = None if partners is None else are_paired(partners)
    return estimate(analysis, points, samples.edges, first, limit, paired=paired)


def _on_plates(density: Density, samples: Samples, rows: Longs, walls: Walls) -> Flags:
    """(k,) which of the samples whose density was measured are on a plate; `rows` are these samples."""
    feature_size, found = np.zeros(len(samples.points)), np.zeros(len(samples.points), bool)
    feature_size[rows] = density.feature_size
    assert walls.rows is not None
    found[walls.plates(feature_size[walls.rows])] = True
    return found[rows]


def _patches(plan: Plan, samples: Samples, sharp_angle: float) -> Ints | None:
    """Return the patches of samples of the faces, or of the vertices, as `Analysed.patches`."""
    shape = plan.given.shape
    if not (plan.of_faces or plan.sides.source is SidesFrom.SURFACE):
        return None
    of_faces = (samples.points, samples.kinds, samples.faces)
    with native.own_errors() as module:
        _, found = module.surface_patches(
            shape.points,
            shape.triangles,
            samples=of_faces if plan.of_faces else None,
            sharp_angle=sharp_angle,
            sharp_edges=shape.sharp_edges,
        )
    return found


def _by_faces(
    plan: Plan, places: Places | None, progress: Any
) -> tuple[Walls | None, tuple[int, int, int] | None]:
    """Return what follows from the faces alone, computed in parallel with the analysis: walls, and the topology."""
    shape, source, walls = plan.given.shape, plan.sides.source, None
    by_surface = source is SidesFrom.SURFACE
    if (by_surface or (plan.of_faces and source is SidesFrom.NORMALS)) and shape.volume > 0:
        reach = 2.0 * HOLE / plan.given.settings.epsilon
        walls = find_walls(shape, places or middles_of_faces(shape), reach, progress)
    return walls, shape.solid_betti if by_surface and not shape.open_edges else None
