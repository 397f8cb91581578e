# SPDX-License-Identifier: GPL-3.0-or-later
"""The density of an object's samples, one by one: the theorem's condition as a diagnosis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..settings import SamplingMode, Settings
from ..shape.nearness import sample_of_row
from ..shape.shape import Shape
from ..shape.triangle_faces import TriangleFaces
from ..small_matrices import dot
from .analysed import Analysed
from .choose_samples import begin
from .chosen import ChosenSamples
from .density import Density, estimate
from .rough_faces import SMOOTHING, smooth_faces
from .sampling_warnings import sampling_warnings


@dataclass(frozen=True, eq=False)
class SamplingReport(TriangleFaces):
    """The samples, the surface between them, and estimates for each sample."""

    # (n, 3) The samples, in the order in which the generators of a medial axis count them
    vertices: Floats
    # (f, 3) The surface between inside and outside, counter-clockwise as seen from outside
    triangles: Ints
    # (n,) As in `density`; rows with the same coordinates have the same values
    epsilon: Floats
    spacing: Floats
    feature_size: Floats
    # (n,) How far each point of a scan or vertex of noisy faces was moved; 0 where nothing was, and for samples of
    # faces
    moved: Floats
    density: Density  # The density at all samples
    shape: Shape  # The shape that was sampled
    chosen: ChosenSamples
    warnings: tuple[str, ...]
    seconds: float


def report_sampling(
    shape: Shape,
    settings: Settings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> SamplingReport:
    """Sample an object as `compute_axis` does, and estimate the density of the samples."""
    settings, given = settings.with_side(), shape
    shape, rough = smooth_faces(shape, settings, progress and progress.part(SMOOTHING))
    begun = begin(shape, settings, progress, limit)
    shape, chosen = begun.shape, begun.chosen
    samples, density = chosen.samples, _of_all(chosen.samples)
    rows = sample_of_row(samples.points, samples.analysis.samples)
    return SamplingReport(
        vertices=samples.points,
        triangles=samples.analysis.solid_triangles(),
        epsilon=density.epsilon[rows],
        spacing=density.spacing[rows],
        feature_size=density.feature_size[rows],
        moved=_moved(given, shape, chosen),
        density=density,
        shape=shape,
        chosen=chosen,
        warnings=(*([rough] if rough else []), *sampling_warnings(shape, chosen)),
        seconds=begun.seconds,
    )


def _moved(given: Shape, shape: Shape, chosen: ChosenSamples) -> Floats:
    """Return how far each sample was moved; it is unknown for a scan that was thinned afterwards."""
    count = len(chosen.samples.points)
    if chosen.scan is not None:
        moved = chosen.scan.moved
        return np.zeros(count) if moved is None or len(moved) != count else moved
    if chosen.sampling is SamplingMode.VERTICES and len(shape.points) == len(given.points) == count:
        away = shape.points - given.points
        return np.sqrt(dot(away, away))
    return np.zeros(count)


def _of_all(samples: Analysed) -> Density:
    """Return the density at every sample, also where a selection was enough to choose the samples."""
    found, analysis = samples.density, samples.analysis
    if len(found.points) == len(analysis.samples):
        return found
    return estimate(analysis, samples.points, found.edges, found.finest, found.limit)
