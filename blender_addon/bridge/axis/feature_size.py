# SPDX-License-Identifier: GPL-3.0-or-later
"""The feature size on a source: `ma_feature_size`, and a vertex group of it for modifiers that ask where detail is."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Floats
from ...core.machine.native import own_errors
from ...core.samples.sampling_report import SamplingReport
from ..mesh.attributes import as_float32, set_attribute
from ..mesh.step_weights import write_steps

FEATURE_SIZE = "ma_feature_size"  # of the attribute and of the vertex group
# Weights go from 1 at this share of the smallest sizes to 0 at the same share of the largest.
_ENDS = 0.05


def write_feature_size(source: bpy.types.Object, found: SamplingReport) -> None:
    """Give the vertices of a mesh object in object mode the feature size at the nearest sample, and their weights."""
    with own_errors() as module:
        sizes = found.feature_size[module.nearest(found.vertices, found.shape.points)]
    set_attribute(source.data, FEATURE_SIZE, "FLOAT", "POINT", as_float32(sizes))
    write_steps(source, FEATURE_SIZE, detail_of(sizes))


def detail_of(sizes: Floats) -> Floats:
    """(n,) 1 where the feature size is smallest, 0 where it is largest, even steps of its logarithm in between; 0 where
    it is not known."""
    known = np.isfinite(sizes) & (sizes > 0.0)
    if not known.any():
        return np.zeros(len(sizes))
    logarithms = np.log(np.where(known, sizes, np.inf))
    low, high = np.quantile(logarithms[known], [_ENDS, 1.0 - _ENDS])
    if low == high:
        return known.astype(np.float64)
    return np.clip((high - logarithms) / (high - low), 0.0, 1.0)
