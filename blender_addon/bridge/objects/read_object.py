# SPDX-License-Identifier: GPL-3.0-or-later
"""An object as the artist sees it -> points, triangles and normals in its rigid frame.

The medial axis is not affine invariant. So the world matrix L is split into a rigid frame R
(rotation and translation) and the linear rest A = R^-1 L (scale, shear, mirror), and A is applied
to the points.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import bpy
import numpy as np

from ...core.arrays import Flags, Floats, Ints
from ...core.axis.polygon_triangles import polygon_triangles
from ...core.errors import InvalidInputError
from ...core.shape.shape import Shape
from ...core.small_matrices import determinant, dot, length_of, stretches, times
from ..mesh.attributes import read_normals, read_vectors
from ..mesh.mesh_arrays import read_edges, read_polygons, read_positions

_ALIKE = 1e-5  # stretches that differ by less are equal but for the rounding of float32

SAMPLED_TYPES = ("MESH", "POINTCLOUD")
SOURCE_TYPES = (*SAMPLED_TYPES, "CURVE", "SURFACE", "FONT", "META")


def read_object(source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Shape:
    """Read an object as Blender evaluates it; edit mode is flushed first.

    Modifiers are applied, lengths are those of the world, faces are outward also where it is mirrored. Raises
    InvalidInputError where it is of another type or not in the view layer, its modifiers leave nothing, or its
    transform is not finite.
    """
    evaluated = _evaluate(source, depsgraph)
    frame, rest = split_transform(np.array(evaluated.matrix_world, np.float64))
    shape = _read_data(evaluated, depsgraph)
    points, triangles, normals = shape.points, shape.triangles, shape.normals
    if not np.array_equal(rest, np.identity(3)):
        points = times(points, rest)
        with np.errstate(invalid="ignore"):  # what uses the normals checks that they are finite
            normals = None if normals is None else times(normals, _of_normals(rest))
    if determinant(rest) < 0.0:
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    return replace(shape, points=points, triangles=triangles, normals=normals, frame=frame)


def split_transform(world: Floats) -> tuple[Floats, Floats]:
    """Polar decomposition of a (4, 4) world matrix.

    Returns the frame, (4, 4), which is a rotation (never a mirror) and the translation, and the rest, (3, 3), which is
    scale, shear and mirror; the frame's rotation times the rest is the linear part of the world matrix.
    """
    if not np.isfinite(world).all():
        raise InvalidInputError(
            "Expected a finite transform, found NaN or infinity; clear the transform"
        )
    linear = world[:3, :3]
    mirror = _mirror_of(linear) if determinant(linear) < 0.0 else np.identity(3)
    size, right, image = stretches(times(linear, mirror))
    left = _turn_of(image, size, determinant(right))
    frame = np.identity(4)
    frame[:3, :3] = times(left.T, right.T)
    frame[:3, 3] = world[:3, 3]
    return frame, times(_without_rounding(times(right.T * size, right.T)), mirror)


def _mirror_of(linear: Floats) -> Floats:
    """Return a mirror along the direction that a matrix stretches least, (3, 3).

    Of several such directions it is the one closest to an axis, the first of these. Otherwise the rounding of float32
    would choose, and two readings of one transform would differ.
    """
    size, right, _ = stretches(linear)
    least = right[size <= (1.0 + _ALIKE) * size[2]]
    reach = (least * least).sum(axis=0)
    axis = int(np.argmax(reach >= (1.0 - _ALIKE) * reach.max()))
    along = (least * least[:, axis, None]).sum(axis=0) / math.sqrt(reach[axis])
    return np.identity(3) - 2.0 * along[:, None] * along


def _turn_of(image: Floats, size: Floats, handed: float) -> Floats:
    """(3, 3) unit rows along the image, perpendicular to each other also where it is flat, with a determinant of the
    sign of `handed`.
    """
    first = image[0] / size[0] if size[0] > 0.0 else np.array([1.0, 0.0, 0.0])
    second = image[1]
    if not size[1] > 8 * np.finfo(float).eps * size[0]:
        other = np.identity(3)[np.abs(first).argmin()]
        second = other - dot(first, other) * first
    second = second / length_of(second)
    return np.array([first, second, np.copysign(1.0, handed) * np.cross(first, second)])


def _without_rounding(rest: Floats) -> Floats:
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


def _of_normals(rest: Floats) -> Floats:
    """Return what turns outward normals when `rest` moves the points, (3, 3): its inverse transpose, up to a
    positive factor, which also exists where `rest` is flat.
    """
    cofactors = np.cross(rest[[1, 2, 0]], rest[[2, 0, 1]])
    return -cofactors if determinant(rest) < 0.0 else cofactors


def _evaluate(source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bpy.types.Object:
    if source.type not in SOURCE_TYPES:
        raise InvalidInputError(
            "Expected a mesh, point cloud, curve, surface, text or metaball, found an object of type "
            f"{source.type.capitalize()}; select one of those"
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


def _read_data(evaluated: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Shape:
    """Points, triangles and normals, as they are stored."""
    if evaluated.type != "POINTCLOUD":
        with _evaluated_mesh(evaluated) as mesh:
            if mesh is not None and len(mesh.vertices):
                points = read_positions(mesh)
                return Shape(
                    points=points,
                    triangles=_read_triangles(mesh, points),
                    normals=read_normals(mesh.attributes),
                    sharp_edges=_read_sharp_edges(mesh),
                    shaded_smooth=_is_shaded_smooth(mesh),
                    of_samples=evaluated.type in SAMPLED_TYPES,
                    single=True,
                )
    cloud = _evaluated_cloud(evaluated, depsgraph)
    if cloud is None or len(cloud.points) == 0:
        raise InvalidInputError(
            "Expected points, found none; add some, or change the modifiers that remove them"
        )
    points = read_vectors(cloud.attributes["position"].data, "vector")
    return Shape(points, np.zeros((0, 3), np.int32), read_normals(cloud.attributes), single=True)


@contextmanager
def _evaluated_mesh(evaluated: bpy.types.Object) -> Iterator[bpy.types.Mesh | None]:
    """None where Blender makes none, as of a metaball that belongs to the surface of another."""
    try:
        mesh = evaluated.to_mesh()
    except RuntimeError:
        mesh = None
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


def _read_triangles(mesh: bpy.types.Mesh, points: Floats) -> Ints:
    """Not Blender's, which differ from version to version, but those of a file with these polygons."""
    return polygon_triangles(points, *read_polygons(mesh))


def _read_sharp_edges(mesh: bpy.types.Mesh) -> Ints | None:
    """Return the edges that are marked sharp, (e, 2); None where there is none."""
    marked = _read_marks(mesh, mesh.edges, "use_edge_sharp", "sharp_edge")
    return read_edges(mesh)[marked] if marked.any() else None


def _is_shaded_smooth(mesh: bpy.types.Mesh) -> bool:
    """Every face, and without the automatic sharp edges that Blender had up to 4.0."""
    if bpy.app.version < (4, 1, 0):
        smooth = _read_marks(mesh, mesh.polygons, "use_smooth", "")
    else:
        smooth = ~_read_marks(mesh, mesh.polygons, "", "sharp_face")
    return len(smooth) > 0 and bool(smooth.all()) and not getattr(mesh, "use_auto_smooth", False)


def _read_marks(
    mesh: bpy.types.Mesh, elements: bpy.types.bpy_prop_collection, name: str, attribute: str
) -> Flags:
    """A mark of edges or faces: from 4.1 an attribute, which there is only where something is marked."""
    marks = np.zeros(len(elements), bool)
    if bpy.app.version < (4, 1, 0):
        elements.foreach_get(name, marks)
    elif attribute in mesh.attributes:
        mesh.attributes[attribute].data.foreach_get("value", marks)
    return marks
