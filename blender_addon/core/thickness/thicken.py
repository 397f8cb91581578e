# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin walls moved apart until they are as thick as a limit, and measured again.

A ball between two walls touches both, so both have its diameter as thickness. Where each wall moves outward by half of
what is missing, the ball grows by that on both sides and keeps its centre. Walls that change in between are corrected
in further rounds.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Flags, Floats, Longs
from ..errors import InvalidInputError
from ..machine import native
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.chosen import ChosenSamples
from ..samples.density import percent
from ..samples.mesh_parts import check_no_sheet
from ..settings import Edges, Moving, Settings, ThickenSettings, ThicknessSettings
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from ..shape.solid_faces import sharp_angle_of
from ..shape.triangles import unit_normals
from ..small_matrices import dot
from .face_gaps import face_gaps
from .face_lengths import MeasuredFaces, are_enough, first_rows
from .fans import fans_of
from .measurement import Measurement
from .thickness import measure_thickness
from .thin_in_part import subdivided, thin_in_part
from .thin_parts import ThinParts, find_thin_parts

_ROUNDS = 8  # at most; two or three suffice where walls are not much curved
_HALVES = 2  # so many rounds give each of two walls half
_OF_GAP = 0.45  # of a gap: the opposite wall may take as much; chosen: unseen
_BEYOND = 1e-4  # walls gain this share of the limit more, so that few rounds leave none below it; derived: rounding
_HALVINGS = 5  # of the way of faces that would pass through others, before they stay
_FARTHEST = 3.0  # times the largest gain: no vertex moves farther; chosen: unseen


@dataclass(frozen=True, eq=False)
class Thickened:
    """A shape with thicker walls."""

    moves: Floats  # (v, 3) How far each vertex of `before.shape` moves
    before: Measurement
    after: Measurement
    left: ThinParts  # The parts that are thinner than the limit afterwards
    # The narrowest gap that kept walls from gaining all that they lack; infinite where there is none
    gap: float
    warnings: tuple[str, ...]
    seconds: float

    @property
    def chosen(self) -> ChosenSamples | MeasuredFaces:
        """How the shape was measured before."""
        return self.before.chosen


def thicken(
    shape: Shape,
    settings: Settings,
    wanted: ThickenSettings,
    selected: Flags | None = None,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> Thickened:
    """Move the thin walls of a solid apart.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        Its options of sampling decide where the thickness is measured.
    wanted : ThickenSettings
        With `subdivide` the moves are those of the divided shape, which is that of `Thickened.before`.
    selected : (m,) bool, optional
        The triangles that may move, where `wanted.moving` is SELECTED.
    progress : Progress, optional
    limit : MemoryLimit

    Raises
    ------
    InvalidInputError
        The limit is not above 0, or the faces do not bound a solid by themselves.
    NativeModuleError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start, progress = time.perf_counter(), progress or Progress()
    if not wanted.limit > 0.0:
        raise InvalidInputError("Expected a limit above 0, found 0; set Limit to the least wall")
    shape = outward_shape(shape)
    _check_faces(shape, settings, wanted)
    if wanted.subdivide:
        shape, face = subdivided(shape, settings, wanted.limit)
        selected = None if selected is None else selected[face]
    progress.begin_section(0.0, 1.0 / (_ROUNDS + 2))

    def measured(shape: Shape, edges: Edges) -> Measurement:
        return measure_thickness(shape, settings, _asked(wanted, edges), progress, limit)

    before = measured(shape, Edges.EXTRAPOLATE)
    walls = _Walls(before, settings, wanted, selected)
    moves, overlap = _settled(walls, settings, wanted, measured, progress)
    moves, crossed = walls.without_crossings(moves)
    after = measured(walls.shape_of(moves), Edges.EXTRAPOLATE)
    left = find_thin_parts(after, wanted.limit)
    met = crossed or overlap
    told = [walls.crossed()] if met else []
    warnings = (*walls.warnings(), *told, *_left_over(left, bool(moves.any()), met))
    seconds = time.perf_counter() - start
    return Thickened(moves, before, after, left, walls.narrowest, warnings, seconds)


def _settled(
    walls: _Walls,
    settings: Settings,
    wanted: ThickenSettings,
    measured: Callable[[Shape, Edges], Measurement],
    progress: Progress,
) -> tuple[Floats, bool]:
    """(v, 3) the moves after which nothing lacks or no round helps, and whether farther ones make walls overlap."""
    moves = last = np.zeros_like(walls.points)
    best = walls.missing
    for number in range(1, _ROUNDS + 1):
        progress.begin_section(number / (_ROUNDS + 2), (number + 1) / (_ROUNDS + 2))
        # At first only places between walls move where there are edges, so that rims of plates stay.
        edges = Edges.GREY if number == 1 else Edges.EXTRAPOLATE
        moved = walls.shape_of(moves)
        if number > 1 and not are_enough(moved, settings, _asked(wanted, edges)):
            moves, _ = walls.without_crossings(moves)
            apart = are_enough(walls.shape_of(moves), settings, _asked(wanted, edges))
            return moves if apart else last, True
        found = measured(moved, edges)
        if number == 1:
            _check_size(found, wanted.limit)
        else:
            lack = _missing(found, wanted.limit)
            if lack == 0.0:
                break
            if lack >= best:
                return last, False
            best = lack
        last = moves
        moves = walls.moved_for(found, moves, number)
    return moves, False


def _asked(wanted: ThickenSettings, edges: Edges) -> ThicknessSettings:
    return ThicknessSettings(limit=wanted.limit, edges=edges)


def _check_faces(shape: Shape, settings: Settings, wanted: ThickenSettings) -> None:
    """Raise InvalidInputError where the faces do not bound a solid by themselves, DegenerateInputError of a sheet."""
    if not are_enough(shape, settings, _asked(wanted, Edges.EXTRAPOLATE)):
        check_no_sheet(shape)
        raise InvalidInputError(
            "Expected closed faces that bound one solid, found faces that are open, overlap or lie inside it; close "
            "the mesh or remesh it, then thicken it"
        )


def _check_size(found: Measurement, limit: float) -> None:
    """Raise InvalidInputError where a thin place lies in a large face, whose vertices are elsewhere."""
    count = int(thin_in_part(found, limit).sum())
    if count:
        raise InvalidInputError(
            f"Expected faces that are thin as a whole or not at all, found {count:,} large ones that are thin in part; "
            "Subdivide divides them, so that their vertices can rise where the wall is thin"
        )


def _missing(found: Measurement, limit: float) -> float:
    """The volume that thin walls lack, about."""
    lack = np.maximum(limit - found.slack - found.of_walls, 0.0)
    return float((lack * found.areas).sum())


def _left_over(left: ThinParts, moved: bool, met: bool) -> tuple[str, ...]:
    """Say why something is still thin: other walls were in the way, a step helps nothing, or vertices are missing."""
    if not left.told:
        return ()
    why = "tips and edges that taper stay, and coarse faces need a subdivision"
    if met:
        why = "make room between the walls, or take a smaller limit"
    elif not moved:
        why = "nothing moved, as a step would make more of it thin; take a smaller limit"
    share, least = percent(left.share), left.patches[0].minimum
    return (f"{share} of the surface is still thinner than the limit, down to {least:.3g}: {why}",)


class _Walls:
    """The walls as they were, and how far each of them may move."""

    def __init__(
        self,
        found: Measurement,
        settings: Settings,
        wanted: ThickenSettings,
        selected: Flags | None,
    ) -> None:
        self._shape, self._wanted = found.shape, wanted
        self._row = first_rows(self._shape.points)
        self._triangles = np.ascontiguousarray(self._row[self._shape.triangles].astype(np.int32))
        self._angle = sharp_angle_of(self._shape, settings)
        with native.own_errors() as module:
            sharp, _, _ = module.BallFaces(
                self._shape.points,
                self._triangles,
                sharp_angle=self._angle,
                sharp_edges=self._shape.sharp_edges,
            ).creases()
        self._fans = fans_of(self._shape.points, self._triangles, sharp)
        # Where a part has no edges, all that is thin moves, its round ends too.
        self._smooth = self._fans.of_smooth_parts(sharp)
        self._lack_of_smooth = self._lack(found)
        self.missing = _missing(found, wanted.limit)
        self._share = 1.0 if wanted.moving is Moving.SELECTED else 0.5
        self._still = self._staying(selected)
        self._may_move = ~self._still
        self._most = np.full(len(self._fans.vertex), np.inf)
        self._asked = np.zeros(len(self._fans.vertex), bool)
        self._held = np.zeros(len(self._shape.points), bool)
        self.narrowest = self._met = float("inf")

    def _staying(self, selected: Flags | None) -> Flags:
        """(k,) the fans that stay where they are: those of triangles that are not selected, if only these move."""
        still = np.zeros(len(self._fans.vertex), bool)
        if self._wanted.moving is Moving.SELECTED:
            chosen = np.zeros(len(self._triangles), bool) if selected is None else selected
            still[self._fans.of_corners[~chosen]] = True
        return still

    @property
    def points(self) -> Floats:
        """(v, 3) where the vertices were."""
        return self._shape.points

    def shape_of(self, moves: Floats) -> Shape:
        return replace(self._shape, points=self._shape.points + moves)

    def moved_for(self, found: Measurement, moves: Floats, number: int) -> Floats:
        """(v, 3) the moves after another round, from round 1 on."""
        points = self._shape.points + moves
        # Walls that are still thin after some rounds lack very little, or the opposite wall may gain no more.
        share = self._share if number <= _HALVES else 1.0
        lack = self._lack(found)
        if number == 1:
            lack[self._smooth] = self._lack_of_smooth[self._smooth]
        gain = np.where(self._may_move, share * lack, 0.0)
        if not gain.any():
            return moves
        width = self._wanted.blend or self._wanted.limit
        gain = self._fans.spread(points, gain, float(gain.max()) / width)
        gain[self._still] = 0.0
        self._may_move &= gain > 0.0
        self._look_across(gain > 0.0)
        gone = dot(moves[self._fans.vertex], self._fans.normal)
        gain = np.minimum(gain, np.maximum(self._most - gone, 0.0))
        step = self._fans.offsets(len(points), gain)
        length = np.linalg.norm(step, axis=1)
        most = _FARTHEST * gain.max()
        step *= np.minimum(1.0, most / np.where(length > 0.0, length, 1.0))[:, None]
        return moves + self._without_turns(points, step[self._row])

    def _lack(self, found: Measurement) -> Floats:
        """(k,) what each fan lacks to the limit: at its vertex, or on edges and coarse faces at its triangles."""
        limit = self._wanted.limit * (1.0 + _BEYOND)
        lengths = found.of_walls
        thin = lengths < self._wanted.limit - found.slack
        piece = found.surface.face_of_triangles
        faces = np.arange(len(found.triangles)) if piece is None else piece
        of_faces = np.full(len(self._triangles), np.inf)
        np.minimum.at(of_faces, faces[thin], lengths[thin])
        elsewhere = (found.at_edge | ~found.measured)[: len(self._row)][self._row]
        own = np.where(elsewhere, np.inf, found.of_vertices[self._row])[self._triangles]
        at_corners = np.where(np.isfinite(own), own, of_faces[:, None])
        at_corners[~np.isfinite(of_faces)] = np.inf
        if found.triangles is not self._shape.triangles:
            at_corners = np.minimum(at_corners, of_faces[:, None])
        lack = np.zeros(len(self._fans.vertex))
        np.maximum.at(lack, self._fans.of_corners, np.maximum(limit - at_corners, 0.0))
        return lack

    def _look_across(self, moving: Flags) -> None:
        """Find how far fans may move at most: the walls of a narrow gap must not meet."""
        fresh = (moving & ~self._asked)[self._fans.of_corners].any(axis=1)
        self._asked |= moving
        rows = np.flatnonzero(fresh)
        if not len(rows):
            return
        corners = self._shape.points[self._triangles[rows]]
        size = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean(axis=1)
        with native.own_errors() as module:
            outside = module.BallFaces(
                self._shape.points,
                np.ascontiguousarray(self._triangles[:, ::-1]),
                sharp_angle=self._angle,
                sharp_edges=self._shape.sharp_edges,
                smooth=False,
            )
            _, gap, _ = outside.inscribed_balls(
                corners.mean(axis=1),
                rows.astype(np.int32),
                size,
                normals=-unit_normals(corners)[0],
            )
        np.minimum.at(self._most, self._fans.of_corners[rows], _OF_GAP * gap[:, None])

    def without_crossings(self, moves: Floats) -> tuple[Floats, bool]:
        """(v, 3) the moves, less where faces would pass through each other, and whether any would.

        Corners of such faces go half as far, and half of that, and at last nowhere: then the faces are as they were.
        """
        known = self._pairs(self._shape)
        share, number = np.ones(len(moves)), 0
        while True:
            moved = moves * share[self._row, None]
            pairs = np.setdiff1d(self._pairs(self.shape_of(moved)), known)
            if not len(pairs):
                return moved, number > 0
            number += 1
            low, high = np.divmod(pairs, len(self._triangles))
            self._met = min(self._met, self._gap_between(low, high))
            rows = self._triangles[np.concatenate((low, high))]
            share[np.unique(rows)] *= 0.5 if number <= _HALVINGS else 0.0

    def _gap_between(self, low: Longs, high: Longs) -> float:
        """Return the least gap that there was between pairs of faces that share no corner."""
        shared = self._triangles[low][:, :, None] == self._triangles[high][:, None]
        apart = ~shared.any(axis=(1, 2))
        corners = self._shape.points[self._triangles]
        gaps = face_gaps(corners[low[apart]], corners[high[apart]])
        return float(gaps.min(initial=np.inf))

    def crossed(self) -> str:
        """Say that faces would pass through each other, and across which gap, which is the narrowest then."""
        if not self._met < np.inf:
            return "walls would run into each other where they gained all that they lack, so they gained less"
        self.narrowest = min(self.narrowest, self._met)
        return (
            "walls would run into each other where they gained all that they lack, across gaps down to "
            f"{self._met:.3g}, so they gained less"
        )

    def _pairs(self, shape: Shape) -> Longs:
        """(p,) a number for each pair of faces that pass through each other."""
        low, high = shape.crossing.astype(np.int64).T
        return np.asarray(low * len(self._triangles) + high)

    def _without_turns(self, points: Floats, step: Floats) -> Floats:
        """The step without the vertices of triangles that it would turn over."""
        before, _ = unit_normals(points[self._triangles])
        while True:
            step[self._held[self._row]] = 0.0
            after, _ = unit_normals((points + step)[self._triangles])
            turned = dot(before, after) < 0.0
            if not turned.any():
                return step
            self._held[self._triangles[turned]] = True

    def warnings(self) -> tuple[str, ...]:
        found = []
        gaps = self._most[np.isfinite(self._most)] / _OF_GAP
        wanted = self._share * self._wanted.limit
        narrow = gaps[gaps * _OF_GAP < wanted]
        if len(narrow):
            least = float(narrow.min())
            self.narrowest = min(self.narrowest, least)
            found.append(
                f"gaps down to {least:.3g} are narrower than what their walls may gain; there the walls gain "
                "less, so that they do not meet; Measure Gap shows where"
            )
        if self._held.any():
            found.append(
                f"{int(self._held.sum()):,} vertices stay where they are, because their faces would turn over"
            )
        return tuple(found)
