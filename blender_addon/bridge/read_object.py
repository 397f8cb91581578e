"""A mesh object as the artist sees it -> points and triangles in its rigid frame.

The medial axis is not affine invariant. So the world matrix L is split into a rigid frame R
(rotation and translation) and the linear rest A = R^-1 L (scale, shear, mirror), and A is applied
to the points.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.errors import InvalidInputError

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Shape:
    """What an object is to the method.

    Parameters
    ----------
    points : (n, 3) float64
        All vertices with modifiers applied, world lengths, in `frame`.
    triangles : (m, 3) int32
        Faces, outward also where the object is mirrored.
    frame : (4, 4) float64
        Rotation and translation from `points` to the world.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    frame: NDArray[np.float64]


def read_object(source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Shape:
    """Read the evaluated mesh of an object; edit mode is flushed first.

    Raises
    ------
    InvalidInputError
        Not a mesh, not in the view layer, or its transform is not finite.
    """
    if source.type != "MESH":
        raise InvalidInputError(
            f"Expected a mesh, found an object of type {source.type.capitalize()}; "
            "select a mesh, or convert the object to one (Object > Convert)"
        )
    if source.mode == "EDIT":
        source.update_from_editmode()
        depsgraph.update()
    evaluated = source.evaluated_get(depsgraph)
    if evaluated == source:
        raise InvalidInputError(
            "Expected an object that Blender evaluates, found one that is hidden or excluded; "
            "show it in the viewport and compute again"
        )
    frame, rest = split_transform(np.array(evaluated.matrix_world, np.float64))
    with _evaluated_mesh(evaluated) as mesh:
        points, triangles = _read_mesh(mesh)
    if np.linalg.det(rest) < 0.0:
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    identity = np.array_equal(rest, np.identity(3))
    return Shape(points if identity else points @ rest.T, triangles, frame)


def split_transform(
    world: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Polar decomposition of a world matrix.

    Parameters
    ----------
    world : (4, 4) float64

    Returns
    -------
    frame : (4, 4) float64
        A rotation (never a mirror) and the translation.
    rest : (3, 3) float64
        Scale, shear and mirror; frame's rotation times `rest` is the linear part of `world`.
    """
    if not np.isfinite(world).all():
        raise InvalidInputError(
            "Expected a finite transform, found NaN or infinity; clear the transform"
        )
    left, stretch, right = np.linalg.svd(world[:3, :3])
    flip = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = (left * flip) @ right
    frame = np.identity(4)
    frame[:3, :3] = rotation
    frame[:3, 3] = world[:3, 3]
    return frame, _without_rounding((right.T * (flip * stretch)) @ right)


def _without_rounding(rest: NDArray[np.float64]) -> NDArray[np.float64]:
    """Exactly even, or one, where `rest` is so but for what float32 matrix products lose.

    It keeps exact symmetries of the points exact, however the object is turned.
    """
    rounding = 16 * float(np.finfo(np.float32).eps)
    scale = float(np.trace(rest)) / 3
    if np.abs(rest - scale * np.identity(3)).max() > rounding * abs(scale):
        return rest
    if abs(scale - 1.0) <= rounding:
        scale = 1.0
    return scale * np.identity(3)


@contextmanager
def _evaluated_mesh(evaluated: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    mesh = evaluated.to_mesh()
    try:
        yield mesh
    finally:
        evaluated.to_mesh_clear()


def _read_mesh(mesh: bpy.types.Mesh) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return points.astype(np.float64).reshape(-1, 3), triangles.reshape(-1, 3)
