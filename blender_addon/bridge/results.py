"""Result objects: how they are found, made, placed and updated, and what they remember.

A result remembers its source, the settings and figures in custom properties; nothing is written to
the source.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
from mathutils import Matrix

from .. import __version__
from ..core.errors import InvalidInputError
from ..core.settings import OPTIONS, Choice, Settings
from .material import RADIUS_MAX, RADIUS_MIN, radius_material
from .write_object import new_mesh

if TYPE_CHECKING:
    import numpy as np

    from ..core.analysis import Computation, MedialAxis

SUFFIX = " Medial Axis"
SOURCE = "ma_source"  # a pointer: it follows when source or result are renamed
ANALYSIS = "ma_analysis"
VERSION = "ma_version"
POINTS = "ma_points"
DUPLICATES = "ma_duplicates"
UNBOUNDED = "ma_unbounded"
WARNINGS = "ma_warnings"


def source_of(result: bpy.types.Object) -> bpy.types.Object | None:
    """The object whose medial axis this is; None when it is no result, or its source is gone."""
    source = result.get(SOURCE)
    return source if isinstance(source, bpy.types.Object) else None


def is_result(thing: bpy.types.Object) -> bool:
    return thing.type == "MESH" and ANALYSIS in thing


def is_gone(thing: bpy.types.Object | None) -> bool:
    """Deleted: Blender keeps objects that a custom property points to, but in no collection."""
    return thing is None or not thing.users_collection


def result_of(source: bpy.types.Object) -> bpy.types.Object | None:
    """The result that the next computation of this source updates."""
    found = [
        thing
        for thing in bpy.data.objects
        if thing.library is None
        and is_result(thing)
        and not is_gone(thing)
        and source_of(thing) == source
    ]
    return min(found, key=lambda thing: thing.name, default=None)


def check_writable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when the result of a source cannot be updated now."""
    result = result_of(source)
    if result is not None:
        _check_mode(result)


def write_result(
    source: bpy.types.Object, computation: Computation, frame: np.ndarray
) -> bpy.types.Object:
    """Make the result of a source, or update the one there is; all or nothing.

    Parameters
    ----------
    source : Object
        It is not changed.
    computation : Computation
    frame : (4, 4) float64
        Where the axis lies in the world; rotation and translation only.

    Raises
    ------
    InvalidInputError
        The result cannot be changed now, or Blender cannot hold it.
    """
    result = result_of(source)
    if result is None:
        result = _new_result(source, computation.axis)
    else:
        _replace_mesh(result, computation.axis)
    _place(result, frame)
    _remember(result, source, computation)
    return result


def update_result(result: bpy.types.Object, axis: MedialAxis, settings: Settings) -> None:
    """Give a result other facets of the same analysis; it stays where it is."""
    _replace_mesh(result, axis)
    _remember_settings(result, settings)
    _remember_axis(result, axis)


def radius_range(result: bpy.types.Object) -> tuple[float, float]:
    """The smallest and the largest radius."""
    return result.get(RADIUS_MIN, 0.0), result.get(RADIUS_MAX, 0.0)


def settings_of(result: bpy.types.Object) -> Settings:
    """The settings that a result was made with."""
    values = {}
    for name, option in OPTIONS.items():
        value = result.get(f"ma_{name}", option.default)
        if isinstance(option, Choice) and isinstance(value, str):
            value = type(option.default)[value]
        values[name] = bool(value) if isinstance(option.default, bool) else value
    return Settings(**values)


def _check_mode(result: bpy.types.Object) -> None:
    if result.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected '{result.name}' in object mode, found it in {result.mode.lower()} mode; "
            "leave that mode and compute again"
        )


def _new_result(source: bpy.types.Object, axis: MedialAxis) -> bpy.types.Object:
    mesh = new_mesh(axis, source.name + SUFFIX)
    mesh.materials.append(radius_material())
    result = bpy.data.objects.new(source.name + SUFFIX, mesh)
    result.show_in_front = True  # an inner axis lies inside the surface
    editable = [collection for collection in source.users_collection if collection.library is None]
    for collection in editable or [bpy.context.scene.collection]:
        collection.objects.link(result)
    return result


def _replace_mesh(result: bpy.types.Object, axis: MedialAxis) -> None:
    """Swap in a new mesh, also for linked duplicates; materials and the name stay."""
    _check_mode(result)
    old = result.data
    mesh = new_mesh(axis, old.name)
    for material in old.materials:
        mesh.materials.append(material)
    old.user_remap(mesh)
    name = old.name
    bpy.data.meshes.remove(old)
    mesh.name = name


def _place(result: bpy.types.Object, frame: np.ndarray) -> None:
    result.matrix_world = Matrix(frame.tolist())
    if result.parent is None:
        result.scale = (1.0, 1.0, 1.0)  # exactly, not to the last bit of a decomposed matrix


def _remember(result: bpy.types.Object, source: bpy.types.Object, computation: Computation) -> None:
    result[SOURCE] = source
    result[ANALYSIS] = computation.key
    result[VERSION] = __version__
    result[POINTS] = computation.points
    result[DUPLICATES] = computation.duplicates
    result[WARNINGS] = "\n".join(computation.warnings)
    _remember_settings(result, computation.settings)
    _remember_axis(result, computation.axis)


def _remember_settings(result: bpy.types.Object, settings: Settings) -> None:
    for name, option in OPTIONS.items():
        value = getattr(settings, name)
        result[f"ma_{name}"] = value.name if isinstance(option, Choice) else value


def _remember_axis(result: bpy.types.Object, axis: MedialAxis) -> None:
    result[UNBOUNDED] = axis.unbounded
    result[RADIUS_MIN] = float(axis.radius.min())
    result[RADIUS_MAX] = float(axis.radius.max())
    result.update_tag()
