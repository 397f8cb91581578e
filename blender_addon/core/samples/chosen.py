# SPDX-License-Identifier: GPL-3.0-or-later
"""The samples that a computation uses, the reasons for the choice, and the computation that continues from them."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..machine.progress import Progress
from ..settings import SamplingMode, SidesFrom
from ..shape.shape import Shape
from .analysed import Analysed, Sides
from .doubts import WorstDoubt
from .scan import Scan


@dataclass(frozen=True, eq=False)
class ChosenSamples:
    """The samples that are used, and why these."""

    samples: Analysed
    sampling: SamplingMode  # How the samples were made; never AUTOMATIC
    reason: str  # A sentence for people
    sides: Sides  # The source that decided between inside and outside, and why
    gaps: int  # The number of edges at which the faces are open
    # A sentence that explains why there are fewer samples than the settings ask for; or empty
    thinned: str = ""
    sparse: bool = False  # The faces were sampled because their vertices are too few
    # The topology of the samples differs from that of the faces, although more samples were taken to change that
    differs: bool = False
    worst: WorstDoubt | None = None  # Where these samples are most in doubt
    # The measures of points without faces, and what was done to them; None where there are faces
    scan: Scan | None = None

    @property
    def of_pairs(self) -> dict[str, bool]:
        """The settings of samples in pairs, which Automatic may have taken on the flat faces."""
        if self.samples.partners is None:
            return {}
        solid = self.samples.solid
        return {"pairs": True, "smooth": False} if solid and solid.flat else {"pairs": True}

    @cached_property
    def normals_look_inward(self) -> bool:
        """Whether normals decide what is inside, and those of the outermost samples along the axes point into it."""
        points, normals = self.samples.points, self.samples.normals
        if self.sides.source is not SidesFrom.NORMALS or normals is None:
            return False
        lowest, highest = points.argmin(axis=0), points.argmax(axis=0)
        lengths = np.maximum(np.linalg.norm(normals, axis=1), np.finfo(np.float64).tiny)
        low, high = (normals[rows, range(3)] / lengths[rows] for rows in (lowest, highest))
        return bool(high.sum() < low.sum())


class OfChosenSamples:
    """Gives a result that has `chosen` the number of samples it was computed from."""

    chosen: ChosenSamples

    @property
    def points(self) -> int:
        """The number of rows that were analysed, duplicates included."""
        return len(self.chosen.samples.points)

    @property
    def duplicates(self) -> int:
        """The number of these rows that were merged into an earlier row with the same coordinates."""
        return int(self.chosen.samples.analysis.duplicates)


@dataclass(frozen=True, eq=False)
class Begun:
    """A computation whose samples are analysed."""

    shape: Shape  # With faces that look outward
    chosen: ChosenSamples
    progress: Progress  # For the rest of the work
    start: float  # The time of `time.perf_counter` at which the computation began
    given: Shape  # The shape before its sheets were left out, or before it was wrapped

    @property
    def seconds(self) -> float:
        """The time since the computation began."""
        return time.perf_counter() - self.start
