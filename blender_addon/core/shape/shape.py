# SPDX-License-Identifier: GPL-3.0-or-later
"""The input of the method: points, faces, and their properties."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..machine import native
from ..portable_angle import angle_of
from ..small_matrices import dot
from .nearness import same_place
from .triangles import unit_normals

# Values of `Shape.reading`; 0 as given.
TURNED, REPEATED, WITHOUT_CORNERS, OF_SHEETS = 1, 2, 3, 4
# The cosine between the normals of faces that may lie on each other, at most; and how far off them their sides are
# looked at, in roundings.
_FOLDED, _OFF = -0.99, 4  # chosen: unseen


@dataclass(frozen=True, eq=False)
class Shape:
    """Points and faces.

    Parameters
    ----------
    points : (n, 3) float64
        All vertices.
    triangles : (m, 3) int32
        Faces, counter-clockwise as seen from outside; none in a cloud of points.
    normals : (n, 3) float64 or None
        Outward normals of the points as they were given, of any length; a zero vector means an unknown normal.
    frame : (4, 4) float64
        Rotation and translation from `points` to the world.
    sharp_edges : (e, 2) int32 or None
        Edges that are marked sharp, rows of `points`.
    shaded_smooth : bool
        Every face is shaded smooth, so that only marked edges look sharp.
    of_samples : bool
        The points are meant as samples, unlike the vertices of curves, texts and metaballs.
    rows : (n,) int32 or None
        The rows that the points have in a larger cloud; None where there is no larger cloud.
    reading : (m,) uint8 or None
        How `outward_faces.outward_shape` read each triangle; None before.
    offset : float
        How far outside of the surface that is meant the faces lie: those of a wrap do.
    far : float
        The largest coordinate before the shape was moved to its own frame; 0.0 where it was not.
    single : bool or None
        Whether coordinates were rounded to float32, as all of Blender's and those of .stl files are; None where only
        the numbers can tell.
    """

    points: Floats
    triangles: Ints
    normals: Floats | None = None
    frame: Floats = field(default_factory=lambda: np.identity(4))
    sharp_edges: Ints | None = None
    shaded_smooth: bool = False
    of_samples: bool = True
    rows: Ints | None = None
    reading: NDArray[np.uint8] | None = None
    offset: float = 0.0
    far: float = 0.0
    single: bool | None = None

    def has_vertices(self, count: int) -> bool:
        """Return whether the points may be `count` vertices of an object, as those of a wrap never are."""
        return len(self.points) == count and self.offset == 0.0

    @cached_property
    def left_out(self) -> Flags:
        """(m,) the triangles that count for nothing."""
        if self.reading is None:
            return np.zeros(len(self.triangles), bool)
        return self.reading >= REPEATED

    @property
    def reading_counts(self) -> dict[str, int]:
        """How many faces were read the other way round, and how many were left out and why."""
        reading = np.zeros(0, np.uint8) if self.reading is None else self.reading
        counts = np.bincount(reading, minlength=5)
        return {
            "turned": int(counts[TURNED]),
            "repeated": int(counts[REPEATED]),
            "without_corners": int(counts[WITHOUT_CORNERS]),
            "of_sheets": int(counts[OF_SHEETS]),
        }

    @property
    def loose_vertices(self) -> int:
        """The number of vertices that belong to no face."""
        if not self.left_out.any():
            return len(self.points) - len(np.unique(self.triangles))
        # The corners of a face that was left out are those of another.
        place = same_place(self.points)
        return len(np.unique(place)) - len(np.unique(place[self.triangles]))

    @cached_property
    def rounding(self) -> float:
        """How far apart places may be that were meant to be one, as exactly as the coordinates were given."""
        with native.own_errors() as module:
            return float(module.rounding_of(self.points, self.far))

    @cached_property
    def volume(self) -> float:
        """The volume that closed faces enclose; negative when they point inward."""
        a, b, c = (self.points[self.triangles[:, corner]] - self.points[0] for corner in range(3))
        return float(dot(a, np.cross(b, c)).sum()) / 6

    @cached_property
    def area(self) -> float:
        """The area of all faces."""
        return float(unit_normals(self.points[self.triangles])[1].sum()) / 2

    @cached_property
    def open_edges(self) -> int:
        """The number of edges at which the faces are open.

        Raises
        ------
        InvalidInputError
            A corner is no row of the points, or a coordinate is not finite.
        """
        if not len(self.triangles):
            return 0
        with native.own_errors() as module:
            return int(module.open_edges(self.points, self.triangles))

    @property
    def turned_share(self) -> float:
        """The share of the edges of faces along which another face runs in the same direction."""
        ends = same_place(self.points)[self.triangles]
        edges = (ends * (len(self.points) + 1) + np.roll(ends, -1, axis=1)).ravel()
        return 1.0 - len(np.unique(edges)) / len(edges)

    @cached_property
    def solid_betti(self) -> tuple[int, int, int] | None:
        """Pieces, loops and cavities of the solid, counted from its closed faces; None where that is not possible."""
        with native.own_errors() as module:
            return module.solid_betti(self.points, self.triangles)

    @cached_property
    def connected(self) -> tuple[Ints, Flags]:
        """(m,) the connected part of each face, -1 for faces without three corners, and whether each part is open."""
        with native.own_errors() as module:
            part, is_open, _ = module.mesh_parts(self.points, self.triangles)
        return part, is_open

    @cached_property
    def shells(self) -> tuple[int, int]:
        """The number of connected parts of the faces, and of those that are closed and look inward."""
        part, is_open = self.connected
        corners = (self.points - self.points[0])[self.triangles[part >= 0]]
        six = dot(corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
        volumes = np.bincount(part[part >= 0], six, len(is_open))
        return len(is_open), int(np.count_nonzero((volumes < 0.0) & ~is_open))

    @cached_property
    def crossing(self) -> Ints:
        """(k, 2) pairs of faces that pass through each other; not all of them where very many faces are thin."""
        with native.own_errors() as module:
            return np.asarray(module.crossing_faces(self.points, self.triangles))

    @cached_property
    def neighbours(self) -> Longs:
        """(m, 3) the triangle beyond the side after each corner, which passes it the other way; -1 where there is none.

        Vertices with the same coordinates are one.
        """
        ends = same_place(self.points)[self.triangles]
        others, count = np.roll(ends, -1, axis=1), len(self.points)
        keys, wanted = (ends * count + others).ravel(), (others * count + ends).ravel()
        order = np.argsort(keys, kind="stable")
        row = order[np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)]
        return np.where(keys[row] == wanted, row // 3, -1).reshape(-1, 3).astype(np.int64)

    def smooth_bends(self, sharp: float) -> Floats:
        """(m,) the largest angle between the normals of each face and one beside it over an edge that is not sharp."""
        normals, _ = unit_normals(self.points[self.triangles])
        cosines = np.clip(dot(normals[:, None], normals[self.neighbours]), -1.0, 1.0)
        angles = angle_of(cosines, np.sqrt(1.0 - cosines**2))
        counted = (self.neighbours >= 0) & (angles < sharp)
        return np.where(counted, angles, 0.0).max(axis=1, initial=0.0)

    @cached_property
    def unfolded(self) -> Longs:
        """(k,) the faces without those that a fold hides: they lie between two others, with the solid outside of them.

        Folds have neighbours that lie on each other, nearly; without one no face is tested, nor where faces that cannot
        be turned outward bound a negative volume.
        """
        corners = self.points[self.triangles]
        normals, _ = unit_normals(corners)
        cosines = dot(normals[:, None], normals[self.neighbours])
        every = np.arange(len(self.triangles), dtype=np.int64)
        meet = (cosines < _FOLDED) & (self.neighbours >= 0)
        if not (meet.any() and self.volume > 0.0):
            return every
        off = _OFF * self.rounding
        middles, faces = corners.mean(axis=1), (self.points, self.triangles)
        with native.own_errors() as module:
            above, below = (
                module.winding_number(middles + away * normals, *faces) > 0.5
                for away in (off, -off)
            )
        return every[~(above & ~below)]

    @property
    def is_folded(self) -> bool:
        """Whether faces lie between two others in a fold."""
        return len(self.unfolded) < len(self.triangles)
