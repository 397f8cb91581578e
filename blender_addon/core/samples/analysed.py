# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain data of an analysis: the request, the decision between inside and outside, and the analysed samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import OPTIONS, Settings, SidesFrom
from ..shape.shape import Shape
from ..shape.solid_faces import SolidFaces
from .density import Density
from .levels import Levels
from .walls import Walls


@dataclass(frozen=True)
class Sides:
    """The source that decides between inside and outside, and the reason, for people.

    Parameters
    ----------
    source : SidesFrom
        AUTOMATIC is left only where points alone must decide: their analysis chooses (`sides.decided`).
    reason : str
    is_chosen : bool
        The user wanted this source.
    """

    source: SidesFrom
    reason: str
    is_chosen: bool = False

    def __str__(self) -> str:
        return f"Inside from {OPTIONS['sides'].items[self.source][0]}: {self.reason}"


@dataclass(frozen=True, eq=False)
class Request:
    """A shape to analyse, and how to analyse it.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress
    limit : MemoryLimit
    gaps : int
        The number of edges at which the faces of the shape are open.
    bounding_sphere : bool
        The samples are surrounded by a sphere of further points, which give every sample an outer pole.
    levels : bool
        The hierarchy will be needed, so it may as well be computed while samples are chosen.
    """

    shape: Shape
    settings: Settings
    progress: Progress
    limit: MemoryLimit
    gaps: int
    bounding_sphere: bool
    levels: bool = False


@dataclass(frozen=True, eq=False)
class AnalysedSamples:
    """Points, the properties of the surface at each of them, and their analysis.

    Parameters
    ----------
    points : (n, 3) float64
    kinds : (n,) int32 or None
        Values of `_medial.SampleKind`; None where the points are vertices.
    normals : (n, 3) float64 or None
        Outward normals of the surface at the points.
    analysis : _medial.MedialAnalysis
    density : Density
    spacing : float
        The distance of neighbours in the first pass of samples; 0.0 where the points are vertices.
    buried : int
        The number of samples that were left out because the surface there bounds nothing.
    closing : int
        The number of points that close openings of the surface.
    walls : Walls or None
        How thin the shape is there; None where there are no faces to measure.
    rows : (n,) int32 or None
        The rows of the whole cloud that were analysed; None where all of them were, and for samples of faces.
    key : str
        The name of these samples in the cache.
    by_faces : tuple of int or None
        Pieces, loops and cavities of the solid, counted from its closed faces; None where that is not possible.
    levels : Levels
        The hierarchy, once a form has needed it.
    faces : (n,) int32 or None
        The triangle of the shape on which each sample lies; -1 for a sample that closes an opening.
    solid : SolidFaces or None
        The faces that bound the solid, if they decide what is inside.
    patches : (n, 2) int32 or None
        The patches between sharp convex edges on which each sample lies, as of `_medial.surface_patches`; None where
        there are no faces.
    apart : (n,) float64 or None
        The wanted distance of neighbours at each sample; None where the points are vertices.
    partners : (n,) int32 or None
        The row of the sample on the opposite wall, or -1; None where samples were not taken in pairs.
    offset : float
        How far outside of the surface that is meant the samples lie; radii are less by this.
    """

    points: Floats
    kinds: Ints | None
    normals: Floats | None
    analysis: Any
    density: Density
    spacing: float = 0.0
    buried: int = 0
    closing: int = 0
    walls: Walls | None = None
    rows: Ints | None = None
    key: str = ""
    by_faces: tuple[int, int, int] | None = None
    levels: Levels = field(default_factory=Levels)
    faces: Ints | None = None
    solid: SolidFaces | None = None
    patches: Ints | None = None
    apart: Floats | None = None
    partners: Ints | None = None
    offset: float = 0.0

    @property
    def walls_to_show(self) -> Walls | None:
        """The walls between which finer samples show more of the axis.

        None where parts overlap: the nearest walls are then slivers between the parts, and finer sampling only adds
        spurious bits of axis.
        """
        return None if self.buried else self.walls

    @property
    def bytes(self) -> int:
        """The memory that these samples, their analysis and its hierarchy take."""
        density = self.density
        own = (
            self.points,
            self.kinds,
            self.normals,
            self.rows,
            self.faces,
            self.patches,
            self.apart,
            self.partners,
        )
        others = (density.points, density.spacing, density.feature_size, density.edges)
        walls = self.walls
        more: tuple[NDArray, ...] = ()
        if walls:
            more = (walls.points, walls.distance, walls.spacing, walls.area, walls.faces)
        solid = () if self.solid is None else self.solid.arrays
        kept = {id(x): x for x in (*own, *others, *more, *solid) if x is not None}
        arrays = kept.values()
        return int(self.analysis.bytes) + self.levels.bytes + sum(x.nbytes for x in arrays)
