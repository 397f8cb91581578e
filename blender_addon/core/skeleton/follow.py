# SPDX-License-Identifier: GPL-3.0-or-later
"""Fit the pose of bones to the moved vertices of a mesh: the inverse of linear blend skinning.

Roots turn and move, all other bones turn about their heads, and no bone changes its length unless it may stretch. Bones
that stretch get a size along them and one across, which those that hang on them do not inherit. Joints stay connected
whatever the mesh does. Of all such poses it is the one whose skinned vertices are closest to the moved ones, by the sum
of squares. Each frame is fitted by itself: each bone by the turn that fits its own vertices best (Kabsch), and then all
joints together by damped Gauss-Newton steps (Levenberg and Marquardt).

A vertex counts only through sums over all vertices, which do not depend on the pose: of the products of weights and
places at rest for each two bones, once, and of places at rest and moved places, once for each frame. So the steps cost
the same for every mesh.

Where a frame has other vertices, each vertex at rest, as the pose before puts it, looks for the nearest place of the
mesh. The pose that fits these places puts it elsewhere, from where it looks again (Besl and McKay).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..small_matrices import closest_turns, dot, length_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

_MOST_STEPS = 40
_STILL = 1e-9  # radians: joints that turn less have arrived
_DAMPING = 1e-9, 1e6  # least and largest share of the diagonal that is added to it
_MOST_LOOKS = 60
_ARRIVED = 1e-4  # a share of the size: vertices that move less between two looks have arrived
_GROWTH = 0.5, 2.0  # the least and the largest change of a size in one step
_SIZES = 1.0 / 64.0, 64.0  # the least and the largest size of a bone that stretches
_NOWHERE = 1e-12  # a share of the mean diagonal for joints that no vertex tells anything about


@dataclass(frozen=True, eq=False)
class Pose:
    """A pose takes places at rest, x, to `turn @ stretch @ x + shift`.

    Parameters
    ----------
    turn : (b, 3, 3) float64
        Rotations.
    shift : (b, 3) float64
    stretch : (b, 3, 3) float64
        Symmetric: a size along each bone at rest, and another one across.
    """

    turn: NDArray[np.float64]
    shift: NDArray[np.float64]
    stretch: NDArray[np.float64]

    @property
    def linear(self) -> NDArray[np.float64]:
        """Return the transforms without their shifts, (b, 3, 3)."""
        return _products(self.turn, self.stretch)

    @property
    def matrices(self) -> NDArray[np.float64]:
        """Return the transforms, (b, 3, 4)."""
        return np.concatenate((self.linear, self.shift[:, :, None]), axis=2)


class Follower:
    """Fits poses of bones to meshes that have the vertices of a mesh at rest.

    Parameters
    ----------
    head : (b, 3) float64
        The heads of the bones at rest.
    parent : (b,) int32
        The bone on which each bone hangs, with a lower number; -1 for roots.
    points : (v, 3) float64
        The vertices at rest.
    vertex, bone : (w,) int64
        The vertex and the bone of each weight.
    weight : (w,) float64
        Positive; those of one vertex need not add up to 1. A vertex without a weight is not looked at.
    along : (b, 3) float64, optional
        The direction of each bone at rest, of length 1: bones stretch. Without it they keep their sizes.
    """

    def __init__(
        self,
        head: NDArray[np.float64],
        parent: NDArray[np.int32],
        points: NDArray[np.float64],
        vertex: NDArray[np.int64],
        bone: NDArray[np.int64],
        weight: NDArray[np.float64],
        along: NDArray[np.float64] | None = None,
    ) -> None:
        self._along = along
        total = np.bincount(vertex, weights=weight, minlength=len(points))
        self._count, self._parent = len(parent), parent
        self._held = np.flatnonzero(total > 0.0)
        self._centre = points[self._held].mean(axis=0)
        self._size = length_of(np.ptp(points[self._held], axis=0))
        self._unit = math.ldexp(1.0, math.frexp(self._size)[1])  # turns and shifts weigh the same
        self._head = (head - self._centre) / self._unit
        order = np.lexsort((vertex, bone))
        self._vertex, self._bone = vertex[order], bone[order]
        self._weight = weight[order] / total[self._vertex]
        self._first = np.searchsorted(self._bone, np.arange(self._count + 1))
        places = (points - self._centre) / self._unit
        self._places = np.column_stack((places, np.ones(len(places))))
        self._at_rest = self._weight[:, None] * self._places[self._vertex]
        self._own = self._sums(self._at_rest, self._places[self._vertex])
        self._pairs = self._sums_of_pairs()

    @property
    def size(self) -> float:
        """Return the diagonal of the box of the vertices at rest."""
        return self._size

    def pose(self, moved: NDArray[np.float64]) -> Pose:
        """Return the pose that fits the moved vertices, (v, 3), best."""
        at = (moved - self._centre) / self._unit
        sums = self._sums(at[self._vertex], self._at_rest)
        pose = self._start(sums)
        error, damping = self._error(pose, sums), _DAMPING[0]
        for _ in range(_MOST_STEPS):
            step = self._step(pose, sums, damping)
            tried = self._turned(pose, *step)
            found = self._error(tried, sums)
            if found < error:
                pose, error = tried, found
                damping = max(damping / 10.0, _DAMPING[0])
            else:
                damping *= 10.0
            if max(np.abs(step[0]).max(), np.abs(step[2]).max()) <= _STILL or damping > _DAMPING[1]:
                break
        return self._in_space(pose)

    def at_rest(self) -> Pose:
        """Return the pose that moves nothing."""
        same = np.tile(np.eye(3), (self._count, 1, 1))
        return Pose(same, np.zeros((self._count, 3)), same)

    def pose_near(
        self, start: Pose, nearest: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    ) -> tuple[Pose, NDArray[np.float64]]:
        """Return a pose near another one whose vertices lie on a mesh with other vertices, and its places, (v, 3).

        Parameters
        ----------
        start : Pose
        nearest : function of places, (v, 3)
            The nearest places of the mesh.
        """
        pose, at = start, self.skinned(start)
        for _ in range(_MOST_LOOKS):
            pose = self.pose(nearest(at))
            before, at = at, self.skinned(pose)
            if np.abs(at - before).max() <= _ARRIVED * self._size:
                break
        return pose, nearest(at)

    def skinned(self, pose: Pose) -> NDArray[np.float64]:
        """Return where a pose puts the vertices, (v, 3); those without a weight stay."""
        places = self._unit * self._places[:, :3] + self._centre
        places[self._held] = self._unit * self._put(pose)[self._held] + self._centre
        return places

    def main_bone(self) -> NDArray[np.int64]:
        """Return the bone that has the largest weight of each vertex, (v,); -1 for vertices without a weight."""
        bone = np.full(len(self._places), -1)
        order = np.argsort(self._weight, kind="stable")
        bone[self._vertex[order]] = self._bone[order]
        return bone

    def _put(self, pose: Pose) -> NDArray[np.float64]:
        """Return where a pose puts the vertices, in the frame of the sums; 0 for those without a weight."""
        shift = (_shifted(pose, self._centre) - self._centre) / self._unit
        here = Pose(pose.turn, shift, pose.stretch)
        placed = _times_rows(here.matrices[self._bone], self._at_rest)
        count = len(self._places)
        return np.column_stack([np.bincount(self._vertex, placed[:, k], count) for k in range(3)])

    def off(self, pose: Pose, moved: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far each vertex is from where the pose puts it, (v,); 0 for vertices without a weight."""
        off = np.zeros(len(self._places))
        apart = self._put(pose) - (moved - self._centre) / self._unit
        off[self._held] = self._unit * np.sqrt((apart[self._held] ** 2).sum(axis=1))
        return off

    def share_beyond(
        self, off: NDArray[np.float64], limit: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the share of the weights of each bone at vertices that are off, (v,), by more than its limit, (b,)."""
        beyond = off[self._vertex] > limit[self._bone]
        part = np.bincount(self._bone, self._weight * beyond, self._count)
        return part / self._whole

    def thickness(
        self, head: NDArray[np.float64], tail: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the mean distance of the vertices of each bone from it, (b,), by weight; 0 without vertices."""
        along = (tail - head) / self._unit
        square = dot(along, along)
        from_head = self._places[self._vertex, :3] - self._head[self._bone]
        share = dot(from_head, along[self._bone]) / np.where(square > 0.0, square, 1.0)[self._bone]
        apart = from_head - np.clip(share, 0.0, 1.0)[:, None] * along[self._bone]
        away = self._unit * np.sqrt(dot(apart, apart))
        return np.bincount(self._bone, self._weight * away, self._count) / self._whole

    @property
    def _whole(self) -> NDArray[np.float64]:
        """Return the sum of the weights of each bone, (b,); 1 for bones without any."""
        whole = np.bincount(self._bone, self._weight, self._count)
        return np.where(whole > 0.0, whole, 1.0)

    # --- sums over vertices

    def _sums(self, left: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the sums over the vertices of each bone of products of rows, (b, i, j)."""
        products = np.array(
            [
                [np.add.reduceat(left[:, i] * right[:, j], self._starts) for j in range(4)]
                for i in range(left.shape[1])
            ]
        )
        found = np.zeros((self._count, left.shape[1], 4))
        found[self._used] = np.moveaxis(products, 2, 0)
        return found

    @property
    def _used(self) -> NDArray[np.int64]:
        """Return the bones that have vertices."""
        return np.flatnonzero(np.diff(self._first))

    @property
    def _starts(self) -> NDArray[np.int64]:
        return self._first[self._used]

    def _sums_of_pairs(self) -> NDArray[np.float64]:
        """Return the sums of w_b w_c x x^T over the vertices that bones b and c share, (b, b, 4, 4)."""
        found = np.zeros((self._count, self._count, 4, 4))
        of_bone = np.zeros(len(self._places))
        for bone in self._used:
            rows = slice(self._first[bone], self._first[bone + 1])
            of_bone[self._vertex[rows]] = self._weight[rows]
            found[bone] = self._sums(
                of_bone[self._vertex, None] * self._at_rest, self._places[self._vertex]
            )
            of_bone[self._vertex[rows]] = 0.0
        return found

    # --- the fit

    def _start(self, sums: NDArray[np.float64]) -> Pose:
        """Return the pose in which each bone turns as its own vertices do best, whatever the others do."""
        mass = self._own[:, 3, 3]
        safe = np.where(mass > 0.0, mass, 1.0)
        middle, at = self._own[:, :3, 3] / safe[:, None], sums[:, :, 3] / safe[:, None]
        spread = sums[:, :, :3] - mass[:, None, None] * at[:, :, None] * middle[:, None, :]
        turn, known = closest_turns(spread)
        shift = np.zeros((self._count, 3))
        for bone, parent in enumerate(self._parent.tolist()):
            if not known[bone]:
                turn[bone] = turn[parent] if parent >= 0 else np.eye(3)
            if parent < 0:
                shift[bone] = at[bone] - _times(turn[bone], middle[bone])
        return self._jointed(turn, np.tile(np.eye(3), (self._count, 1, 1)), shift)

    def _jointed(
        self,
        turn: NDArray[np.float64],
        stretch: NDArray[np.float64],
        root_shift: NDArray[np.float64],
    ) -> Pose:
        """Return a pose with these turns and sizes, in which the head of each bone follows its parent."""
        shift, linear = root_shift.copy(), _products(turn, stretch)
        for bone, parent in enumerate(self._parent.tolist()):
            if parent >= 0:
                place = _times(linear[parent], self._head[bone]) + shift[parent]
                shift[bone] = place - _times(linear[bone], self._head[bone])
        return Pose(turn, shift, stretch)

    def _error(self, pose: Pose, sums: NDArray[np.float64]) -> float:
        """Return the sum of squares, up to a number that does not depend on the pose."""
        moves = pose.matrices
        of_pairs = _products(moves[:, None], self._pairs)
        return float((of_pairs * moves[None]).sum() - 2.0 * (moves * sums).sum())

    def _step(
        self, pose: Pose, sums: NDArray[np.float64], damping: float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return by how much each joint turns and each root moves, (b, 3), and each bone grows, (b, 2), in shares."""
        motions, free = self._motions(pose)
        matrix, right = self._normal_equations(motions, pose, sums)
        diagonal = np.diagonal(matrix)
        matrix[np.diag_indices(len(matrix))] += damping * diagonal + _NOWHERE * diagonal.mean()
        step = np.zeros(free.shape)
        step[free] = _solved(matrix, right)
        return step[:, :3], step[:, 3:6], step[:, 6:]

    def _motions(self, pose: Pose) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """Return how fast posed places move, (p, b, 3, 4), with each thing that is free, and what is free, (b, 8).

        A place y on a bone moves by `motion[:, :3] @ y + motion[:, 3]`. Free are turns about the head and shifts, by
        three axes each, and the sizes along and across. All that hangs on a bone turns and moves with it, and is
        carried along by its growth.
        """
        count, axes = self._count, np.eye(3)
        head = _times_rows(pose.matrices, np.column_stack((self._head, np.ones(count))))
        below, via = self._below()
        found = np.zeros((count, 8, count, 3, 4))
        about = np.tile(_cross(axes), (count, 1, 1, 1))
        found[:, :3, :, :, :3] = about[:, :, None] * below[:, None, :, None, None]
        found[:, :3, :, :, 3] = (
            -_times(about, head[:, None, None])[:, :, None] * below[:, None, :, None]
        )
        found[:, 3:6, :, :, 3] = axes[None, :, None] * below[:, None, :, None]
        grown = self._growths(pose)
        carried = np.where(below[..., None], head[via] - head[:, None], 0.0)
        found[:, 6:, :, :, 3] = _times(grown[:, :, None], carried[:, None, :, None])
        own = np.arange(count)
        found[own, 6:, own, :, :3] = grown
        found[own, 6:, own, :, 3] = -_times(grown, head[:, None, None])
        free = np.ones((count, 8), bool)
        free[self._parent >= 0, 3:6] = False
        free[:, 6:] = self._along is not None
        return found[free], free

    def _below(self) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
        """Return which bones, (b, b), move with each, itself among them, and on which child of it they hang, or are."""
        below, via = (
            np.eye(self._count, dtype=bool),
            np.tile(np.arange(self._count), (self._count, 1)),
        )
        np.fill_diagonal(via, np.arange(self._count))
        for bone, parent in enumerate(self._parent.tolist()):
            if parent >= 0:
                below[:, bone] |= below[:, parent]
                via[:, bone] = via[:, parent]
                via[parent, bone] = bone
        return below, via

    def _growths(self, pose: Pose) -> NDArray[np.float64]:
        """Return what a share of growth of each bone does to places round its head, along and across, (b, 2, 3, 3)."""
        if self._along is None:
            return np.zeros((self._count, 2, 3, 3))
        way = _times_rows(pose.turn, self._along)
        line = way[:, :, None] * way[:, None, :]
        return np.stack((line, np.eye(3) - line), axis=1)

    def _normal_equations(
        self, motions: NDArray[np.float64], pose: Pose, sums: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the matrix, (p, p), and the right side, (p,), of a Gauss-Newton step."""
        moves = np.zeros((self._count, 4, 4))
        moves[:, :3], moves[:, 3, 3] = pose.matrices, 1.0
        pairs = _products(_products(moves[:, None], self._pairs), moves.swapaxes(1, 2)[None])
        rest = _products(moves, sums.swapaxes(1, 2)) - pairs.sum(axis=1)[:, :, :3]
        met = np.zeros_like(motions)
        for bone in range(self._count):
            for k in range(4):
                met += motions[:, bone, None, :, k, None] * pairs[bone, :, k][None, :, None, :]
        met, flat = (table.reshape(len(motions), -1) for table in (met, motions))
        matrix, right = np.zeros((len(flat), len(flat))), np.zeros(len(flat))
        offs = rest.swapaxes(1, 2).ravel()
        for column in range(flat.shape[1]):
            matrix += met[:, column, None] * flat[None, :, column]
            right += flat[:, column] * offs[column]
        return matrix, right

    def _turned(
        self,
        pose: Pose,
        turn: NDArray[np.float64],
        shift: NDArray[np.float64],
        growth: NDArray[np.float64],
    ) -> Pose:
        """Return the pose after each joint has turned about its head, each root has moved, and bones have grown."""
        whole = turn.copy()
        for bone, parent in enumerate(self._parent.tolist()):
            if parent >= 0:
                whole[bone] += whole[parent]
        roots = self._parent < 0
        head = _times_rows(pose.matrices, np.column_stack((self._head, np.ones(self._count))))
        turned, stretch = _products(_turns(whole), pose.turn), self._grown(pose, growth)
        there = head + shift - _times(_products(turned, stretch), self._head[:, None])
        return self._jointed(turned, stretch, np.where(roots[:, None], there, 0.0))

    def _grown(self, pose: Pose, growth: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the stretch of a pose after bones have grown by shares of their sizes along and across, (b, 2)."""
        if self._along is None:
            return pose.stretch
        line = self._along[:, :, None] * self._along[:, None, :]
        along = (line * pose.stretch).sum(axis=(1, 2))
        across = (np.trace(pose.stretch, axis1=1, axis2=2) - along) / 2.0
        sizes = np.stack((along, across), axis=1) * np.clip(1.0 + growth, *_GROWTH)
        a, b = np.clip(sizes, *_SIZES).T[:, :, None, None]
        return np.asarray(b * np.eye(3) + (a - b) * line)

    def _in_space(self, pose: Pose) -> Pose:
        """Return the same pose for places in the unit of the mesh, which are not counted from its centre."""
        back = Pose(pose.turn, self._unit * pose.shift, pose.stretch)
        return Pose(pose.turn, _shifted(back, -self._centre) + self._centre, pose.stretch)


def _shifted(pose: Pose, by: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the shifts of a pose for places that are counted from another origin."""
    return pose.shift + (pose.linear * by).sum(axis=2)


def _times(matrix: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray((matrix * vector).sum(axis=-1))


def _times_rows(matrices: NDArray[np.float64], rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return each matrix, (n, 3, 4), times its row, (n, 4)."""
    return np.asarray((matrices * rows[:, None, :]).sum(axis=2))


def _products(left: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the products of matrices, (..., i, k) and (..., k, j), term by term in one order."""
    found = left[..., :, 0, None] * right[..., 0, None, :]
    for k in range(1, right.shape[-2]):
        found = found + left[..., :, k, None] * right[..., k, None, :]
    return found


def _cross(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the matrices, (..., 3, 3), that multiply by vectors, (..., 3), from the left as in a cross product."""
    found = np.zeros((*vectors.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        found[..., i, j], found[..., j, i] = -vectors[..., k], vectors[..., k]
    return found


def _turns(by: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return rotations about vectors, by nearly their length in radians, (n, 3, 3); they need no sines (Cayley)."""
    half = _cross(by / 2.0)
    square = _products(half, half)
    shrink = 2.0 / (1.0 + (by * by).sum(axis=1) / 4.0)
    return np.asarray(np.eye(3) + shrink[:, None, None] * (half + square))


def _solved(matrix: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the solution for a positive definite matrix, (n, n), by elimination; both arguments are overwritten."""
    count = len(right)
    for k in range(count - 1):
        row = matrix[k, k + 1 :] / matrix[k, k]
        matrix[k + 1 :, k + 1 :] -= row[:, None] * matrix[k, k + 1 :]
        right[k + 1 :] -= row * right[k]
    found = np.zeros(count)
    for k in range(count - 1, -1, -1):
        found[k] = (right[k] - (matrix[k, k + 1 :] * found[k + 1 :]).sum()) / matrix[k, k]
    return found
