# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy of an analysis, kept for the thresholds that were used last (docs/hierarchy.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..machine import native

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from ..settings import Settings
    from .solid_faces import SolidFaces


class Levels:
    """The hierarchy of an analysis for the newest thresholds: computed when it is first needed, extracted often."""

    def __init__(self) -> None:
        self._newest: tuple[tuple[Any, ...], Any] | None = None
        self._of_newest: tuple[Any, dict[str, Any]] = None, {}

    @property
    def bytes(self) -> int:
        """The memory that the hierarchy takes."""
        newest = self._newest
        return 0 if newest is None else int(newest[1].bytes)

    def kept(self, name: str, hierarchy: Any, make: Callable[[Any], Any]) -> Any:
        """Return what `make` makes of a hierarchy, made once as long as the hierarchy is the newest one."""
        of, found = self._of_newest
        if of is not hierarchy:
            found = {}
            self._of_newest = hierarchy, found
        if name not in found:
            found[name] = make(hierarchy)
        return found[name]

    def hierarchy(
        self,
        analysis: Any,
        settings: Settings,
        progress: Any | None,
        bodies: int | None = None,
        solid: SolidFaces | None = None,
        partners: NDArray[np.int32] | None = None,
        places: bool = False,
    ) -> Any:
        """Return the `_medial.Hierarchy` of an analysis, which must always be the same one.

        Another thread may ask for other thresholds at the same time, so `_newest` is read once.

        Parameters
        ----------
        analysis : _medial.MedialAnalysis
        settings : Settings
            Only `theta`, `rho`, `rule` and `criteria` matter, and for crisp places `sharp_angle` and `smooth`.
        progress : _medial.Progress or None
        bodies : int, optional
            The number of bodies of the solid, always the same one; crumbs of the sampling are left out until no more
            pieces are left.
        solid : SolidFaces, optional
            The faces that give crisp places, always the same ones; without them there are none.
        partners : (n,) int32, optional
            As in `AnalysedSamples`, always the same ones.
        places : bool
            Whether the vertices of the hierarchy need crisp places, which take long.

        Raises
        ------
        OutOfMemoryError, Cancelled
        """
        faces = () if solid is None else solid.options(settings)
        thresholds = (settings.theta, settings.rho, settings.rule, settings.criteria, *faces)
        places = places and solid is not None
        newest = self._newest
        if newest is not None and newest[0] == thresholds and (len(newest[1].place) or not places):
            return newest[1]
        self._of_newest = None, {}
        newest = self._newest = None  # frees its memory before another hierarchy takes as much
        with native.own_errors() as module:
            hierarchy = analysis.hierarchy(
                settings.theta,
                settings.rho,
                getattr(module.Rule, settings.rule.name),
                getattr(module.Criteria, settings.criteria.name),
                module.Side.INNER,
                bodies=bodies,
                faces=None if solid is None else solid.of_module(module, settings),
                partners=partners,
                places=places,
                progress=progress,
            )
        self._newest = thresholds, hierarchy
        return hierarchy
