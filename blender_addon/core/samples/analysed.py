# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain data of a pass: the decision between inside and outside, samples, and samples with their analysis."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..settings import OPTIONS, SidesFrom
from ..shape.solid_faces import SolidFaces
from ..shape.triangles import FEW
from .density import HOLE, Density
from .levels import Levels
from .walls import Places, Walls

# Spacings of vertices are measured, and may be as large as the solid at sharp edges; this multiple of the median is
# the largest one that counts.
_LARGEST = 3.0  # chosen: unseen


@dataclass(frozen=True)
class Sides:
    """The source that decides between inside and outside, and the reason, for people."""

    # AUTOMATIC is left only where points alone must decide: their analysis chooses (`sides.decided`)
    source: SidesFrom
    reason: str
    is_chosen: bool = False  # The user wanted this source

    def __str__(self) -> str:
        return f"Inside from {OPTIONS['sides'].items[self.source][0]}: {self.reason}"


@dataclass(frozen=True, eq=False)
class Samples:
    """Points to analyse, and the properties of the surface at each of them."""

    points: Floats  # (n, 3)
    # (n,) Values of `_medial.SampleKind`; None where the points are vertices
    kinds: Ints | None = None
    normals: Floats | None = None  # (n, 3) Outward normals of the surface at the points
    # The distance of neighbours, once analysed that of the first pass; 0.0 where the points are vertices
    spacing: float = 0.0
    # The number of samples that were left out because the surface there bounds nothing
    buried: int = 0
    closing: int = 0  # The number of points that close openings of the surface; they come last
    # (n,) The rows of the whole cloud that were analysed; None where all of them were, and for samples of faces
    rows: Ints | None = None
    # (n,) The triangle of the shape on which each sample lies; -1 for a sample that closes an opening
    faces: Ints | None = None
    # (n,) The wanted distance of neighbours at each sample; None where the points are vertices
    apart: Floats | None = None
    # (n,) The row of the sample on the opposite wall, or -1; None where samples were not taken in pairs
    partners: Ints | None = None
    # How far outside of the surface that is meant the samples lie; radii are less by this
    offset: float = 0.0
    # (k,) The radius of the disc of each sample of a face; None once they are analysed, like `edges` and `places`
    radius: Floats | None = None
    # (m, 3) The points on edges and corners of the solid, where the feature size is 0
    edges: Floats | None = None
    # The flat faces below the samples, where opposite walls are looked for
    places: Places | None = None


@dataclass(frozen=True)
class Kept:
    """A name and hierarchies, which the cache keeps beside the results of an analysis."""

    key: str = ""  # The name in the cache
    levels: Levels = field(default_factory=Levels)  # The hierarchy, once a form has needed it


@dataclass(frozen=True, eq=False, kw_only=True)
class Analysed(Samples):
    """Samples and their analysis."""

    analysis: Any  # _medial.MedialAnalysis
    density: Density
    # How thin the shape is there; None where there are no faces to measure
    walls: Walls | None = None
    # Pieces, loops and cavities of the solid, counted from its closed faces; None where that is not possible
    by_faces: tuple[int, int, int] | None = None
    solid: SolidFaces | None = None  # The faces that bound the solid, if they decide what is inside
    # (n, 2) The patches between sharp convex edges on which each sample lies, as of `_medial.surface_patches`; None
    # where there are no faces
    patches: Ints | None = None
    # (k,) Of the samples whose density was measured, those between which and the opposite wall the axis is right
    # whatever the spacing; None where no walls were looked for
    plates: Flags | None = None
    kept: Kept = field(default_factory=Kept)

    @cached_property
    def neighbours(self) -> Floats:
        """The distance of neighbours at each sample, (n,); duplicates have 0."""
        if self.apart is not None:
            return self.apart
        spacing, found = np.zeros(len(self.points)), self.analysis.spacing * (1.0 / HOLE)
        spacing[self.analysis.samples] = np.minimum(found, _LARGEST * float(np.median(found)))
        return spacing

    @cached_property
    def overlaps(self) -> bool:
        """Whether parts of the surface bound nothing, so that the numbers of the faces mean nothing."""
        return self.buried > FEW * len(self.points)

    @cached_property
    def walls_are_close(self) -> bool:
        """Whether the axis is missing between walls that are close."""
        return not self.overlaps and self.walls is not None and self.walls.are_missed

    @property
    def walls_to_show(self) -> Walls | None:
        """The walls between which finer samples show more of the axis.

        None where parts overlap: the nearest walls are then slivers between the parts, and finer sampling only adds
        spurious bits of axis.
        """
        return None if self.buried else self.walls
