# SPDX-License-Identifier: GPL-3.0-or-later
"""The place where the samples of a surface are most in doubt, for people who look for the cause."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..shape.nearness import nearest
from ..shape.shape import Shape
from ..small_matrices import placed
from .analysed import AnalysedSamples

_LOOKED_AT = 500  # doubts are compared with each other, so of many an even selection is
_AROUND = 4.0  # doubts within this number of spacings belong together; chosen: unseen


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


def worst_doubt(shape: Shape, samples: AnalysedSamples, places: Floats) -> WorstDoubt | None:
    """Return the doubt with the most others within some spacings, the first of equal ones; None if there is none.

    Parameters
    ----------
    shape : Shape
    samples : AnalysedSamples
        Samples of faces.
    places : (k, 3) float64
        As `_medial.MedialAnalysis.doubts` returns them.
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
