# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis of a box, which everybody knows: does what is installed here compute it?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import __version__
from ..arrays import Floats
from ..machine import native
from ..settings import SamplingMode, Settings
from .compute import Computation, compute
from .medial_axis import MedialAxis
from .topology import betti_words

SIZES = np.array([2.0, 1.5, 1.0])
_SAMPLES = 3000
_CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) - 0.5
_TRIANGLES = np.array(
    [
        *((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5)),
        *((0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6)),
        *((0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)),
    ],
    np.int32,
)
_TOPOLOGY = f"{betti_words((1, 0, 0))}, as the solid"


@dataclass(frozen=True)
class Check:
    """One thing that was looked at, and what was found, a sentence."""

    passed: bool
    found: str


def compute_box() -> Computation:
    """The inner medial axis of a box, as it is computed here."""
    settings = Settings(sampling=SamplingMode.SURFACE, samples=_SAMPLES)
    return compute(_CORNERS * SIZES, _TRIANGLES, settings)


def checks_of(box: Computation) -> list[Check]:
    """Check the axis of the box; all lengths are right up to the spacing of the samples."""
    module, samples = native.load(), box.chosen.samples
    return [
        Check(
            module.__version__ == __version__.partition("+")[0],
            f"The compiled module is of version {module.__version__}, the add-on of {__version__}",
        ),
        *_of_shape(box.axis, samples.spacing),
        Check(box.topology == _TOPOLOGY, f"The axis of a box is {box.topology}"),
        Check(
            _facets(module, samples.points, 1) == _facets(module, samples.points, 0),
            "One thread and all threads give the same bytes",
        ),
    ]


def _of_shape(axis: MedialAxis, close: float) -> list[Check]:
    if not axis.facets:
        return [Check(False, "A box has no medial axis")]
    half = SIZES / 2
    to_faces = np.sort(np.hstack([half - axis.vertices, half + axis.vertices]), axis=1)
    between = float((to_faces[:, 1] - to_faces[:, 0]).max())
    radius = float(np.abs(axis.radius - to_faces[:, 0]).max())
    largest = float(axis.radius.max())
    corner = float((half - axis.vertices.max(axis=0)).max())
    return [
        Check(
            between < close,
            f"A box has {axis.facets:,} facets, equally far from two faces up to {between:.3f}",
        ),
        Check(radius < close, f"Radii are the distances to the faces up to {radius:.3f}"),
        Check(
            abs(largest - SIZES.min() / 2) < close,
            f"The largest ball has the radius {largest:.3f} in a box that is {SIZES.min():g} high",
        ),
        Check(corner < close, f"The axis comes as close to the corners as {corner:.3f}"),
    ]


def _facets(module: Any, points: Floats, threads: int) -> tuple[bytes, ...]:
    """The whole axis of points, byte by byte."""
    mesh = module.MedialAnalysis(points, threads=threads).extract()
    return tuple(
        getattr(mesh, name).tobytes()
        for name in ("vertices", "radius", "face_vertices", "generators")
    )
