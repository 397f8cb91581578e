# SPDX-License-Identifier: GPL-3.0-or-later
"""Selecting thin faces of what carries thickness, and where its patches are in the world."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from ...core.arrays import Flags, Floats
from ...core.machine.native import own_errors
from ..mesh import stored
from ..mesh.attributes import read_attribute, read_vectors
from ..mesh.mesh_arrays import read_loop_triangles, select_faces
from .thickness_object import THIN

_SOME_MINIMA = 10  # as large as a thin patch is shown, in its thickness
_COLUMNS = 5  # of a patch: x, y, z, area, minimum


def patch_at(carrier: bpy.types.Object, number: int) -> tuple[tuple[float, ...], float, float]:
    """Place in the carrier's own frame, area and minimum of one of the patches that are remembered."""
    row = list(carrier[stored.THICKNESS_PLACES])[_COLUMNS * number : _COLUMNS * (number + 1)]
    return tuple(row[:3]), row[3], row[4]


def patches_of(carrier: bpy.types.Object) -> int:
    """The number of patches that are remembered."""
    return len(carrier.get(stored.THICKNESS_PLACES, ())) // _COLUMNS


def least_of(carrier: bpy.types.Object) -> tuple[tuple[float, ...], float]:
    """Place of the minimum in the carrier's own frame, and how large what is worth seeing is there."""
    least = carrier[stored.THICKNESS_MINIMUM]
    patch = patch_at(carrier, 0)[1] if patches_of(carrier) else 0.0  # the thinnest comes first
    return tuple(carrier[stored.THICKNESS_PLACE]), min(
        max(patch**0.5, 4 * least), _SOME_MINIMA * least
    )


def select_thin(thing: bpy.types.Object, near: tuple[float, ...] | None = None) -> int:
    """Select the thin faces of a mesh with `ma_thin`, in object or edit mode, and nothing else; returns how many there
    are.

    Near a place, in the object's own frame, these are only those that are connected to the thin face next to it; where
    no face is thin, that face alone which is next to it.
    """
    with in_object_mode(thing):
        mesh = thing.data
        wanted = _thin(mesh)
        if near is not None:
            wanted = _connected(mesh, wanted, np.array(near))
        select_faces(mesh, wanted)
    return int(np.count_nonzero(wanted))


def _thin(mesh: bpy.types.Mesh) -> Flags:
    flags = read_attribute(mesh.attributes, THIN, "BOOLEAN", "FACE")
    return np.zeros(len(mesh.polygons), bool) if flags is None else flags


def _connected(mesh: bpy.types.Mesh, thin: Flags, near: Floats) -> Flags:
    triangles, polygons = read_loop_triangles(mesh)
    some = thin if thin.any() else np.ones(len(thin), bool)
    centres = read_vectors(mesh.polygons, "center")
    away = np.where(some, np.linalg.norm(centres - near, axis=1), np.inf)
    start = int(away.argmin())
    wanted = np.zeros(len(thin), bool)
    wanted[start] = True
    if thin.any():
        with own_errors() as module:
            patches = module.patches(triangles, thin[polygons], len(mesh.vertices))
        wanted[polygons[patches == patches[np.flatnonzero(polygons == start)[0]]]] = True
    return wanted


@contextmanager
def in_object_mode(thing: bpy.types.Object) -> Iterator[None]:
    """Edit mode is left meanwhile, for there Blender shows no attributes; faces are what is selected in it."""
    editing = thing.mode == "EDIT"
    if editing:
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if editing:
            bpy.context.tool_settings.mesh_select_mode = (False, False, True)
            bpy.ops.object.mode_set(mode="EDIT")
