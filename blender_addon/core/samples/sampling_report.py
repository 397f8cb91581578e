# SPDX-License-Identifier: GPL-3.0-or-later
"""How densely an object is sampled, sample by sample: the theorem's condition as a diagnosis."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from .analysis import AnalysedSamples
from .choose_samples import ChosenSamples, choose_samples
from .density import Density, estimate
from .nearness import same_place
from .sampling_warnings import sampling_warnings
from .triangle_faces import TriangleFaces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..settings import Settings
    from .shape import Shape


@dataclass(frozen=True, eq=False)
class SamplingReport(TriangleFaces):
    """The samples, the surface as they see it, and estimates for each.

    Parameters
    ----------
    vertices : (n, 3) float64
        The samples, in the order in which the generators of a medial axis count them.
    triangles : (f, 3) int32
        Between inside and outside, outward.
    epsilon, spacing, feature_size : (n,) float64
        As of `density`; rows with the same coordinates have the same.
    density : Density
        Of all samples.
    shape : Shape
        What was sampled.
    chosen : ChosenSamples
    warnings : tuple of str
    seconds : float
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int32]
    epsilon: NDArray[np.float64]
    spacing: NDArray[np.float64]
    feature_size: NDArray[np.float64]
    density: Density
    shape: Shape
    chosen: ChosenSamples
    warnings: tuple[str, ...]
    seconds: float


def report_sampling(
    shape: Shape,
    settings: Settings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> SamplingReport:
    """Sample an object as `compute_axis` does, and estimate how dense that is.

    Parameters
    ----------
    shape : Shape
    settings : Settings
    progress : Progress, optional
    limit : MemoryLimit

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    chosen = choose_samples(shape, settings.with_side(), progress or Progress(), limit)
    samples, density = chosen.samples, _of_all(chosen.samples)
    rows = _sample_of_row(samples.points, samples.analysis.samples)
    return SamplingReport(
        vertices=samples.points,
        triangles=samples.analysis.solid_triangles(),
        epsilon=density.epsilon[rows],
        spacing=density.spacing[rows],
        feature_size=density.feature_size[rows],
        density=density,
        shape=shape,
        chosen=chosen,
        warnings=tuple(sampling_warnings(shape, chosen)),
        seconds=time.perf_counter() - start,
    )


def _of_all(samples: AnalysedSamples) -> Density:
    """The density at every sample, also where a glance at some was enough to choose them."""
    found, analysis = samples.density, samples.analysis
    if len(found.points) == len(analysis.samples):
        return found
    return estimate(analysis, samples.points, found.edges, found.finest, found.limit)


def _sample_of_row(points: NDArray[np.float64], samples: NDArray[np.int32]) -> NDArray[np.int64]:
    """(n,) which of the samples, the distinct rows, each row is."""
    if len(samples) == len(points):
        return np.arange(len(points))
    which = same_place(points)
    place = np.empty(which.max() + 1, np.int64)
    place[which[samples]] = np.arange(len(samples))
    return place[which]
