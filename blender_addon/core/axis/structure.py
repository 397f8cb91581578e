# SPDX-License-Identifier: GPL-3.0-or-later
"""The structure of a medial axis: sheets, the curves where they meet or end, and the nodes of these (docs/parts.md)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..samples.analysed import Analysed

SEAM, RIM, CREASE = 1, 2, 3  # values of `Structure.seam` and `curve_kind`
JUNCTION, CORNER = 2, 4  # values of `Structure.kind` and `node_kind`
CURVE_NAMES = {SEAM: "seam", RIM: "rim", CREASE: "crease"}
NODE_NAMES = {JUNCTION: "junction", CORNER: "corner"}


@dataclass(frozen=True, eq=False)
class Structure:
    """Sheets, seams, rims, junctions and corners.

    The numbers follow rules that do not know the samples, so they are the same for other samples of the same shape
    where these show the same structure (docs/parts.md).
    """

    part: Ints  # (f,) The part of each facet: a sheet
    turned: Flags  # (f,) Whether the facet must be turned to agree with its part
    facet_edges: Ints  # (e, 2) The edges of the facets, lower vertex first, in lexicographic order
    # (e,) 0 inside a sheet, 1 seam, 2 rim, 3 crease: a rim at a sharp convex edge of the solid
    seam: Ints
    curve: Ints  # (e,) The curve of each edge; -1 where there is none or one too short to count
    # (v,) 0 inside a sheet, 1 on a seam, 2 junction, 3 on a rim, 4 corner, 5 on no facet
    kind: Ints
    # (p, 2) The patches of the surface between which the part lies, lower first; -1 where they are not known
    part_patches: Ints
    part_area: Floats  # (p,)
    part_mean_radius: Floats  # (p,)
    part_least_radius: Floats  # (p,)
    curve_kind: Ints  # (c,) As `seam`
    curve_length: Floats  # (c,)
    curve_mean_radius: Floats  # (c,)
    curve_least_radius: Floats  # (c,)
    # The parts at curve i are `curve_parts[curve_part_offsets[i] : curve_part_offsets[i + 1]]`
    curve_part_offsets: Ints
    curve_parts: Ints
    node_kind: Ints  # (n,) 2 junction, 4 corner
    node_vertex: Ints  # (n,)
    # The curves at each node, likewise
    node_curve_offsets: Ints
    node_curves: Ints

    @property
    def parts(self) -> int:
        """Number of sheets."""
        return len(self.part_area)

    def count(self, kind: int) -> int:
        """Return the number of SEAM, RIM or CREASE curves."""
        return int(np.count_nonzero(self.curve_kind == kind))

    def count_nodes(self, kind: int) -> int:
        """Return the number of JUNCTION or CORNER nodes."""
        return int(np.count_nonzero(self.node_kind == kind))

    def parts_at(self, curve: int) -> Ints:
        """Return the parts at a curve."""
        start, end = self.curve_part_offsets[curve : curve + 2]
        return self.curve_parts[start:end]

    def curves_at(self, node: int) -> Ints:
        """Return the curves at a node."""
        start, end = self.node_curve_offsets[node : node + 2]
        return self.node_curves[start:end]

    def scaled(self, scale: float) -> Structure:
        """Return the structure of the axis in another scale."""
        lengths = [name for name in FIELDS if name.endswith(("_radius", "_length"))]
        changed = {name: getattr(self, name) * scale for name in lengths}
        return replace(self, part_area=self.part_area * scale**2, **changed)

    def with_less_radius(self, offset: float) -> Structure:
        """Return the structure of an axis whose radii are less by an offset."""
        names = [name for name in FIELDS if name.endswith("_radius")]
        return replace(self, **{n: np.maximum(getattr(self, n) - offset, 0.0) for n in names})


FIELDS = tuple(Structure.__dataclass_fields__)
_NAMES = {name: name for name in FIELDS} | {"facet_edges": "edges"}


def structure_of(level: Any, samples: Analysed) -> Structure:
    """Return the structure of a `_medial.Level` of analysed samples."""
    patches = samples.patches
    if patches is None:
        patches = np.tile(np.array([0, -1], np.int32), (len(samples.points), 1))
    with native.own_errors() as module:
        found = module.structure(
            vertices=level.vertices,
            radius=level.radius,
            face_offsets=level.face_offsets,
            face_vertices=level.face_vertices,
            generators=level.generators,
            wires=level.wires,
            patches=patches,
            spacing=samples.neighbours,
        )
    return Structure(**{ours: getattr(found, theirs) for ours, theirs in _NAMES.items()})
