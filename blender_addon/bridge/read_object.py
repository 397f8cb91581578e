"""A mesh or point cloud as the artist sees it -> points, triangles and normals in its rigid frame.

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
from .attributes import read_normals, read_vectors

if TYPE_CHECKING:
    from numpy.typing import NDArray

SOURCE_TYPES = ("MESH", "POINTCLOUD")


@dataclass(frozen=True, eq=False)
class Shape:
    """What an object is to the method.

    Parameters
    ----------
    points : (n, 3) float64
        All vertices with modifiers applied, world lengths, in `frame`.
    triangles : (m, 3) int32
        Faces, outward also where the object is mirrored; none in a point cloud.
    normals : (n, 3) float64 or None
        The attribute of the points, in `frame`; of any length, None when there is none.
    frame : (4, 4) float64
        Rotation and translation from `points` to the world.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    normals: NDArray[np.float64] | None
    frame: NDArray[np.float64]


def read_object(source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Shape:
    """Read the evaluated mesh or point cloud of an object; edit mode is flushed first.

    Raises
    ------
    InvalidInputError
        Neither of the two, not in the view layer, its modifiers leave nothing, or its transform is not
        finite.
    """
    evaluated = _evaluate(source, depsgraph)
    frame, rest = split_transform(np.array(evaluated.matrix_world, np.float64))
    points, triangles, normals = _read_data(evaluated, depsgraph)
    if not np.array_equal(rest, np.identity(3)):
        points = points @ rest.T
        normals = None if normals is None else normals @ _of_normals(rest).T
    if np.linalg.det(rest) < 0.0:
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    return Shape(points, triangles, normals, frame)


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


def _of_normals(rest: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3, 3) what turns outward normals when `rest` moves the points: its inverse transpose, up to a
    positive factor, which also exists where `rest` is flat.
    """
    cofactors = np.cross(rest[[1, 2, 0]], rest[[2, 0, 1]])
    return -cofactors if np.linalg.det(rest) < 0.0 else cofactors


def _evaluate(source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bpy.types.Object:
    if source.type not in SOURCE_TYPES:
        raise InvalidInputError(
            f"Expected a mesh or a point cloud, found an object of type {source.type.capitalize()}; "
            "select one of those, or convert the object to a mesh (Object > Convert)"
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
    return evaluated


def _read_data(
    evaluated: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64] | None]:
    """Points, triangles and normals, as they are stored."""
    if evaluated.type == "MESH":
        with _evaluated_mesh(evaluated) as mesh:
            if len(mesh.vertices):
                points = read_vectors(mesh.vertices, "co")
                return points, _read_triangles(mesh), read_normals(mesh.attributes)
    cloud = _evaluated_cloud(evaluated, depsgraph)
    if cloud is None or len(cloud.points) == 0:
        raise InvalidInputError(
            "Expected points, found none; add some, or change the modifiers that remove them"
        )
    points = read_vectors(cloud.attributes["position"].data, "vector")
    return points, np.zeros((0, 3), np.int32), read_normals(cloud.attributes)


@contextmanager
def _evaluated_mesh(evaluated: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    mesh = evaluated.to_mesh()
    try:
        yield mesh
    finally:
        evaluated.to_mesh_clear()


def _evaluated_cloud(
    evaluated: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> bpy.types.PointCloud | None:
    """The points of a point cloud, or those that geometry nodes made of a mesh object."""
    if evaluated.type == "POINTCLOUD":
        return evaluated.data
    for part in depsgraph.object_instances:  # a part of an object's geometry is listed like one
        if (
            part.object.type == "POINTCLOUD"
            and part.parent == evaluated
            and part.matrix_world == evaluated.matrix_world
        ):
            return part.object.data
    return None


def _read_triangles(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return triangles.reshape(-1, 3)
