# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets with few faces: triangles of one plane are joined to polygons, none of which crosses itself."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..shape.triangles import sides_of, unit_normals
from ..united import united
from .carried_sheets import CarriedSheets
from .crossed_borders import crossings
from .sheet_faces import SheetFaces

_UNEVEN = 0.1  # the share of its mean by which an uneven thickness differs from it on the average; chosen: unseen
_WIDENED = 5  # so many times at most triangles are kept farther around a border that crosses itself


def few_faces(
    sheets: CarriedSheets, wanted: int, progress: Progress | None, shortest: float = 0.0
) -> SheetFaces:
    """The sheets with few faces, but around places where the border of one would cross itself their triangles.

    Their borders have no edges shorter than `shortest`, where that can be.
    The other faces share edges with these. Groups of sheets in which this is not enough keep all of their triangles.
    """
    label = sheets.part.copy()
    own = label.max() + 1 + np.arange(len(label), dtype=np.int32)
    faces = _reduced(sheets, label, wanted, progress, shortest)
    for widened in range(_WIDENED):
        places, part = crossings(faces)
        if not len(places):
            return faces
        near = _near(sheets, places, part, 2.0**widened)
        label[near] = own[near]
        faces = _reduced(sheets, label, wanted, progress, shortest)
    return _without_crossings(faces, sheets)


def _near(sheets: CarriedSheets, places: Floats, part: Ints, reach: float) -> Flags:
    """(t,) the triangles of sheets with a corner so many mean thicknesses around one of their places, or nearest."""
    found = np.zeros(len(sheets.part), bool)
    for place, number in zip(places, part, strict=True):
        mine = np.flatnonzero(sheets.part == number)
        away = np.linalg.norm(sheets.vertices[sheets.triangles[mine]] - place, axis=2)
        far = max(away.min(), reach * sheets.at_corners[mine].mean())
        found[mine[(away <= far).any(axis=1)]] = True
    return found


def _without_crossings(faces: SheetFaces, sheets: CarriedSheets) -> SheetFaces:
    """The faces, but in each group of sheets in which a polygon crosses itself the triangles of the sheets."""
    group = _groups(sheets)
    crossed = np.isin(group, group[crossings(faces)[1]])
    if not crossed.any():
        return faces
    kept, own = ~crossed[faces.part], crossed[sheets.part]
    sizes = np.diff(faces.offsets)
    triangles = sheets.triangles[own].ravel() + len(faces.vertices)
    rows = np.concatenate((faces.corners[np.repeat(kept, sizes)], triangles))
    used, corners = np.unique(rows, return_inverse=True)
    ends = np.zeros(kept.sum() + own.sum() + 1, np.int64)
    ends[1:] = np.cumsum(np.append(sizes[kept], np.full(own.sum(), 3)))
    return SheetFaces(
        np.concatenate((faces.vertices, sheets.vertices))[used],
        ends.astype(np.int32),
        corners.reshape(-1).astype(np.int32),
        np.concatenate((faces.part[kept], sheets.part[own])),
    )


def _groups(sheets: CarriedSheets) -> Longs:
    """(parts,) the same number for sheets that share vertices."""
    parts = int(sheets.part.max()) + 1
    pairs = np.column_stack((np.repeat(sheets.part, 3), parts + sheets.triangles.ravel()))
    return united(parts + len(sheets.vertices), pairs)[:parts]


def _reduced(
    sheets: CarriedSheets, label: Ints, wanted: int, progress: Progress | None, shortest: float
) -> SheetFaces:
    """The sheets with so many vertices, or twice as many and so on where that cannot be.

    Triangles of different labels are not joined.
    """
    with own_errors() as module:

        def reduced(wanted: int) -> tuple[Any, ...] | None:
            return module.reduce_sheets(
                np.ascontiguousarray(sheets.vertices),
                _radii(sheets),
                np.ascontiguousarray(sheets.triangles),
                np.zeros((0, 2), np.int32),
                np.ascontiguousarray(label),
                _nodes(sheets, label),
                wanted,
                shortest=shortest,
                progress=progress and progress.part(),
            )

        while (found := reduced(wanted)) is None:
            wanted *= 2
    places, _, row, offsets, corners, part, _ = found
    places = np.where((row >= 0)[:, None], sheets.vertices[row], places)
    sheet = np.zeros(int(label.max()) + 1, np.int32)
    sheet[label] = sheets.part
    return SheetFaces(places, offsets, corners, sheet[part])


def _are_uneven(sheets: CarriedSheets) -> Flags:
    """(parts,) the sheets whose thickness differs much from its mean on most of them, and not at single vertices."""
    parts = int(sheets.part.max()) + 1
    area = unit_normals(sheets.vertices[sheets.triangles])[1]
    thickness = sheets.at_corners.mean(axis=1)
    volume = np.bincount(sheets.part, area * thickness, parts)
    whole = np.bincount(sheets.part, area, parts)
    mean = volume / np.where(whole > 0.0, whole, 1.0)
    apart = np.abs(thickness - mean[sheets.part])
    return np.asarray(np.bincount(sheets.part, area * apart, parts) > _UNEVEN * volume)


def _radii(sheets: CarriedSheets) -> Floats:
    """(v,) the radii by which the sheets are simplified: one for all where each sheet is evenly thick."""
    if not _are_uneven(sheets).any():
        return np.full(len(sheets.vertices), 0.5 * float(sheets.at_corners.mean()))
    radius = np.zeros(len(sheets.vertices))
    np.maximum.at(radius, sheets.triangles, 0.5 * sheets.at_corners)
    return radius


def _nodes(sheets: CarriedSheets, label: Ints) -> Ints:
    """The vertices where borders of triangles with one label meet."""
    ends, edge, uses = sides_of(sheets.triangles)
    low, high = np.full(len(uses), label.max() + 1), np.full(len(uses), -1)
    np.minimum.at(low, edge, label[:, None])
    np.maximum.at(high, edge, label[:, None])
    border = ends[(uses != 2) | (low != high)]
    degree = np.bincount(border.ravel(), minlength=len(sheets.vertices))
    return np.flatnonzero((degree != 0) & (degree != 2)).astype(np.int32)
