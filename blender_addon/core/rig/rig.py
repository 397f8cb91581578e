# SPDX-License-Identifier: GPL-3.0-or-later
"""Compute named bones of a shape, and the weights of its vertices."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..errors import DegenerateInputError
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings, SkeletonSettings
from ..shape.shape import Shape
from ..shape.triangles import edges_of
from ..skeleton.compute import Skeletonization, compute_skeleton
from ..small_matrices import dot, times
from .bones import Body, Bones, bones_of
from .names import limbs_of, names_of
from .roll import flats_of
from .weights import axis_weights


@dataclass(frozen=True, eq=False)
class Rig:
    """A rig has bones, and weights by which vertices follow them."""

    made_of: Skeletonization
    bones: Bones
    names: list[str]  # The names of the bones
    limbs: list[list[int]]  # The bones of each chain that ends in a tip, from its start
    # (4, 4) The plane between the sides of the body is that across X in this frame, a rotation and a translation
    frame: Floats
    bone: Ints  # (v, 4) Up to four bones of each vertex of the shape
    weight: Floats  # (v, 4) The weights of a vertex add up to 1, and the largest is first
    warnings: tuple[str, ...]
    seconds: float


def compute_rig(
    shape: Shape,
    settings: Settings,
    wanted: SkeletonSettings,
    per_limb: int = 0,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
    ends: Floats | None = None,
    shown: Settings | None = None,
) -> Rig:
    """Compute bones along the skeleton of a shape; most parameters and errors are those of `compute_skeleton`.

    Parameters
    ----------
    per_limb : int
        The number of bones along each limb, where there is room for them; 0 for as many as it needs.

    Raises
    ------
    DegenerateInputError
        The skeleton has only single points, as that of a ball.
    """
    start = time.perf_counter()
    made_of = compute_skeleton(shape, settings, wanted, progress, limit, ends, shown)
    if not made_of.skeleton.count:
        raise DegenerateInputError(
            "Expected a solid with limbs, found that its skeleton is a point, as that of a ball; "
            "choose another object"
        )
    flats = flats_of(made_of.skeleton, made_of.parts.vertices, shape.points)
    bones, bodies = bones_of(made_of.skeleton, per_limb, flats)
    edges = edges_of(shape.triangles)
    bone, weight = axis_weights(bones, made_of.parts.vertices, shape.points, edges)
    return Rig(
        made_of=made_of,
        bones=bones,
        names=names_of(bodies, bones.count),
        limbs=limbs_of(bodies),
        frame=_frame_of(bodies[0]),
        bone=bone,
        weight=weight,
        warnings=made_of.warnings,
        seconds=time.perf_counter() - start,
    )


def _frame_of(body: Body) -> Floats:
    """Return the least rotation, and a translation along X of that, with which a body is symmetric in X."""
    frame = np.eye(4)
    if body.sides.found:
        normal = body.sides.normal
        frame[:3, :3] = _turn_of_x(normal)
        frame[:3, 3] = dot(body.sides.origin, normal) * normal
    return frame


def _turn_of_x(normal: Floats) -> Floats:
    """Return the least rotation that takes X to a direction whose largest component is positive."""
    across = np.cross((1.0, 0.0, 0.0), normal)
    x, y, z = across
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + cross + times(cross, cross.T) / (1.0 + normal[0])
