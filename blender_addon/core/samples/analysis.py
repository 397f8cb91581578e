# SPDX-License-Identifier: GPL-3.0-or-later
"""Points and their analysis: the one place where a `_medial.MedialAnalysis` is made, or found again in the cache."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ..axis.levels import Levels
from ..machine import native
from ..machine.cache import CACHE, key_of
from ..settings import Settings, Side, SidesFrom

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..machine.memory_limit import MemoryLimit
    from ..machine.progress import Progress
    from .density import Density
    from .shape import Shape
    from .sides import Sides
    from .walls import Walls


@dataclass(frozen=True, eq=False)
class AnalysedSamples:
    """Points, what is known of the surface at each of them, and their analysis.

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
        Samples that were left out because the surface there bounds nothing.
    closing : int
        Samples among the points that close openings of the surface.
    walls : Walls or None
        How thin the shape is there; None where no faces tell.
    rows : (n,) int32 or None
        The rows of the whole cloud that were analysed; None where all of them were, and for samples of faces.
    key : str
        The name of these samples in the cache.
    by_faces : tuple of int or None
        Pieces, loops and cavities of the solid, as its closed faces tell; None where they cannot.
    levels : Levels
        The hierarchy, once a form asked for it.
    faces : (n,) int32 or None
        The triangle of the shape that each sample of its faces lies on; -1: it closes an opening.
    """

    points: NDArray[np.float64]
    kinds: NDArray[np.int32] | None
    normals: NDArray[np.float64] | None
    analysis: Any
    density: Density
    spacing: float = 0.0
    buried: int = 0
    closing: int = 0
    walls: Walls | None = None
    rows: NDArray[np.int32] | None = None
    key: str = ""
    by_faces: tuple[int, int, int] | None = None
    levels: Levels = field(default_factory=Levels)
    faces: NDArray[np.int32] | None = None

    @property
    def walls_to_show(self) -> Walls | None:
        """The walls between which samples may be closer together. Where parts overlap there are none: the closest walls
        are slivers between parts, and the finer they are sampled the more crumbs of an axis come out of them."""
        return None if self.buried else self.walls

    @property
    def bytes(self) -> int:
        """The memory that these samples, their analysis and its hierarchy hold."""
        density = self.density
        own = (self.points, self.kinds, self.normals, self.rows, self.faces)
        others = (density.points, density.spacing, density.feature_size, density.edges)
        walls = self.walls
        more = (walls.points, walls.distance, walls.spacing, walls.area) if walls else ()
        arrays = [x for x in (*own, *others, *more) if x is not None]
        return int(self.analysis.bytes) + self.levels.bytes + sum(x.nbytes for x in arrays)


@dataclass(frozen=True, eq=False)
class Request:
    """What is to be analysed and how: a shape, the settings, a progress to report to, and the memory limit.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress
    limit : MemoryLimit
    gaps : int
        The number of edges at which the faces of the shape are open.
    """

    shape: Shape
    settings: Settings
    progress: Progress
    limit: MemoryLimit
    gaps: int

    @property
    def bounding_sphere(self) -> bool:
        """Whether the samples lie in a sphere of other points. It gives every sample an outer pole."""
        return self.settings.side is not Side.INNER

    @cached_property
    def solid_betti(self) -> tuple[int, int, int] | None:
        """Pieces, loops and cavities of the solid, as its closed faces tell; None where they cannot. The same for all
        passes."""
        with native.own_errors() as module:
            return module.solid_betti(self.shape.points, self.shape.triangles)


def analyse(
    request: Request,
    points: NDArray[np.float64],
    normals: NDArray[np.float64] | None,
    sides: Sides,
    progress: Any,
) -> Any:
    """The `_medial.MedialAnalysis` of points.

    Parameters
    ----------
    request : Request
    points : (n, 3) float64
        The vertices of the shape, or samples of its faces.
    normals : (n, 3) float64 or None
    sides : Sides
    progress : _medial.Progress

    Raises
    ------
    InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    shape = request.shape
    request.limit.check(len(points))
    triangles, normals = used_by_sides(sides, shape.triangles, normals)
    separate = triangles is not None and points is not shape.points
    with native.own_errors() as module:
        return module.MedialAnalysis(
            points,
            triangles,
            vertices=shape.points if separate else None,
            normals=normals,
            sides=getattr(module.SidesFrom, sides.source.name),
            bounding_sphere=request.bounding_sphere,
            progress=progress,
        )


def used_by_sides(
    sides: Sides, triangles: NDArray[np.int32], normals: NDArray[np.float64] | None
) -> tuple[NDArray[np.int32] | None, NDArray[np.float64] | None]:
    """Triangles and normals, each None unless they are what tells inside from outside."""
    return (
        triangles if sides.source is SidesFrom.SURFACE else None,
        normals if sides.source is SidesFrom.NORMALS else None,
    )


def betti_by_faces(request: Request, sides: Sides) -> tuple[int, int, int] | None:
    """`AnalysedSamples.by_faces`, where the faces are what tells inside from outside."""
    if sides.source is not SidesFrom.SURFACE or request.gaps:
        return None
    return request.solid_betti


def kept_or_made(
    request: Request, parts: tuple, make: Callable[[], AnalysedSamples]
) -> AnalysedSamples:
    """The samples from the cache; where it has none, they are made and kept there.

    Parameters
    ----------
    request : Request
    parts : tuple
        Everything that the samples depend on, besides the bounding sphere.
    make : callable
    """
    key = key_of(request.bounding_sphere, *parts)
    found = CACHE.get(key)
    if found is None:
        found = replace(make(), key=key)
        CACHE.put(key, found, found.bytes)
    return found
