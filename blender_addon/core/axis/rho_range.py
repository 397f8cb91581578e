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
    analysis, rows = samples.analysis, _rows(samples, settings, hierarchy)
    both = settings.rule is Rule.BOTH
    rho = (analysis.rho_both if both else analysis.rho)[rows]
    if settings.criteria is Criteria.ANGLE_OR_RATIO:
        theta = (analysis.theta_both if both else analysis.theta)[rows]
        rho = rho[theta <= settings.theta]
    return slider_range(rho, np.ones(len(rho)))


def _rows(
    samples: AnalysedSamples, settings: Settings, hierarchy: Any | None
) -> NDArray[np.integer]:
    """Return rows of the edges of the analysis whose facets can be selected on a side; they are kept."""
    kept = samples.kept_facets
    key = settings.side, hierarchy is None
    if key not in kept:
        rows = _tried(samples.analysis, settings) if hierarchy is None else None
        kept[key] = _of_hierarchy(samples.analysis, hierarchy) if rows is None else rows
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
