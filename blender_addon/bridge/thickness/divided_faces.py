# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a mesh divided by Blender's own subdivision, which keeps UVs, vertex groups and the other attributes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

from ...core.arrays import Flags, Floats
from ...core.errors import InvalidInputError
from ...core.shape.shape import Shape
from ..mesh.mesh_arrays import read_loop_triangles, selected_faces
from ..objects.read_object import read_object, split_transform

# Layers of faces, while they are divided. Blender 5.2 forgets the selection of faces whose vertices are not selected.
_CHOSEN, _SELECTED = "ma_divided", "ma_selected"


@dataclass(frozen=True, eq=False)
class Division:
    """A step of a subdivision: some faces of a mesh, (p,) bool, are divided until none of their edges is longer than
    `longest`.

    `rest`, (3, 3), is the scale of the object, as of `split_transform`.
    """

    faces: Flags
    longest: float
    rest: Floats


@contextmanager
def divided(
    source: bpy.types.Object, wanted: Callable[[Shape], tuple[Flags, float]], most: int
) -> Iterator[tuple[Division, ...]]:
    """Give a mesh object, whose modifiers keep its faces, a mesh whose faces are divided, in the body of a `with`;
    yields the steps for `divide`.

    `wanted` gives the triangles of a shape that have to be divided, and how long their edges may be; `most` steps are
    tried.
    """
    mesh = source.data
    source.data = tried = mesh.copy()
    try:
        yield tuple(_steps(source, wanted, most))
    finally:
        source.data = mesh
        bpy.data.meshes.remove(tried)
        bpy.context.view_layer.update()


def _steps(
    source: bpy.types.Object, wanted: Callable[[Shape], tuple[Flags, float]], most: int
) -> Iterator[Division]:
    for number in range(most):
        bpy.context.view_layer.update()
        triangles, longest = wanted(read_object(source, bpy.context.evaluated_depsgraph_get()))
        if not triangles.any():
            return
        # Modifiers may stretch the mesh, so that the next step needs shorter edges.
        step = _division(source, triangles, longest / 2**number)
        divide(source.data, step)
        bpy.context.view_layer.update()
        yield step


def _division(source: bpy.types.Object, triangles: Flags, longest: float) -> Division:
    _, polygons = read_loop_triangles(source.data)
    faces = np.zeros(len(source.data.polygons), bool)
    faces[polygons[triangles]] = True
    _, rest = split_transform(np.array(source.matrix_world, np.float64))
    return Division(faces, longest, rest)


def divide(mesh: bpy.types.Mesh, step: Division) -> None:
    """Divide faces of a mesh in object mode; others that share a divided edge get its vertices.

    Raises InvalidInputError where the mesh has another number of faces than the step is for.
    """
    if len(mesh.polygons) != len(step.faces):
        raise InvalidInputError(
            f"Expected the {len(step.faces):,} faces that were read, found {len(mesh.polygons):,}; compute again"
        )
    grid = bmesh.new()
    try:
        grid.from_mesh(mesh)
        _mark(grid, _SELECTED, selected_faces(mesh))
        _mark(grid, _CHOSEN, step.faces)
        layer = grid.faces.layers.int[_CHOSEN]
        rest = Matrix(step.rest.tolist())
        _cut_corners(grid, layer)
        while long := _long_edges(grid, layer, step.longest, rest):
            bmesh.ops.subdivide_edges(grid, edges=long, cuts=1, use_grid_fill=True)
            _cut_corners(grid, layer)
        picked = grid.faces.layers.int[_SELECTED]
        selection = [face[picked] for face in grid.faces]
        for name in (_CHOSEN, _SELECTED):
            grid.faces.layers.int.remove(grid.faces.layers.int[name])
        grid.to_mesh(mesh)
        mesh.polygons.foreach_set("select", selection)
    finally:
        grid.free()
    mesh.update()


def _mark(grid: bmesh.types.BMesh, name: str, marked: Flags) -> None:
    """Give faces a layer, of which the pieces of a face have the value of the face."""
    layer = grid.faces.layers.int.new(name)
    for face, value in zip(grid.faces, marked.tolist(), strict=True):
        face[layer] = value


def _cut_corners(grid: bmesh.types.BMesh, layer: bmesh.types.BMLayerItem) -> None:
    """Cut chosen faces that cannot be divided along their edges alone into triangles."""
    faces = [
        face
        for face in grid.faces
        if face[layer] and (len(face.verts) > 4 or not all(c.is_convex for c in face.loops))
    ]
    bmesh.ops.triangulate(grid, faces=faces)


def _long_edges(
    grid: bmesh.types.BMesh, layer: bmesh.types.BMLayerItem, longest: float, rest: Matrix
) -> list[bmesh.types.BMEdge]:
    return [
        edge
        for edge in grid.edges
        if (rest @ (edge.verts[0].co - edge.verts[1].co)).length > longest
        and any(face[layer] for face in edge.link_faces)
    ]
