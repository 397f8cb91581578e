# SPDX-License-Identifier: GPL-3.0-or-later
"""Extraction of a medial axis from analysed samples: as published, or as a level of the hierarchy."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..machine import native
from ..machine.progress import Progress
from ..samples.analysed import Analysed
from ..settings import Form, Settings
from .levels import extract_level
from .medial_axis import AS_PUBLISHED, MedialAxis


def extract(
    samples: Analysed,
    settings: Settings,
    progress: Progress | None = None,
    relaxed: bool = True,
) -> MedialAxis:
    """Extract the axis that the settings select, in the form that they have for their side.

    Curves of the forms CLEAN and CURVE are smoothed if it is relaxed; else facets have crisp places.
    """
    if settings.form_of_side is Form.PUBLISHED:
        axis = _published(samples.analysis, settings, progress and progress.part())
    else:
        axis = extract_level(samples, settings, progress, relaxed)
    if samples.offset > 0.0:
        axis = _with_less_radius(axis, samples.offset)
    if samples.rows is None:
        return axis
    return replace(axis, generators=samples.rows[axis.generators])


def _with_less_radius(axis: MedialAxis, offset: float) -> MedialAxis:
    """Return the axis of samples that lie outside of the surface that is meant, with the radii up to that surface."""
    level = axis.level
    if level is not None:
        level = replace(level, exact_radius=np.maximum(level.exact_radius - offset, 0.0))
    structure = axis.structure and axis.structure.with_less_radius(offset)
    radius = np.maximum(axis.radius - offset, 0.0)
    return replace(axis, radius=radius, level=level, structure=structure)


def _published(analysis: Any, settings: Settings, progress: Any | None) -> MedialAxis:
    """Return the closure of the facets that the settings select; `progress` is a `_medial.Progress`."""
    with native.own_errors() as module:
        mesh = analysis.extract(
            settings.theta,
            settings.rho,
            getattr(module.Side, settings.side.name),
            getattr(module.Rule, settings.rule.name),
            getattr(module.Criteria, settings.criteria.name),
            limit_set=settings.limit_set,
            progress=progress,
        )
    return MedialAxis(**{name: getattr(mesh, name) for name in AS_PUBLISHED})
