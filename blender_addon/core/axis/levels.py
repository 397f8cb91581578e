# SPDX-License-Identifier: GPL-3.0-or-later
"""Clean forms and curves: levels of the hierarchy of analysed samples (docs/hierarchy.md).

Percent become shares of the diagonal here, and the values of the hierarchy percent.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..settings import Form, Settings
from .medial_axis import LevelValues, MedialAxis

if TYPE_CHECKING:
    from ..machine.progress import Progress

_INNER = 1  # value of `_medial.Side`


class Levels:
    """The hierarchy of an analysis for the newest thresholds: computed when it is first needed, extracted often."""

    def __init__(self) -> None:
        self._newest: tuple[tuple[Any, ...], Any] | None = None

    @property
    def bytes(self) -> int:
        """The memory that the hierarchy holds."""
        return 0 if self._newest is None else int(self._newest[1].bytes)

    def hierarchy(self, analysis: Any, settings: Settings, progress: Any | None) -> Any:
        """The `_medial.Hierarchy` of an analysis, always the same one; `progress` is a `_medial.Progress`.

        Raises
        ------
        OutOfMemoryError, Cancelled
        """
        thresholds = (settings.theta, settings.rho, settings.rule, settings.criteria)
        if self._newest is None or self._newest[0] != thresholds:
            self._newest = None  # its memory goes before there is another
            with native.own_errors() as module:
                hierarchy = analysis.hierarchy(
                    settings.theta,
                    settings.rho,
                    getattr(module.Rule, settings.rule.name),
                    getattr(module.Criteria, settings.criteria.name),
                    module.Side.INNER,
                    progress=progress,
                )
            self._newest = thresholds, hierarchy
        return self._newest[1]


def extract_level(
    analysis: Any, levels: Levels, settings: Settings, progress: Progress | None
) -> MedialAxis:
    """The axis in the form CLEAN or CURVE.

    Raises
    ------
    OutOfMemoryError, Cancelled
    """
    hierarchy = levels.hierarchy(analysis, settings, progress and progress.part(0.9))
    with native.own_errors():
        level = hierarchy.extract(**_wanted(settings), progress=progress and progress.part())
    return MedialAxis(
        vertices=level.vertices,
        radius=level.radius,
        face_offsets=level.face_offsets,
        face_vertices=level.face_vertices,
        theta=level.theta,
        rho=level.rho,
        side=np.full(len(level.generators), _INNER, np.int32),
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
        ),
    )


def _wanted(settings: Settings) -> dict[str, Any]:
    """What `_medial.Hierarchy.extract` takes."""
    limb = settings.limb / 100
    if settings.form is Form.CURVE:
        return {"sheet": math.inf, "limb": limb, "relaxed": True}
    return {
        "spacings": 1.0,
        "sheet": settings.simplify / 100,
        "erosion": settings.erode / 100,
        "limb": limb,
        "relaxed": True,
        "round_limbs": True,
    }
