# SPDX-License-Identifier: GPL-3.0-or-later
"""A solid hollowed to a wall: its own faces, and inside the surface at that distance from them (docs/hollow.md)."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats, Ints
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..samples.buried_samples import bounding_share
from ..samples.mesh_parts import check_no_sheet
from ..settings import HollowSettings
from ..shape.outward_faces import outward_shape, reading_warnings
from ..shape.own_frame import rounding_warning
from ..shape.shape import Shape
from ..shape.triangle_faces import TriangleFaces
from ..small_matrices import dot, length_of
from ..united import united
from .offset_surface import COARSEST, OffsetSurface, offset_surface

_WALL = 0.03  # of the diagonal: the wall where none is asked for; chosen: unseen
_FINEST = 0.25  # of the wall: the step where nothing else is asked for; chosen: unseen
# The step grows until the faces have the area of so many of its squares, which take about ten seconds.
_SQUARES = 75_000
_MOST = 2_000_000  # so many are made where a step is asked for: each gives about twelve triangles
_ROUNDED_UP = 1.05  # times it, a length with two digits is not less; derived: half of a digit
_BOUNDING = 0.999  # where less of the faces bounds the solid, a warning says so; chosen: unseen


@dataclass(frozen=True, eq=False)
class Hollow(TriangleFaces):
    """A solid with a cavity."""

    vertices: Floats  # (v, 3) The points of the shape, in its frame, then those of the cavity
    # (f, 3) The triangles of the shape, outward, then those of the cavity, which look into it
    triangles: Ints
    outer: int  # So many triangles are those of the shape
    wall: float  # The wall that was asked for
    step: float  # The edge of the cubes of the lattice
    least: float  # Nowhere is the wall thinner: a bound, not a measurement
    deepest: float  # The greatest distance of the middle of a triangle of the cavity from the faces
    # The volumes of what is left, and of the solid before
    volume: float
    solid_volume: float
    cavities: int  # The connected spaces in the solid
    # The walls that are not connected with the outer one: those round cavities that the solid had
    loose: int
    shape: Shape
    warnings: tuple[str, ...]
    seconds: float
    duplicates: int = 0
    chosen: None = None  # nothing is sampled

    @property
    def points(self) -> int:
        """The number of vertices of the solid."""
        return len(self.shape.points)

    @property
    def cavity(self) -> Floats:
        """(k, 3) the vertices of the cavity."""
        return self.vertices[self.points :]


def hollow(shape: Shape, wanted: HollowSettings, progress: Progress | None = None) -> Hollow:
    """Hollow a solid.

    Parameters
    ----------
    shape : Shape
    wanted : HollowSettings
    progress : Progress, optional

    Raises
    ------
    InvalidInputError
        The faces do not enclose a solid, or no place in it is so far from them.
    DegenerateInputError
        The faces are an open sheet.
    NativeModuleError, OutOfMemoryError, Cancelled
    """
    start, progress = time.perf_counter(), progress or Progress()
    shape = outward_shape(shape)
    _check(shape)
    diagonal = length_of(np.ptp(shape.points[shape.triangles.ravel()], axis=0))
    wanted = replace(wanted, wall=wanted.wall or _WALL * diagonal)
    faces = shape.triangles[~shape.left_out]
    step = _step(shape, wanted)
    surface = _surface(shape.points, faces, wanted.wall, step, progress)
    if not len(surface.triangles):
        raise InvalidInputError(
            f"Expected a solid that is thicker than two walls of {wanted.wall:g} by more than a voxel of {step:.2g} "
            "somewhere, found none; take a thinner wall or smaller voxels, or keep it solid"
        )
    return _shell(shape, faces, surface, wanted.wall, step, progress, start)


def _check(shape: Shape) -> None:
    if not len(shape.triangles) or shape.open_edges or not shape.volume > 0.0:
        check_no_sheet(shape)
        raise InvalidInputError(
            "Expected closed faces that enclose a solid, found none or open ones; close the mesh, or reconstruct its "
            "surface, then hollow it"
        )


def _step(shape: Shape, wanted: HollowSettings) -> float:
    """The edge of the cubes of the lattice."""
    chosen = wanted.voxel_size > 0.0
    finest = (shape.area / (_MOST if chosen else _SQUARES)) ** 0.5
    step = wanted.voxel_size if chosen else max(_FINEST * wanted.wall, finest)
    step = min(step, COARSEST * wanted.wall)
    if step < finest:
        least = _ROUNDED_UP * finest
        if not chosen:
            raise InvalidInputError(
                f"Expected a wall of at least {least / COARSEST:.2g} for a surface of this size, found "
                f"{wanted.wall:g}, which takes minutes; take a thicker wall, or set Voxel Size to {step:.2g} and wait"
            )
        raise InvalidInputError(
            f"Expected a wall of at least {least / COARSEST:.2g}, or voxels of {least:.2g}, for a surface of this "
            f"size, found {wanted.wall:g} and {step:.2g}; take a thicker wall or larger voxels"
        )
    return step


def _surface(
    points: Floats, faces: Ints, wall: float, step: float, progress: Progress
) -> OffsetSurface:
    with own_errors() as module:
        tree = module.TriangleTree(points, faces)

    def distances(places: Floats) -> Floats:
        with own_errors():
            return np.asarray(tree.distances(places, progress=progress.part(0.3)))

    def winding(places: Floats) -> Floats:
        with own_errors() as module:
            return np.asarray(module.winding_number(places, points, faces))

    used = points[faces.ravel()]
    return offset_surface(used.min(axis=0), used.max(axis=0), wall, step, distances, winding)


def _shell(
    shape: Shape,
    faces: Ints,
    surface: OffsetSurface,
    wall: float,
    step: float,
    progress: Progress,
    start: float,
) -> Hollow:
    count = len(shape.points)
    inner = surface.triangles[:, ::-1] + np.int32(count)
    middles = surface.vertices[surface.triangles].mean(axis=1)
    with own_errors() as module:
        depths = module.TriangleTree(shape.points, faces).distances(
            middles, progress=progress.part()
        )
    volumes = _volumes(surface)
    # A space has one surface round it, and one more round each wall that stands in it.
    cavities, loose = int((volumes > 0.0).sum()), int((volumes < 0.0).sum())
    rounded = filter(None, [rounding_warning(shape, step, "voxels measure")])
    return Hollow(
        np.concatenate((shape.points, surface.vertices)),
        np.concatenate((faces, inner)),
        len(faces),
        wall,
        step,
        float(least_distances(surface).min()),
        float(np.max(depths)),
        shape.volume - float(volumes.sum()),
        shape.volume,
        cavities,
        loose,
        shape,
        (*reading_warnings(shape), *rounded, *_warnings(shape, cavities, loose, step)),
        time.perf_counter() - start,
    )


def _warnings(shape: Shape, cavities: int, loose: int, step: float) -> tuple[str, ...]:
    found = []
    if bounding_share(shape, step) < _BOUNDING:
        found.append(
            "faces overlap or lie inside the solid, and walls stand around these, too; unite the parts first "
            "(a Boolean or Remesh modifier)"
        )
    if cavities > 1:
        found.append(
            f"the solid is hollow in {cavities:,} places that are not connected; a hole drains one of them"
        )
    if loose:
        found.append(
            f"walls round cavities that the solid had lie loose in the hollow, {loose:,} in all; fill these cavities "
            "first, or join the walls by bars"
        )
    return tuple(found)


def least_distances(surface: OffsetSurface) -> Floats:
    """(t,) a bound for the distance of every point of each triangle from the faces.

    Let p be a place on the faces, and x a point of a triangle: a mean of its corners. The mean of the squared distances
    of the corners from p is the squared distance of x from p and the mean of those of the corners from x, which is at
    most the square of the radius r of the smallest ball round the triangle. So all of the triangle is at least
    sqrt(d^2 - r^2) from the faces, if its corners are at least d from them.
    """
    corners = surface.vertices[surface.triangles]
    a, b, c = np.sort(np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2), axis=1).T
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    doubled = np.linalg.norm(np.cross(first, second), axis=1)
    sharp = a * a + b * b > c * c
    radius = np.where(sharp, a * b * c / np.where(sharp, 2.0 * doubled, 1.0), 0.5 * c)
    near = surface.distances[surface.triangles].min(axis=1)
    return np.sqrt(np.maximum(near * near - radius * radius, 0.0))


def _volumes(surface: OffsetSurface) -> Floats:
    """(k,) the volume in each connected part of the surface, negative where the hollow is outside of it."""
    label = united(len(surface.vertices), surface.triangles[:, [0, 1, 1, 2]].reshape(-1, 2))
    _, part = np.unique(label[surface.triangles[:, 0]], return_inverse=True)
    a, b, c = (surface.vertices[surface.triangles[:, i]] - surface.vertices[0] for i in range(3))
    return np.asarray(np.bincount(part.reshape(-1), dot(a, np.cross(b, c))), np.float64) / 6
