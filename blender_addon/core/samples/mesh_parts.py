# SPDX-License-Identifier: GPL-3.0-or-later
"""The connected parts of the faces of a shape: how many, how they were read, and each as a shape of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DegenerateInputError, InvalidInputError
from ..machine import native
from ..settings import SidesFrom
from .outward_faces import TURNED, outward_shape
from .sample_spacing import first_pass
from .sides import resolve_sides_of_samples

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..settings import Settings
    from .shape import Shape


@dataclass(frozen=True)
class MeshCounts:
    """The numbers of faces, of connected parts, and of parts of a kind: open, without thickness, with turned faces."""

    faces: int
    parts: int
    open: int
    flat: int
    turned: int

    def __str__(self) -> str:
        """Return a sentence; it is empty for one part."""
        if self.parts < 2:
            return ""
        told = [f"{self.parts:,} connected parts"]
        if self.open:
            told.append(f"{self.open:,} of them open")
        if self.flat:
            told.append(f"{self.flat:,} of them without thickness")
        if self.turned:
            told.append(f"{self.turned:,} of them with faces that were turned")
        return "; ".join(told)


def mesh_counts(shape: Shape) -> MeshCounts | None:
    """Count the connected parts of a shape that `outward_shape` has read; None where there are no faces."""
    if not len(shape.triangles):
        return None
    with native.own_errors() as module:
        part, is_open, is_flat = module.mesh_parts(shape.points, shape.triangles)
    turned = np.zeros(len(is_open), bool)
    if shape.reading is not None:
        turned[part[(shape.reading == TURNED) & (part >= 0)]] = True
    kinds = (int(np.count_nonzero(rows)) for rows in (is_open, is_flat, turned))
    return MeshCounts(len(shape.triangles), len(is_open), *kinds)


@dataclass(frozen=True, eq=False)
class PartShape:
    """A connected part of a shape.

    Parameters
    ----------
    number : int
        The number of the part, from 1, in the order of the first faces of all parts.
    shape : Shape
    """

    number: int
    shape: Shape


@dataclass(frozen=True, eq=False)
class SplitShape:
    """The connected parts of a shape that bound a solid.

    Parameters
    ----------
    parts : tuple of PartShape
    count : int
        The number of all parts.
    """

    parts: tuple[PartShape, ...]
    count: int

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
    found = tuple(p for p in parts if not (is_open[p.number - 1] and _is_sheet(p.shape, settings)))
    if not found:
        raise DegenerateInputError(
            f"Expected connected parts with thickness, found {len(is_flat):,} without; give them "
            "thickness (a Solidify modifier, or an extrusion)"
        )
    return SplitShape(found, len(is_flat))


def _is_sheet(shape: Shape, settings: Settings) -> bool:
    if settings.sides is not SidesFrom.AUTOMATIC:
        return False
    read = outward_shape(shape)
    with native.own_errors() as module:
        gaps = module.open_edges(read.points, read.triangles)
    spacing = first_pass(read, settings).spacing
    sides = resolve_sides_of_samples(settings.sides, read, gaps, spacing)
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
