# SPDX-License-Identifier: GPL-3.0-or-later
"""Cocone's flat samples and candidates restated by brute force from the docstring of `_medial_study.cocone`.

Starts from the exact Voronoi vertices of `reference.Medial`. Where a comparison is closer than `reference.NEAR`, so
that the rounding of the product's Voronoi vertices may decide it, both answers are followed: every result is a pair
of bounds, the least and the most that the definitions allow, and they are equal almost everywhere.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .reference import NEAR, Array, Ints, Medial, unit

Mask = NDArray[np.bool_]
Bounds = tuple[Mask, Mask]  # surely, possibly


def at_least(value: Array, limit: Array | float) -> Bounds:
    """value >= limit, where both are of the order of one."""
    return value >= limit + NEAR, value >= limit - NEAR


@dataclass(frozen=True)
class Cocone:
    """The definitions for one triangulation; t triangles in `triangles`, each with 3 corners."""

    medial: Medial
    cocone_angle: float = np.pi / 8
    flatness_ratio: float = 1.2
    flatness_angle: float = np.pi / 3

    @cached_property
    def triangles(self) -> Ints:
        """(t, 3) rows, ascending, sorted."""
        return np.array(sorted(self.medial.triangles), dtype=np.int64)

    @cached_property
    def normals(self) -> Array:
        """(k, 3) unit pole vectors."""
        vectors = self.medial.pole_vectors
        return vectors / np.maximum(np.linalg.norm(vectors, axis=1), 1e-300)[:, None]

    @cached_property
    def is_ray(self) -> Mask:
        """(t,) the dual Voronoi edge is a ray."""
        return np.array(
            [len(self.medial.triangles[tuple(t)]) == 1 for t in self.triangles.tolist()]
        )

    @cached_property
    def ends(self) -> Array:
        """(t, 3, 2, 3) from each corner to the ends of the dual Voronoi edge; of a ray the second is its direction."""
        medial, ends = self.medial, np.empty((len(self.triangles), 3, 2, 3))
        corners = medial.points[self.triangles]
        for row, key in enumerate(map(tuple, self.triangles.tolist())):
            centres = [medial.centres[cell] for cell, _ in medial.triangles[key]]
            ends[row, :, 0] = centres[0] - corners[row]
            ends[row, :, 1] = (
                unit(medial.rays[key]) if self.is_ray[row] else centres[1] - corners[row]
            )
        return ends

    @cached_property
    def heights(self) -> Array:
        """(t, 3, 2) sines of the angles between the ends and the corner's tangent plane."""
        product = np.einsum("tced,tcd->tce", self.ends, self.normals[self.triangles])
        return product / np.linalg.norm(self.ends, axis=3)

    # ---- thin

    @cached_property
    def crossings(self) -> tuple[Array, Array]:
        """(t, 3) bounds of the distance at which the dual edge crosses the corner's tangent plane; 0 where it does
        not. From its nearer end, which has more digits when the other is far."""
        lengths = np.linalg.norm(self.ends, axis=3)
        lengths[self.is_ray, :, 1] = np.inf
        swap = (lengths[:, :, 1] < lengths[:, :, 0])[:, :, None, None]
        near, far = np.moveaxis(np.where(swap, self.ends[:, :, ::-1], self.ends), 2, 0)
        step = np.where(self.is_ray[:, None, None], far, far - near)
        above, slope = (
            np.einsum("tcd,tcd->tc", x, self.normals[self.triangles]) for x in (near, step)
        )
        crosses = self.heights[:, :, 0] * self.heights[:, :, 1] < 0
        slope = np.where(crosses, slope, 1.0)
        moved = -(above / slope)[:, :, None] * step
        distance = np.linalg.norm(near + moved, axis=2)
        error = NEAR * (np.linalg.norm(near, axis=2) + np.linalg.norm(moved, axis=2))
        error *= np.linalg.norm(step, axis=2) / np.abs(slope)  # at a flat angle errors grow
        return np.where(crosses, distance - error, 0.0), np.where(crosses, distance + error, 0.0)

    @cached_property
    def widths(self) -> tuple[Array, Array]:
        """(k,) bounds of the radius of the cell's section with the tangent plane."""
        bounds = np.zeros((2, len(self.normals)))
        for width, crossings in zip(bounds, self.crossings):
            np.maximum.at(width, self.triangles, crossings)
        bounds[:, np.isinf(self.pole_distances).all(axis=0)] = (
            np.inf
        )  # rays on both sides: no end to it
        return bounds[0], bounds[1]

    @cached_property
    def pole_distances(self) -> Array:
        """(2, k) to the farthest Voronoi vertex above the tangent plane and below; 0 when there is none."""
        farthest = np.zeros((2, len(self.normals)))
        length = np.linalg.norm(self.ends, axis=3)
        length[self.is_ray, :, 1] = np.inf
        for side, sign in enumerate((1, -1)):
            there = sign * self.heights > 0
            corners = np.broadcast_to(self.triangles[:, :, None], there.shape)
            np.maximum.at(farthest[side], corners[there], length[there])
        return farthest

    @cached_property
    def thin(self) -> Bounds:
        height = self.pole_distances.min(axis=0)
        fits = [
            self.flatness_ratio * width <= height * slack
            for width, slack in zip(self.widths, (1 + NEAR, 1 - NEAR))
        ]
        possibly, surely = (x & (height > 0) & np.isfinite(self.widths[0]) for x in fits)
        return surely & ~self.medial.ambiguous, possibly | self.medial.ambiguous

    # ---- flat

    @cached_property
    def meets(self) -> Bounds:
        """(t, 3) the dual edge meets the corner's cocone: not when both ends are above it, or both below."""
        sine = np.sin(self.cocone_angle)
        misses = [
            np.any([(sign * self.heights >= sine + slack).all(axis=2) for sign in (1, -1)], axis=0)
            for slack in (-NEAR, NEAR)
        ]
        unsettled = self.medial.ambiguous[self.triangles]
        return ~misses[0] & ~unsettled, ~misses[1] | unsettled

    def neighbours(self, meets: Mask) -> Mask:
        """(k, k) row p, column q: q is a cocone neighbour of p."""
        found = np.zeros((len(self.normals),) * 2, dtype=bool)
        for corner in range(3):
            for other in {0, 1, 2} - {corner}:
                found[
                    self.triangles[meets[:, corner], corner],
                    self.triangles[meets[:, corner], other],
                ] = True
        return found

    @cached_property
    def agree(self) -> Bounds:
        """(k, k) the pole lines are within the flatness angle."""
        surely, possibly = at_least(
            np.abs(self.normals @ self.normals.T), np.cos(self.flatness_angle)
        )
        unsettled = self.medial.ambiguous[:, None] | self.medial.ambiguous[None]
        return surely & ~unsettled, possibly | unsettled

    @cached_property
    def flat(self) -> Bounds:
        few, many = (self.neighbours(meets) for meets in self.meets)
        return (
            self._grown(self.thin[0], many, few, self.agree[0]),
            self._grown(self.thin[1], few, many, self.agree[1]),
        )

    def _grown(self, thin: Mask, all_of: Mask, one_of: Mask, agree: Mask) -> Mask:
        flat = thin & (agree | ~all_of).all(axis=1)
        while True:
            grown = flat | (thin & (one_of & agree & flat).any(axis=1))
            if np.array_equal(grown, flat):
                return flat
            flat = grown

    # ---- candidates

    @cached_property
    def candidates(self) -> Bounds:
        """(t,) of `triangles`."""
        surely_flat, possibly_flat = (flat[self.triangles] for flat in self.flat)
        surely = surely_flat.any(axis=1) & (self.meets[0] | ~possibly_flat).all(axis=1)
        possibly = possibly_flat.any(axis=1) & (self.meets[1] | ~surely_flat).all(axis=1)
        return surely, possibly
