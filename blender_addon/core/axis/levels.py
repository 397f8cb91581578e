# SPDX-License-Identifier: GPL-3.0-or-later
"""Clean forms and curves: levels of the hierarchy of analysed samples (docs/hierarchy.md).

Settings in percent become shares of the diagonal here, and values of the hierarchy become percent.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..curves.depth import Depth
from ..machine import native
from ..machine.cache import CACHE, bytes_of
from ..machine.progress import Progress
from ..samples.analysed import Analysed
from ..settings import Form, Mesh, Settings
from .crumbs import crumb_sizes
from .detail import with_detail
from .medial_axis import IN_CORNER, INNER, ON_CREASE, LevelValues, MedialAxis
from .slider_range import SliderRange, gap_of, ranges_of, shown_areas
from .smooth_curve import smooth_curve
from .structure import structure_of


def hierarchy_of(
    samples: Analysed, settings: Settings, progress: Any | None, places: bool = False
) -> Any:
    """Return the `_medial.Hierarchy` of analysed samples; the cache learns that they have grown.

    Parameters
    ----------
    samples : Analysed
    settings : Settings
        Only `theta`, `rho`, `rule` and `criteria` matter, and `crisp` with `sharp_angle` and `smooth`.
    progress : _medial.Progress or None
    places : bool
        Whether its vertices need crisp places, where the faces give any; even meshes have their own.
    """
    bodies = 1 if samples.by_faces is None else samples.by_faces[0]
    solid = samples.solid if settings.crisp else None
    hierarchy = samples.kept.levels.hierarchy(
        samples.analysis, settings, progress, bodies, solid, samples.partners, places
    )
    CACHE.resize(samples.kept.key, bytes_of(samples))
    return hierarchy


def extract_level(
    samples: Analysed, settings: Settings, progress: Progress | None, relaxed: bool = True
) -> MedialAxis:
    """Extract the axis in the form CLEAN or CURVE: with smooth curves if it is relaxed, else facets at crisp places."""
    wanted = _wanted(settings)
    hierarchy = hierarchy_of(samples, settings, progress and progress.part(0.4), not relaxed)
    shown = hierarchy
    if relaxed and settings.form is not Form.CURVE and settings.mesh is Mesh.EVEN:
        shown = samples.kept.levels.even(hierarchy, settings, progress and progress.part(0.8))
        CACHE.resize(samples.kept.key, bytes_of(samples))
    with native.own_errors():
        level = shown.extract(**wanted, relaxed=relaxed, progress=progress and progress.part())
    ranges, gap = samples.kept.levels.kept("sliders", shown, _of_sliders)
    axis = MedialAxis(
        vertices=level.vertices,
        radius=level.radius,
        face_offsets=level.face_offsets,
        face_vertices=level.face_vertices,
        theta=level.theta,
        rho=level.rho,
        side=np.full(len(level.generators), INNER, np.int32),
        generators=level.generators,
        unbounded=0,
        zero_area=level.hidden,
        edges=level.wires,
        level=LevelValues(
            exact=level.exact,
            exact_radius=level.exact_radius,
            sheet=100 * level.sheet,
            erosion=100 * level.erosion,
            limb=100 * level.limb,
            betti=level.betti,
            place=_placing(level),
            crumb=crumb_sizes(level, samples),
            ranges=ranges,
            gap=gap,
        ),
        structure=structure_of(level, samples) if len(level.facet_of) else None,
    )
    if settings.form is Form.CURVE:
        axis = with_detail(axis, level, hierarchy, samples, settings.detail)
        if relaxed:
            axis = smooth_curve(axis, _depth(samples, hierarchy), partial(_inside, samples))
    return _held(axis, hierarchy) if len(axis.edges) else axis


def _held(axis: MedialAxis, hierarchy: Any) -> MedialAxis:
    """Return an axis whose wires have balls that the faces hold: detail and smooth lines weigh those of samples."""
    both = np.concatenate((axis.edges, axis.edges[:, ::-1]))
    start, end = both[np.argsort(both[:, 0], kind="stable")].T
    rows, first, count = np.unique(start, return_index=True, return_counts=True)
    vertices, radius = axis.vertices.copy(), axis.radius.copy()
    along = vertices[end[first + count - 1]] - vertices[end[first]]
    along[(count != 2) | np.isin(rows, axis.face_vertices)] = 0.0
    with native.own_errors():
        vertices[rows], radius[rows] = hierarchy.held_balls(vertices[rows], radius[rows], along)
    return replace(axis, vertices=vertices, radius=radius)


def _of_sliders(hierarchy: Any) -> tuple[dict[str, SliderRange], float | None]:
    """Return the ranges of the sliders, and the gap between sheets, which weigh the same areas."""
    area = shown_areas(hierarchy)
    return ranges_of(hierarchy, area), gap_of(hierarchy, area)


def _depth(samples: Analysed, hierarchy: Any) -> Depth:
    """Return the distances from the faces that decide what is inside, or else from the samples."""
    shape = None if samples.solid is None else samples.solid.shape
    depth: Depth = samples.kept.levels.kept("depth", hierarchy, lambda _: Depth(samples, shape))
    return depth


def _inside(samples: Analysed, places: Floats) -> Flags:
    """Return whether places are in the solid, (n,); all of them where no faces decide."""
    if samples.solid is None:
        return np.ones(len(places), np.bool_)
    shape = samples.solid.shape
    with native.own_errors() as module:
        return np.asarray(module.winding_number(places, shape.points, shape.triangles)) > 0.5


def _placing(level: Any) -> Ints:
    """Return (v,) `LevelValues.place`: vertices that are on no facet are fitted to the samples, but for ends of curves.

    A curve ends with radius 0 in the tip of a cone, or on a sharp edge.
    """
    place = np.zeros(len(level.vertices), np.int32)
    facets = np.unique(level.face_vertices)
    ends = np.flatnonzero(level.radius == 0.0)
    place[ends] = IN_CORNER
    place[ends[level.place[ends] == ON_CREASE]] = ON_CREASE
    place[facets] = level.place[facets]
    return place


def _wanted(settings: Settings) -> dict[str, Any]:
    """Return the arguments of `_medial.Hierarchy.extract`."""
    limb = settings.limb / 100
    if settings.form is Form.CURVE:
        return {"sheet": math.inf, "limb": limb, "crisp": settings.crisp}
    return {
        "crisp": settings.crisp,
        "spacings": 1.0,
        "sheet": settings.simplify / 100,
        "erosion": settings.erode / 100,
        "spike": settings.spike / 100,
        "limb": limb,
        "round_limbs": True,
    }
