# SPDX-License-Identifier: GPL-3.0-or-later
"""How densely an object is sampled, sample by sample: the theorem's condition as a diagnosis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from .choose_samples import begin
from .density import Density, estimate
from .nearness import sample_of_row
from .sampling_warnings import sampling_warnings
from .triangle_faces import TriangleFaces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..machine.progress import Progress
    from ..settings import Settings
    from .analysed import AnalysedSamples
    from .chosen import ChosenSamples
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
    begun = begin(shape, settings.with_side(), progress, limit)
    chosen = begun.chosen
    samples, density = chosen.samples, _of_all(chosen.samples)
    rows = sample_of_row(samples.points, samples.analysis.samples)
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
        seconds=begun.seconds,
    )


def _of_all(samples: AnalysedSamples) -> Density:
    """The density at every sample, also where a glance at some was enough to choose them."""
    found, analysis = samples.density, samples.analysis
    if len(found.points) == len(analysis.samples):
        return found
    return estimate(analysis, samples.points, found.edges, found.finest, found.limit)
