# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples that close the openings of a surface, where the winding number of its faces is one half."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..machine import native
from ..shape.shape import Shape
from .surface_samples import FaceSamples


def close_openings(samples: FaceSamples, shape: Shape, seed: int, progress: Any) -> FaceSamples:
    """Append samples of the openings to the samples of the faces.

    Parameters
    ----------
    samples : FaceSamples
    shape : Shape
    seed : int
    progress : _medial.Progress

    Raises
    ------
    InvalidInputError, OutOfMemoryError, Cancelled
    """
    with native.own_errors() as module:
        more, outward, _ = module.closing_samples(
            samples.points,
            samples.normals,
            samples.radius,
            shape.points,
            shape.triangles,
            seed=seed,
            progress=progress,
        )
        opening = np.full(len(more), int(module.SampleKind.OPENING), np.int32)
    return replace(
        samples,
        points=np.concatenate((samples.points, more)),
        normals=np.concatenate((samples.normals, outward)),
        kinds=np.concatenate((samples.kinds, opening)),
        faces=np.concatenate((samples.faces, np.full(len(more), -1, np.int32))),
        partners=np.concatenate((samples.partners, np.full(len(more), -1, np.int32))),
        closing=len(more),
    )
