# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy of an analysis, kept for the thresholds that were used last (docs/hierarchy.md)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from weakref import WeakKeyDictionary

from ..arrays import Ints
from ..machine import native
from ..settings import Form, Mesh, Settings
from ..shape.solid_faces import SolidFaces


class Levels:
    """The hierarchy of an analysis for the newest thresholds: computed when it is first needed, extracted often."""

    def __init__(self) -> None:
        self._newest: tuple[tuple[Any, ...], Any] | None = None
        self._even: tuple[tuple[Any, ...], Any] | None = None
        self._selecting: tuple[tuple[Any, ...], Any] | None = None
        self._found: WeakKeyDictionary[Any, dict[str, Any]] = WeakKeyDictionary()

    @property
    def bytes(self) -> int:
        """The memory that the hierarchies take."""
        kept = (self._newest, self._even, self._selecting)
        return sum(int(one[1].bytes) for one in kept if one is not None)

    def kept(self, name: str, hierarchy: Any, make: Callable[[Any], Any]) -> Any:
        """Return what `make` makes of a hierarchy, made once as long as the hierarchy lives."""
        found = self._found.setdefault(hierarchy, {})
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
        partners: Ints | None = None,
        places: bool = False,
    ) -> Any:
        """Return the `_medial.Hierarchy` of an analysis, which must always be the same one.

        Another thread may ask for other thresholds at the same time, so `_newest` is read once.

        Parameters
        ----------
        analysis : _medial.MedialAnalysis
        settings : Settings
            Only `theta`, `rho`, `rule` and `criteria` matter, and for crisp places `sharp_angle` and `smooth`. Even
            meshes are made at the usual thresholds if those are higher.
        progress : _medial.Progress or None
        bodies : int, optional
            The number of bodies of the solid, always the same one; crumbs of the sampling are left out until no more
            pieces are left.
        solid : SolidFaces, optional
            The faces that give crisp places, always the same ones; without them there are none.
        partners : (n,) int32, optional
            As in `Analysed`, always the same ones.
        places : bool
            Whether the vertices of the hierarchy need crisp places, which take long.
        """
        faces = None if solid is None else solid.options(settings)
        theta, rho = (settings.theta, settings.rho) if places else _thresholds_of_mesh(settings)
        thresholds = (theta, rho, settings.rule, settings.criteria, faces)
        places = places and solid is not None
        newest = self._newest
        if newest is not None and newest[0] == thresholds and (len(newest[1].place) or not places):
            return newest[1]
        self._even = self._selecting = None
        newest = self._newest = None  # frees its memory before another hierarchy takes as much
        with native.own_errors() as module:
            hierarchy = analysis.hierarchy(
                theta,
                rho,
                getattr(module.Rule, settings.rule.name),
                getattr(module.Criteria, settings.criteria.name),
                module.Side.INNER,
                bodies=bodies,
                faces=solid and faces and solid.of_module(module, *faces),
                partners=partners,
                places=places,
                progress=progress,
            )
        self._newest = thresholds, hierarchy
        return hierarchy

    def even(self, hierarchy: Any, settings: Settings, progress: Any | None) -> Any:
        """Return the `_medial.Hierarchy` of the even mesh of a hierarchy, at the thresholds of the settings.

        The mesh is made again for limbs below the usual ones; all else is a level of the mesh.
        """
        limb = min(settings.limb, Settings().limb)
        level = {"limb": limb / 100, "crisp": settings.crisp}
        with native.own_errors():
            even = _kept(
                self._even,
                (hierarchy, *level.values()),
                lambda: hierarchy.even(**level, spacings=1.0, round_limbs=True, progress=progress),
            )
            self._even = even
            wanted = settings.theta, settings.rho
            if wanted == _thresholds_of_mesh(settings):
                return even[1]
            selecting = _kept(
                self._selecting, (even[1], *wanted), lambda: even[1].selecting(*wanted)
            )
            self._selecting = selecting
            return selecting[1]


def _kept(
    kept: tuple[tuple[Any, ...], Any] | None, key: tuple[Any, ...], make: Callable[[], Any]
) -> tuple[tuple[Any, ...], Any]:
    """Return what is kept, if it has this key, or else what `make` makes."""
    return kept if kept is not None and kept[0] == key else (key, make())


def _thresholds_of_mesh(settings: Settings) -> tuple[float, float]:
    """Return Theta and Rho for the facets of which an even mesh is made; what higher ones select is part of it."""
    if settings.form_of_side is not Form.CLEAN or settings.mesh is not Mesh.EVEN:
        return settings.theta, settings.rho
    usual = Settings()
    return min(settings.theta, usual.theta), min(settings.rho, usual.rho)
