# SPDX-License-Identifier: GPL-3.0-or-later
"""The measured thickness of a shape, before a limit decides which parts are thin."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..samples.chosen import ChosenSamples
from ..settings import Between, Edges, ThicknessSettings
from ..shape.shape import Shape
from ..shape.triangles import unit_normals
from .bounded_lengths import MeasuredSurface
from .close_walls import CloseWalls, is_shorter, rounding_of
from .face_lengths import MeasuredFaces
from .thin_faces import face_of_triangles, thinnest_of_faces


@dataclass(frozen=True, eq=False)
class Measurement:
    """A measured shape; limits are applied later."""

    shape: Shape
    chosen: ChosenSamples | MeasuredFaces
    settings: ThicknessSettings  # The settings of the measurement; the limit is not used here
    # The samples and the triangles between them with the thickness or the gap, and pieces of faces where the axis
    # missed a wall
    surface: MeasuredSurface
    # (k,) The length was measured at the sample itself; else it comes from the nearest sample, or is infinite
    measured: Flags
    normals: str  # A sentence about the source of the normals
    noise: float  # The standard deviation of the samples in spacings, 0 to 0.25
    warnings: tuple[str, ...]
    seconds: float
    walls: CloseWalls  # Places whose opposite wall is closer than the measured lengths show
    key: str = ""  # The name of the measurement for `kept_measurement`

    @property
    def samples(self) -> int:
        """The number of samples, which are the first points of the surface."""
        if isinstance(self.chosen, MeasuredFaces):
            return len(self.surface.points)
        return len(self.chosen.samples.points)

    @property
    def duplicates(self) -> int:
        """The number of samples that were merged into an earlier one with the same coordinates."""
        if isinstance(self.chosen, MeasuredFaces):
            return 0
        return int(self.chosen.samples.analysis.duplicates)

    @property
    def points(self) -> Floats:
        """(n, 3) the points of the measured surface."""
        return self.surface.points

    @property
    def triangles(self) -> Ints:
        """(f, 3) the triangles of the measured surface."""
        return self.surface.triangles

    @property
    def lengths(self) -> Floats:
        """(n,) the length at each point; infinite where there is no wall."""
        return self.surface.lengths

    @property
    def at_edge(self) -> Flags:
        """(n,) whether each point lies on a sharp edge."""
        return self.surface.at_edge

    @cached_property
    def of_triangles(self) -> Floats:
        """(f,) by the faces the least length at each triangle.

        By the axis it is the median of the lengths at the corners, so that no single sample decides. Where one or two
        corners lie on an edge, which belongs to two faces, it is no less than the largest length at the other corners.
        It is no more than the way to a wall that rays found there.
        """
        if self.surface.between_walls is not None:
            return self.surface.between_walls
        values, on_edge = self.lengths[self.triangles].T, self.at_edge[self.triangles].T
        a, b, c = values
        median = np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c))
        mixed = on_edge.any(axis=0) & ~on_edge.all(axis=0)
        others = np.where(on_edge[:, mixed], -np.inf, values[:, mixed]).max(axis=0)
        median[mixed] = np.maximum(median[mixed], others)
        if self.settings.between is Between.GAP:  # no wall faces the corner of a solid
            median[on_edge.all(axis=0)] = np.inf
        return np.minimum(median, self.surface.at_most)

    @cached_property
    def of_walls(self) -> Floats:
        """(f,) the same without balls that only come to rest against a triangle, which moves none of its ends apart."""
        at_rest = self.surface.at_rest
        return (
            self.of_triangles if at_rest is None else np.where(at_rest, np.inf, self.of_triangles)
        )

    @cached_property
    def drawn(self) -> Floats:
        """(f,) the lengths that colours show: those of triangles, by the faces filled in where they have none."""
        filled = self.lengths[self.triangles].max(axis=1)
        by_axis = self.surface.between_walls is None
        return np.where(np.isfinite(self.of_triangles) | by_axis, self.of_triangles, filled)

    @cached_property
    def areas(self) -> Floats:
        """(f,) the areas of the triangles."""
        return unit_normals(self.points[self.triangles])[1] / 2

    def areas_below(self, limit: float) -> Floats:
        """(f,) the part of the area of each triangle that is drawn thinner than a limit.

        By the faces each corner stands for as much of its triangle as any other, but those on edges for none.
        """
        thin = self.drawn < limit - self.slack
        if self.surface.between_walls is None:
            return self.areas * thin
        inside = ~self.at_edge[self.triangles]
        below = inside & (self.lengths[self.triangles] < limit - self.slack)
        count = inside.sum(axis=1)
        return self.areas * np.where(count, below.sum(axis=1) / np.maximum(count, 1), thin)

    @cached_property
    def minimum(self) -> float:
        """The smallest length of all triangles; infinite where there is none."""
        return float(self.of_triangles.min(initial=np.inf))

    @cached_property
    def between_parallel(self) -> float | None:
        """The smallest length between walls that are nearly parallel; None where the axis measures, which has none."""
        found = self.surface.between_parallel
        return None if found is None else float(found.min(initial=np.inf))

    @cached_property
    def thinnest_place(self) -> Floats:
        """(3,) the place of the minimum: the middle of a triangle."""
        return self.points[self.triangles[self.of_triangles.argmin()]].mean(axis=0)

    @cached_property
    def unmeasured(self) -> float:
        """The share of the surface whose thickness is unknown; 0 where the settings leave something out.

        Every place on the surface of a solid has an opposite wall, so an infinite thickness was not measured.
        """
        left_out = self.settings.edges is Edges.GREY or self.settings.between is not Between.WALL
        if left_out:
            return 0.0
        if not len(self.triangles):
            return 1.0
        return float(self.areas[~np.isfinite(self.drawn)].sum() / self.areas.sum())

    @cached_property
    def slack(self) -> float:
        """The rounding of the coordinates: a length is below a limit only if it differs by more than this."""
        return rounding_of(self.shape)

    @cached_property
    def row_of_vertices(self) -> NDArray[np.integer]:
        """(v,) the point of the measured surface that stands for each vertex of the shape: itself, or the nearest."""
        if isinstance(self.chosen, MeasuredFaces):
            return self.chosen.row
        samples = self.chosen.samples
        if self.samples == len(self.shape.points) and samples.kinds is None:
            return np.arange(self.samples)
        with native.own_errors() as module:
            return np.asarray(module.nearest(samples.points, self.shape.points))

    @cached_property
    def of_vertices(self) -> Floats:
        """(v,) the length at each vertex of the shape, taken from the nearest sample and from walls that rays found."""
        lengths, way = self.lengths[self.row_of_vertices], self.walls.at_vertices
        samples = None if isinstance(self.chosen, MeasuredFaces) else self.chosen.samples
        if samples is None or (len(samples.points) == len(lengths) and samples.kinds is None):
            return lengths
        return np.where(is_shorter(way, lengths), way, lengths)

    @cached_property
    def are_filled(self) -> Flags:
        """(n,) whether the length of each point was measured elsewhere."""
        measured = np.ones(len(self.points), bool)
        measured[: len(self.measured)] = self.measured
        return np.isfinite(self.lengths) & ~measured

    @cached_property
    def triangle_of_faces(self) -> Ints:
        """(m,) the triangle that represents each face of the shape, the thinnest one in it; -1 where there is none."""
        if self.triangles is self.shape.triangles:
            return np.arange(len(self.triangles), dtype=np.int32)
        inside = self.surface.face_of_triangles
        if inside is None:
            inside = face_of_triangles(self.triangles, self.at_edge, self.surface.faces)
        return thinnest_of_faces(
            self.shape, self.points, self.triangles, self.drawn, self.at_edge, inside
        )

    @property
    def bytes(self) -> int:
        arrays: tuple[NDArray, ...] = (
            self.triangles,
            self.lengths,
            self.measured,
            self.points,
            self.points[: self.samples],
            self.shape.points,
        )
        return sum(x.nbytes for x in arrays) + 40 * len(self.triangles)
