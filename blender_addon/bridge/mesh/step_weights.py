# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertex groups whose weights are given for all vertices."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Floats

_STEPS = 100  # weights are written in this many steps, each in one call


def write_steps(source: bpy.types.Object, name: str, weights: Floats) -> None:
    """Give a mesh object in object mode a vertex group of (v,) weights from 0 to 1, rounded to hundredths."""
    group = source.vertex_groups.get(name) or source.vertex_groups.new(name=name)
    steps = np.rint(_STEPS * weights).astype(np.int64)
    for step in np.unique(steps).tolist():
        group.add(np.flatnonzero(steps == step).tolist(), step / _STEPS, "REPLACE")
