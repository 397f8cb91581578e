# SPDX-License-Identifier: GPL-3.0-or-later
"""The effort that each choice of Sampling allows: how often and how finely the faces are sampled."""

from __future__ import annotations

from dataclasses import dataclass

from ..settings import SamplingMode


@dataclass(frozen=True)
class Effort:
    """The effort that a choice of Sampling allows.

    Parameters
    ----------
    passes : int
        The largest number of times that the faces are sampled.
    at_edges, elsewhere, walls : float
        The smallest spacing at sharp edges, elsewhere, and between walls where that much is needed to see the axis,
        as shares of the first pass's spacing.
    """

    passes: int
    at_edges: float
    elsewhere: float
    walls: float


# The effort of Automatic is small, so that a first click is fast.
EFFORT = {
    SamplingMode.VERTICES: Effort(0, 0.0, 0.0, 0.0),
    SamplingMode.SURFACE: Effort(1, 1.0, 1.0, 1.0),
    SamplingMode.AUTOMATIC: Effort(2, 1.0, 0.5, 0.0625),
    SamplingMode.ADAPTIVE: Effort(4, 0.25, 0.0625, 0.0625),
}
