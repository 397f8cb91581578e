# SPDX-License-Identifier: GPL-3.0-or-later
"""The distance of neighbours at each analysed sample."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..samples.analysed import AnalysedSamples
from ..samples.density import HOLE

# Spacings of vertices are measured, and may be as large as the solid at sharp edges; this multiple of the median is
# the largest one that counts.
_LARGEST = 3.0  # chosen: unseen


def spacing_of(samples: AnalysedSamples) -> Floats:
    """Return the distance of neighbours at each sample, (n,); duplicates have 0."""
    if samples.apart is not None:
        return samples.apart
    spacing, found = np.zeros(len(samples.points)), samples.analysis.spacing * (1.0 / HOLE)
    spacing[samples.analysis.samples] = np.minimum(found, _LARGEST * float(np.median(found)))
    return spacing
