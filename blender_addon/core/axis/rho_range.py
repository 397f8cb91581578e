# SPDX-License-Identifier: GPL-3.0-or-later
"""The range of Rho, which is a ratio: on most models it decides on facets between 1.5 and 16 only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..settings import Criteria, Rule
from .slider_range import slider_range

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..samples.analysed import AnalysedSamples
    from ..settings import Settings
    from .slider_range import SliderRange

_ENOUGH = 65_536  # so many facets tell the shares


def rho_range(
    samples: AnalysedSamples, settings: Settings, hierarchy: Any | None
) -> SliderRange | None:
    """Return the share, by number, of the facets that Theta does not keep and that go; None where none can go.

    Parameters
    ----------
    samples : AnalysedSamples
    settings : Settings
        `side`, `rule`, `criteria` and `theta` say which facets Rho decides on.
    hierarchy : _medial.Hierarchy or None
        None for an axis as published.
    """
    if settings.criteria is Criteria.ANGLE:
        return None
    rho, theta = _of_facets(samples, settings, hierarchy)
    if settings.criteria is Criteria.ANGLE_OR_RATIO:
        rho = rho[theta <= settings.theta]
    return slider_range(rho, np.ones(len(rho)))


def _of_facets(
    samples: AnalysedSamples, settings: Settings, hierarchy: Any | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return Rho and Theta of facets that can be selected on a side, which are kept."""
    kept, both = samples.kept_facets, settings.rule is Rule.BOTH
    key = settings.side, both, hierarchy is None
    if key not in kept:
        analysis = samples.analysis
        rows = (
            _tried(analysis, settings) if hierarchy is None else _of_hierarchy(analysis, hierarchy)
        )
        rho = analysis.rho_both if both else analysis.rho
        theta = analysis.theta_both if both else analysis.theta
        kept[key] = rho[rows], theta[rows]
    return kept[key]


def _tried(analysis: Any, settings: Settings) -> NDArray[np.integer]:
    with native.own_errors() as module:
        side = getattr(module.Side, settings.side.name)
        rows = analysis.select(0.0, 0.0, side, module.Rule.EITHER, module.Criteria.RATIO)
    return _some(rows[analysis.bounded[rows]])


def _of_hierarchy(analysis: Any, hierarchy: Any) -> NDArray[np.integer]:
    """Return the rows of facets of a hierarchy, which has all facets inside, so their side need not be found again."""
    edges, facets = analysis.edges, _some(hierarchy.generators)
    count = int(edges.max(initial=0)) + 1
    keys = edges[:, 0].astype(np.int64) * count + edges[:, 1]
    return np.searchsorted(keys, facets[:, 0].astype(np.int64) * count + facets[:, 1])


def _some(rows: NDArray[np.int32]) -> NDArray[np.int32]:
    return rows[:: max(1, len(rows) // _ENOUGH)].copy()
