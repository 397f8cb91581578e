# SPDX-License-Identifier: GPL-3.0-or-later
"""The patches of a surface: its parts between sharp convex edges, and those on which samples lie."""

from __future__ import annotations

from ..arrays import Ints
from ..machine import native
from ..settings import Settings
from ..shape.shape import Shape
from ..shape.sharp_angle import sharp_angle_of
from .surface_samples import FaceSamples


def patches_of(shape: Shape, settings: Settings, samples: FaceSamples | None = None) -> Ints | None:
    """Return the patches of samples of the faces, or of the vertices, as `AnalysedSamples.patches`."""
    if not len(shape.triangles):
        return None
    with native.own_errors() as module:
        _, found = module.surface_patches(
            shape.points,
            shape.triangles,
            samples=samples and (samples.points, samples.kinds, samples.faces),
            sharp_angle=sharp_angle_of(shape, settings),
            sharp_edges=shape.sharp_edges,
        )
    return found
