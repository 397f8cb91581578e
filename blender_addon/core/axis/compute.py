# SPDX-License-Identifier: GPL-3.0-or-later
"""From an object to its medial axis: analysis and selection."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Floats, Ints
from ..machine.cache import CACHE
from ..machine.memory_limit import CURVE, WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.analysed import Sides
from ..samples.choose_samples import begin
from ..samples.chosen import ChosenSamples, OfChosenSamples
from ..samples.density import Density
from ..samples.rough_faces import SMOOTHING, smooth_faces
from ..settings import Form, Settings, SidesFrom
from ..shape.mesh_counts import MeshCounts, mesh_counts
from ..shape.shape import Shape
from .axis_warnings import axis_warnings
from .extract import extract
from .medial_axis import MedialAxis
from .topology import topology_sentence

# The share of the work before the hierarchy begins.
ANALYSIS = 0.6  # work: progress


@dataclass(frozen=True, eq=False)
class Computation(OfChosenSamples):
    """A medial axis and how it came about.

    Parameters
    ----------
    axis : MedialAxis
    settings : Settings
        `side`, `sides` and `sampling` are never AUTOMATIC here, and `form` is what the axis has.
    asked : Settings
        The settings that were given.
    chosen : ChosenSamples
        The analysed samples, the reasons for them, their density, and the decision between inside and outside.
    warnings : tuple of str
        A sentence for each assumption and each suspicious result.
    topology : str
        A sentence about the numbers of pieces, loops and cavities of the axis, and whether the faces agree. For an
        axis as published it is empty, or explains why the axis has no other form.
    seconds : float
    turned : int
        The number of faces that looked inward and were read the other way round.
    mesh : MeshCounts or None
        The numbers of faces and connected parts; None where there are no faces.
    origin : (3,) float64
        Where the frame lies in which the samples were analysed.
    """

    axis: MedialAxis
    settings: Settings
    asked: Settings
    chosen: ChosenSamples
    warnings: tuple[str, ...]
    topology: str
    seconds: float
    turned: int = 0
    mesh: MeshCounts | None = None
    origin: Floats = field(default_factory=lambda: np.zeros(3))

    def moved(self, by: Floats) -> Computation:
        """The computation with an axis that is moved out of the frame of the samples."""
        return replace(self, axis=self.axis.moved(by), origin=self.origin + by)

    @property
    def sides(self) -> Sides:
        """The source of the decision between inside and outside, and the reason."""
        return self.chosen.sides

    @property
    def density(self) -> Density:
        """The density of the samples, in the terms of the theorem."""
        return self.chosen.samples.density

    @property
    def missed(self) -> float | None:
        """The share of the surface whose walls are too close for the samples; None where there are no faces."""
        walls = self.chosen.samples.walls
        return None if walls is None else walls.missed

    @property
    def key(self) -> str:
        """The name of the analysis for `refilter`."""
        return self.chosen.samples.kept.key


def compute(
    points: Floats,
    triangles: Ints,
    settings: Settings,
    progress: Progress | None = None,
    normals: Floats | None = None,
) -> Computation:
    """Do the same as `compute_axis` for arrays."""
    return compute_axis(Shape(points, triangles, normals), settings, progress)


def compute_axis(
    shape: Shape,
    settings: Settings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
    relaxed: bool = True,
) -> Computation:
    """Compute the medial axis of a shape from its vertices or from samples of its faces.

    Parameters
    ----------
    shape : Shape
    settings : Settings
    progress : Progress, optional
    limit : MemoryLimit
        The memory that the analysis may need, and the reaction when it needs more.
    relaxed : bool
        Whether curves of the forms CLEAN and CURVE are smoothed, and noisy faces before them; else the vertices of
        facets of the Voronoi diagram have crisp places.
    """
    asked, settings = settings, settings.with_side()
    rough = ""
    if relaxed:
        shape, rough = smooth_faces(shape, settings, progress and progress.part(SMOOTHING))
    form, wanted = settings.form_of_side, settings.form
    limit = limit.used(
        faces=len(shape.triangles) > 0,
        side=settings.side,
        levels=form is not Form.PUBLISHED,
        triangles=len(shape.triangles) if settings.has_crisp_places else 0,
    )
    if form is Form.CURVE:
        limit = limit.used(output=CURVE)
    share = 1.0 if form is Form.PUBLISHED else ANALYSIS
    begun = begin(shape, settings, progress, limit, share, levels=form is not Form.PUBLISHED)
    shape, chosen = begun.shape, begun.chosen
    wraps = settings.sides is SidesFrom.WRAP
    sides = SidesFrom.WRAP if wraps else chosen.sides.source
    settings = replace(
        settings, sides=sides, sampling=chosen.sampling, form=form, **chosen.of_pairs
    )
    axis = extract(chosen.samples, settings, begun.progress, relaxed)
    return Computation(
        axis=axis,
        settings=settings,
        asked=asked,
        chosen=chosen,
        warnings=(*([rough] if rough else []), *axis_warnings(shape, settings, chosen, axis)),
        topology=topology_sentence(axis, wanted, chosen.samples),
        seconds=begun.seconds,
        turned=shape.reading_counts["turned"],
        mesh=mesh_counts(begun.given),
    )


def extract_axis(computation: Computation, settings: Settings) -> MedialAxis:
    """Extract the axis of a computation for other thresholds; the other settings must stay the same."""
    return extract(computation.chosen.samples, settings).moved(computation.origin)


def refiltered_topology(key: str, axis: MedialAxis, wanted: Form) -> str:
    """Return `Computation.topology` of an axis from `refilter`; `wanted` is the form of the settings."""
    samples = CACHE.get(key)
    return "" if samples is None else topology_sentence(axis, wanted, samples)


def refilter(key: str, settings: Settings, progress: Progress | None = None) -> MedialAxis | None:
    """Extract the axis of a kept analysis for other thresholds; None when the analysis is no longer kept."""
    samples = CACHE.get(key)
    return None if samples is None else extract(samples, settings, progress)
