# SPDX-License-Identifier: GPL-3.0-or-later
"""The topology that samples show, and the places where it is in doubt (`_medial.MedialAnalysis.doubts`)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Floats
from ..machine import native
from ..settings import Settings
from ..shape.nearness import nearest
from ..shape.shape import Shape
from ..shape.solid_faces import SolidFaces
from ..small_matrices import placed
from .analysed import Analysed
from .density import REACH

_LOOKED_AT = 500  # doubts are compared with each other, so of many an even selection is
_AROUND = 4.0  # doubts within this number of spacings belong together; chosen: unseen


@dataclass(frozen=True, eq=False)
class Topology:
    """The topology that samples show."""

    betti: tuple[int, int, int]  # Pieces, loops and cavities of the solid
    places: Floats  # (k, 3) Places of doubt, if the numbers differ from those of the faces
    gaps: Floats  # (k,)


def no_doubts() -> tuple[Floats, Floats]:
    return np.zeros((0, 3)), np.zeros(0)


def doubts_of(shape: Shape, samples: Analysed, progress: Any) -> tuple[Floats, Floats]:
    """Return `Topology.places` and `gaps` of samples of the faces of a shape."""
    assert samples.apart is not None
    with native.own_errors():
        found: tuple[Floats, Floats] = samples.analysis.doubts(
            shape.points,
            shape.triangles[shape.unfolded],
            samples.normals,
            REACH * samples.apart,
            progress=progress,
        )
    return found


def betti_of(
    samples: Analysed, settings: Settings, progress: Any, solid: SolidFaces | None = None
) -> tuple[int, int, int]:
    """Count `Topology.betti` on the hierarchy, which stays with the samples; crisp places take long."""
    assert samples.by_faces is not None
    hierarchy = samples.kept.levels.hierarchy(
        samples.analysis, settings, progress, samples.by_faces[0], solid, samples.partners
    )
    pieces, loops, cavities = hierarchy.betti
    return pieces, loops, cavities


@dataclass(frozen=True)
class WorstDoubt:
    """A place of doubt with many others near, in the world, and the distance of neighbouring samples there."""

    place: tuple[float, float, float]
    apart: float

    @property
    def words(self) -> str:
        """The place as '(1, 2.5, -3)'."""
        return words_of_place(self.place)


def words_of_place(place: Iterable[float]) -> str:
    """Format a place as '(1, 2.5, -3)'."""
    return f"({', '.join(f'{x:.4g}' for x in place)})"


def worst_doubt(shape: Shape, samples: Analysed, places: Floats) -> WorstDoubt | None:
    """Return the doubt with the most others within some spacings, the first of equal ones; None if there is none.

    The samples are those of faces, the (k, 3) places as `_medial.MedialAnalysis.doubts` returns them.
    """
    if not len(places):
        return None
    assert samples.apart is not None
    some = places[np.unique(np.linspace(0, len(places) - 1, _LOOKED_AT).astype(np.intp))]
    apart = samples.apart[nearest(some, samples.points)]
    ways = np.linalg.norm(some[:, None] - some, axis=2)
    row = int((ways <= _AROUND * apart[:, None]).sum(axis=1).argmax())
    x, y, z = placed(some[row : row + 1], shape.frame)[0]
    return WorstDoubt((float(x), float(y), float(z)), float(apart[row]))
