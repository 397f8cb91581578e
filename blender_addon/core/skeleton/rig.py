# SPDX-License-Identifier: GPL-3.0-or-later
"""Compute named bones of a shape, and the weights of its vertices."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import DegenerateInputError
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from .bones import Bones, bones_of
from .centre import centre_of_mass
from .compute import Skeletonization, compute_skeleton
from .names import names_of
from .weights import axis_weights, edges_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..machine.progress import Progress
    from ..samples.shape import Shape
    from ..settings import Settings, SkeletonSettings


@dataclass(frozen=True, eq=False)
class Rig:
    """A rig has bones, and weights by which vertices follow them.

    Parameters
    ----------
    made_of : Skeletonization
    bones : Bones
    names : list of str
        The names of the bones.
    bone : (v, 4) int32
        Up to four bones of each vertex of the shape.
    weight : (v, 4) float64
        The weights of a vertex add up to 1, and the largest is first.
    warnings : tuple of str
    seconds : float
    """

    made_of: Skeletonization
    bones: Bones
    names: list[str]
    bone: NDArray[np.int32]
    weight: NDArray[np.float64]
    warnings: tuple[str, ...]
    seconds: float


def compute_rig(
    shape: Shape,
    settings: Settings,
    wanted: SkeletonSettings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> Rig:
    """Compute bones along the skeleton of a shape; parameters and errors are those of `compute_skeleton`.

    Raises
    ------
    DegenerateInputError
        The skeleton has only single points, as that of a ball.
    """
    start = time.perf_counter()
    made_of = compute_skeleton(shape, settings, wanted, progress, limit)
    if not made_of.skeleton.count:
        raise DegenerateInputError(
            "Expected a solid with limbs, found that its skeleton is a point, as that of a ball; "
            "choose another object"
        )
    centre = centre_of_mass(made_of.skeleton)
    bones = bones_of(made_of.skeleton, centre)
    edges = edges_of(shape.triangles)
    bone, weight = axis_weights(bones, made_of.parts.vertices, shape.points, edges)
    return Rig(
        made_of=made_of,
        bones=bones,
        names=names_of(bones, centre),
        bone=bone,
        weight=weight,
        warnings=made_of.warnings,
        seconds=time.perf_counter() - start,
    )
