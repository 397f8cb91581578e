# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis as arrays, and how it is extracted from analysed samples."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..settings import Settings
from .analysis import AnalysedSamples

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class MedialAxis:
    """The selected facets as convex planar polygons that share vertices, as `_medial.MedialMesh`.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
        Of the empty ball round each vertex, in the unit of the input.
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    theta : (f,) float64, radians
    rho : (f,) float64
    side : (f,) int32
        0 not known, 1 inner, 2 outer, 3 crossing.
    generators : (f, 2) int32
        Rows of the two samples of each facet; where only some points of a cloud were analysed, rows of
        the whole cloud.
    unbounded, zero_area : int
        Selected facets that reach infinity, or that are a point or a segment; neither is here.
    """

    vertices: NDArray[np.float64]
    radius: NDArray[np.float64]
    face_offsets: NDArray[np.int32]
    face_vertices: NDArray[np.int32]
    theta: NDArray[np.float64]
    rho: NDArray[np.float64]
    side: NDArray[np.int32]
    generators: NDArray[np.int32]
    unbounded: int
    zero_area: int

    @property
    def facets(self) -> int:
        """Number of polygons."""
        return len(self.face_offsets) - 1


def extract(samples: AnalysedSamples, settings: Settings, progress: Any | None) -> MedialAxis:
    """The facets that the settings select; `progress` is a `_medial.Progress`."""
    with native.own_errors() as module:
        mesh = samples.analysis.extract(
            settings.theta,
            settings.rho,
            getattr(module.Side, settings.side.name),
            getattr(module.Rule, settings.rule.name),
            getattr(module.Criteria, settings.criteria.name),
            limit_set=settings.limit_set,
            progress=progress,
        )
    axis = MedialAxis(**{name: getattr(mesh, name) for name in MedialAxis.__dataclass_fields__})
    if samples.rows is None:
        return axis
    return replace(axis, generators=samples.rows[axis.generators])
