# SPDX-License-Identifier: GPL-3.0-or-later
"""A level with fewer vertices, and other wires between those that stay."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Ints
from .medial_axis import LevelValues, MedialAxis

OF_VERTICES = ("exact", "exact_radius", "place", "crumb")  # fields of LevelValues


def with_rows(axis: MedialAxis, keep: Flags, edges: Ints, limb: NDArray[np.float32]) -> MedialAxis:
    """Return a level with some of its vertices.

    All vertices of facets and of the (w, 2) edges are kept; these are rows of the vertices before.
    """
    row = (np.cumsum(keep) - 1).astype(np.int32)
    structure = axis.structure
    if structure is not None:  # only vertices of wires go, so neither edges nor nodes of it
        structure = replace(
            structure,
            kind=structure.kind[keep],
            facet_edges=row[structure.facet_edges],
            node_vertex=row[structure.node_vertex],
        )
    level: LevelValues | None = axis.level
    assert level is not None
    values = {name: getattr(level, name) for name in OF_VERTICES}
    kept = {name: value[keep] for name, value in values.items() if value is not None}
    return replace(
        axis,
        vertices=axis.vertices[keep],
        radius=axis.radius[keep],
        face_vertices=row[axis.face_vertices],
        edges=row[edges],
        structure=structure,
        level=replace(level, limb=limb, **kept),
    )
