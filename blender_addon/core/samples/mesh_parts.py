# SPDX-License-Identifier: GPL-3.0-or-later
"""The connected parts of the faces of a shape: sheets are left out, and each other part is a shape of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags
from ..errors import DegenerateInputError, InvalidInputError
from ..machine import native
from ..settings import SamplingMode, Settings, Side, SidesFrom
from ..shape.bent_sheets import bent_sheets
from ..shape.check_faces import check_not_a_sheet, check_not_flat, open_sheet_error
from ..shape.outward_faces import outward_shape
from ..shape.shape import OF_SHEETS, Shape
from .sample_spacing import first_pass
from .sides import are_sheets, resolve_sides_of_samples


def without_sheets(shape: Shape, settings: Settings) -> Shape:
    """Leave out the connected parts without thickness, part by part, where open faces decide what is inside.

    `Shape.reading` says which faces were left out. They and their vertices count for nothing. Where all parts are
    sheets, none is left out.

    Parameters
    ----------
    shape : Shape
        With faces that look outward.
    settings : Settings

    Raises
    ------
    DegenerateInputError
        One side is wanted, and all faces are those of bent sheets.
    """
    by_open_faces = settings.sides is SidesFrom.AUTOMATIC and shape.open_edges > 0
    if settings.sampling is SamplingMode.VERTICES or not by_open_faces:
        return shape
    of_sheets, are_all = _are_of_bent_sheets(shape)
    if not are_all:
        shape = _leave_out(shape, of_sheets)
    elif settings.side is not Side.BOTH:
        check_not_a_sheet(shape, settings.side)
    part, is_open = shape.connected
    if not shape.open_edges or len(is_open) < 2:
        return shape
    spacing = first_pass(shape, settings).spacing
    of_sheets = (part >= 0) & are_sheets(shape, part, is_open, spacing)[part]
    return shape if (of_sheets | (part < 0)).all() else _leave_out(shape, of_sheets)


def check_no_sheet(shape: Shape) -> None:
    """Raise DegenerateInputError where faces, which look outward, are those of open sheets and of nothing else."""
    plain = Settings()
    if shape.open_edges:
        check_not_flat(shape)
        if _are_of_bent_sheets(shape)[1] or _is_sheet(without_sheets(shape, plain), plain):
            raise open_sheet_error(shape.open_edges, of_axis=False)


def _are_of_bent_sheets(shape: Shape) -> tuple[Flags, bool]:
    """Mark the faces of bent sheets, (m,), and whether these are all that count for something."""
    part, is_open = shape.connected
    found = bent_sheets(shape, part, len(is_open))[part] & (part >= 0)
    return found, bool(found.any() and (found | (part < 0)).all())


def _leave_out(shape: Shape, of_sheets: Flags) -> Shape:
    if not of_sheets.any():
        return shape
    triangles = np.where(of_sheets[:, None], shape.triangles[:, :1], shape.triangles)
    reading = np.zeros(len(shape.triangles), np.uint8) if shape.reading is None else shape.reading
    reading = np.where(of_sheets, np.uint8(OF_SHEETS), reading)
    return replace(shape, triangles=triangles, reading=reading, of_samples=False)


@dataclass(frozen=True, eq=False)
class PartShape:
    """A connected part of a shape."""

    number: int  # The number of the part, from 1, in the order of the first faces of all parts
    shape: Shape


@dataclass(frozen=True, eq=False)
class SplitShape:
    """The connected parts of a shape that bound a solid."""

    parts: tuple[PartShape, ...]
    count: int  # The number of all parts

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence about the parts that were left out."""
        if not (left := self.count - len(self.parts)):
            return ()
        return (
            f"{left:,} of {self.count:,} connected parts are sheets without thickness and were left out; "
            "give them thickness (a Solidify modifier)",
        )

    def words(self, number: int) -> str:
        """The number of a part as text, as long as that of any other part."""
        return f"{number:0{len(str(self.count))}d}"


def split(shape: Shape, settings: Settings) -> SplitShape:
    """Split a shape into its connected parts, without those that lie in a plane or are sheets.

    Open faces are a sheet where they would not decide what is inside, because too few of them bound a solid.

    Raises
    ------
    InvalidInputError
        There are no faces, a corner is no row of the points, or a coordinate is not finite.
    DegenerateInputError
        No part has thickness.
    """
    if not len(shape.triangles):
        raise InvalidInputError(
            "Expected faces for Each Part by Itself, found points only; switch it off"
        )
    with native.own_errors() as module:
        part, is_open, is_flat = module.mesh_parts(shape.points, shape.triangles)
    order = np.argsort(part, kind="stable")
    ends = np.cumsum(np.bincount(part[part >= 0], minlength=len(is_flat)))
    groups = np.split(order[np.count_nonzero(part < 0) :], ends[:-1])
    thick = np.flatnonzero(~is_flat).tolist()
    parts = [PartShape(number + 1, _some_faces(shape, groups[number])) for number in thick]
    found = tuple(
        p for p in parts if not (is_open[p.number - 1] and _has_no_thickness(p.shape, settings))
    )
    if not found:
        raise DegenerateInputError(
            f"Expected connected parts with thickness, found {len(is_flat):,} without; give them "
            "thickness (a Solidify modifier, or an extrusion)"
        )
    return SplitShape(found, len(is_flat))


def _has_no_thickness(shape: Shape, settings: Settings) -> bool:
    """Return whether one connected part is a sheet by itself, wavy or bent."""
    if settings.sides is not SidesFrom.AUTOMATIC:
        return False
    read = outward_shape(shape)
    whole = np.zeros(len(read.triangles), np.int32)
    return _is_sheet(shape, settings) or bool(bent_sheets(read, whole, 1).any())


def _is_sheet(shape: Shape, settings: Settings) -> bool:
    """Return whether faces bound too little of a solid to decide what is inside, as they should."""
    if settings.sides is not SidesFrom.AUTOMATIC:
        return False
    read = outward_shape(shape)
    if not read.open_edges:
        return False
    spacing = first_pass(read, settings).spacing
    sides = resolve_sides_of_samples(settings.sides, read, spacing)
    return sides.source is not SidesFrom.SURFACE


def _some_faces(shape: Shape, faces: NDArray[np.intp]) -> Shape:
    """A shape of some of the faces, with their points and what is known of these."""
    rows, corners = np.unique(shape.triangles[faces], return_inverse=True)
    normals, edges = shape.normals, shape.sharp_edges
    if edges is not None:
        new = np.full(len(shape.points), -1, np.int32)
        new[rows] = np.arange(len(rows), dtype=np.int32)
        edges = new[edges]
        edges = np.ascontiguousarray(edges[(edges >= 0).all(axis=1)])
    return replace(
        shape,
        points=shape.points[rows],
        triangles=corners.reshape(-1, 3).astype(np.int32),
        normals=None if normals is None else normals[rows],
        sharp_edges=edges,
        rows=None,
        reading=None if shape.reading is None else shape.reading[faces],
    )
