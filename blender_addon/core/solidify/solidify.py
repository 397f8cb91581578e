# SPDX-License-Identifier: GPL-3.0-or-later
"""A sheet as a closed solid of an even wall, thinner where there is no room for it (docs/solidify.md)."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..samples.density import percent
from ..settings import SolidifySettings
from ..shape.nearness import near
from ..shape.shape import Shape
from ..shape.triangle_faces import TriangleFaces
from ..shape.triangles import unit_normals
from ..small_matrices import length_of
from .offset_places import EVEN, OffsetPlaces, offset_places
from .sheet import Sheet, rim_sides, sheet_of


@dataclass(frozen=True, eq=False)
class Solidified(TriangleFaces):
    """A solid that was made of a sheet."""

    # (2 v, 3) The vertices of the sheet on the front wall, then on the back wall, in the frame of the shape
    vertices: Floats
    triangles: Ints  # (f, 3) Outward: the front, the back, and the strips along the rims
    walls: Floats  # (2 v,) float32, how thick the wall is at each vertex
    wall: float  # The wall that was asked for
    least: float  # The least wall at a vertex or in the middle of a triangle
    without_room: float  # The share of the sheet where the wall is more than two percent thinner
    # Pairs of triangles that pass through each other; 0 unless the sheet passes through itself
    crossings: int
    volume: float
    warnings: tuple[str, ...]
    seconds: float
    duplicates: int = 0
    chosen: None = None  # nothing is sampled

    @property
    def points(self) -> int:
        """The number of vertices of the sheet."""
        return len(self.vertices) // 2


def solidify(
    shape: Shape,
    wanted: SolidifySettings,
    selected: Flags | None = None,
    progress: Progress | None = None,
) -> Solidified:
    """Give a sheet a wall.

    Parameters
    ----------
    shape : Shape
    wanted : SolidifySettings
    selected : (m,) bool, optional
        The triangles that become a solid; None for all.
    progress : Progress, optional

    Raises
    ------
    InvalidInputError
        There are no faces, more than two meet at an edge, or a sheet has one side only.
    NativeModuleError, OutOfMemoryError, Cancelled
    """
    start, progress = time.perf_counter(), progress or Progress()
    sheet = sheet_of(shape, selected)
    wall = wanted.thickness or 0.01 * length_of(np.ptp(sheet.points, axis=0))
    behind = np.ascontiguousarray(sheet.triangles[:, ::-1])
    lengths = 0.5 * wall * (1.0 + wanted.offset), 0.5 * wall * (1.0 - wanted.offset)
    sides = []
    for number, faces in enumerate((sheet.triangles, behind)):
        progress.begin_section(0.4 * number, 0.4 * number + 0.4)
        sides.append(offset_places(sheet.points, faces, lengths[number], progress))
    progress.begin_section(0.8, 1.0)
    solid, crossings = _apart(sheet, sides)
    found = replace(_measured(sheet, solid, lengths, progress), crossings=crossings)
    warnings = tuple(_warnings(sheet, found))
    return replace(found, warnings=warnings, seconds=time.perf_counter() - start)


def _apart(sheet: Sheet, sides: list[OffsetPlaces]) -> tuple[Shape, int]:
    """The solid, and how many pairs of its triangles cross.

    Vertices whose faces would touch or cross others stay back on their ways, at last where they are.
    """
    ways = np.concatenate([side.moves for side in sides])
    back = np.where(np.concatenate([side.tight for side in sides]), EVEN, 0.0)
    triangles, points = _closed(sheet), np.tile(sheet.points, (2, 1))
    moved = np.ones(len(points), bool)
    while True:
        solid = Shape(points + (1.0 - back)[:, None] * ways, triangles)
        pairs = _crossing(solid, moved)
        moved = np.isin(np.arange(len(points)), triangles[pairs]) & (back < 1.0)
        if not moved.any():
            return solid, len(solid.crossing) if (back == 1.0).any() else 0
        # A vertex that has given up nine tenths of its way and still crosses stays on the sheet.
        slower = np.where(back < 0.9, 0.5 + 0.5 * back, 1.0)
        faster = np.maximum(2.0 * back, EVEN)
        back[moved] = np.where(faster < 1.0, faster, slower)[moved]


def _crossing(solid: Shape, moved: Flags) -> Longs:
    """(k, 2) pairs of triangles that pass through each other, where the others were looked at before they moved."""
    corners = solid.points[solid.triangles]
    middles, fresh = corners.mean(axis=1), moved[solid.triangles].any(axis=1)
    reach = float(np.linalg.norm(corners - middles[:, None], axis=2).max())
    rows = np.flatnonzero(fresh | near(middles, middles[fresh], 2.0 * reach))
    return rows[Shape(solid.points, solid.triangles[rows]).crossing]


def _closed(sheet: Sheet) -> Ints:
    """(f, 3) the triangles of the front, of the back, and of the strips between their rims."""
    front, count = sheet.triangles, len(sheet.points)
    start, end, _ = rim_sides(front).T
    strips = (end, start, start + count), (end, start + count, end + count)
    faces = (front, front[:, ::-1] + count, *(np.column_stack(strip) for strip in strips))
    return np.concatenate(faces).astype(np.int32)


def _measured(
    sheet: Sheet, solid: Shape, lengths: tuple[float, float], progress: Progress
) -> Solidified:
    """The solid with its figures."""
    count, faces = len(sheet.points), len(sheet.triangles)
    middles = solid.points[solid.triangles[: 2 * faces]].mean(axis=1)
    with own_errors() as module:
        away = module.TriangleTree(sheet.points, sheet.triangles).distances(
            np.concatenate((solid.points, middles)), progress=progress.part()
        )
    parts = np.split(away, [count, 2 * count, 2 * count + faces])
    at_vertices, at_middles = (
        np.minimum(one, lengths[0]) + np.minimum(other, lengths[1])
        for one, other in (parts[:2], parts[2:])
    )
    wall = sum(lengths)
    thin = np.asarray(at_vertices < (1.0 - 4.0 * EVEN) * wall)
    narrow = thin[sheet.triangles].mean(axis=1)
    _, areas = unit_normals(sheet.points[sheet.triangles])
    return Solidified(
        solid.points,
        solid.triangles,
        np.tile(at_vertices, 2).astype(np.float32),
        wall,
        float(min(at_vertices.min(), at_middles.min())),
        float((narrow * areas).sum() / areas.sum()) if areas.any() else 1.0,
        0,
        solid.volume,
        (),
        0.0,
    )


def _warnings(sheet: Sheet, found: Solidified) -> Iterator[str]:
    yield from sheet.warnings
    if found.without_room > 0.0:
        yield (
            f"at {percent(found.without_room)} of the sheet there is no room for the wall, which is thinner there, "
            f"down to {found.least:.3g}; take a thinner wall or another Offset, or move the parts of the sheet apart"
        )
    if found.crossings:
        yield (
            f"{found.crossings:,} pairs of faces of the solid pass through each other, because the sheet does there; "
            "take these places apart first"
        )
