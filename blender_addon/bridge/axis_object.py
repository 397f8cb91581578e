# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes as objects: how they are found, made and updated, and what they remember."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import bpy

from ..core.settings import OPTIONS, Choice, Form, Integer, Settings, Switch
from .material import RADIUS_MAX, RADIUS_MIN, radius_material
from .output_object import (
    DENSITY,
    SAMPLED,
    check_mode,
    new_object,
    output_of,
    place,
    remember,
    replace_mesh,
)
from .write_mesh import new_axis_mesh

if TYPE_CHECKING:
    import numpy as np

    from ..core.axis.compute import Computation
    from ..core.axis.medial_axis import MedialAxis

SUFFIX = " Medial Axis"
ANALYSIS = "ma_analysis"
INSIDE = "ma_inside"  # what told inside from outside, and why: a sentence
UNBOUNDED = "ma_unbounded"
ZERO_AREA = "ma_zero_area"
BETTI = "ma_betti"  # pieces, loops and cavities; only of clean forms and curves
TOPOLOGY = "ma_topology"  # the same in a sentence


def is_result(thing: bpy.types.Object) -> bool:
    return thing.type == "MESH" and ANALYSIS in thing


def result_of(source: bpy.types.Object) -> bpy.types.Object | None:
    """The result that the next computation of this source updates."""
    return output_of(source, is_result)


def check_writable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when the result of a source cannot be updated now."""
    check_mode(result_of(source))


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
        replace_mesh(result, partial(new_axis_mesh, computation.axis))
    place(result, frame)
    _remember(result, source, computation)
    return result


def update_result(
    result: bpy.types.Object, axis: MedialAxis, settings: Settings, topology: str
) -> None:
    """Give a result another axis of the same analysis, and a sentence about it; it stays where it is."""
    replace_mesh(result, partial(new_axis_mesh, axis))
    result[TOPOLOGY] = topology
    _remember_settings(result, settings)
    _remember_axis(result, axis)


def radius_range(result: bpy.types.Object) -> tuple[float, float]:
    """The smallest and the largest radius."""
    return result.get(RADIUS_MIN, 0.0), result.get(RADIUS_MAX, 0.0)


def settings_of(result: bpy.types.Object) -> Settings:
    """The settings that a result was made with; those of earlier versions, which had no forms, are as published."""
    values = {}
    for name, option in OPTIONS.items():
        earlier = Form.PUBLISHED if name == "form" else option.default
        value = result.get(f"ma_{name}", earlier)
        if isinstance(option, Choice) and isinstance(value, str):
            value = type(option.default)[value]
        exact = isinstance(option, (Switch, Integer))
        values[name] = type(option.default)(value) if exact else value
    return Settings(**values)


def _new_result(source: bpy.types.Object, axis: MedialAxis) -> bpy.types.Object:
    mesh = new_axis_mesh(axis, source.name + SUFFIX)
    mesh.materials.append(radius_material())
    result = new_object(source, SUFFIX, mesh)
    result.show_in_front = True  # an inner axis lies inside the surface
    return result


def _remember(result: bpy.types.Object, source: bpy.types.Object, computation: Computation) -> None:
    remember(result, source, computation.points, computation.duplicates, computation.warnings)
    result[ANALYSIS] = computation.key
    result[INSIDE] = str(computation.sides)
    result[TOPOLOGY] = computation.topology
    result[SAMPLED] = computation.chosen.reason
    result[DENSITY] = str(computation.density)
    _remember_settings(result, computation.settings)
    _remember_axis(result, computation.axis)


def _remember_settings(result: bpy.types.Object, settings: Settings) -> None:
    for name, option in OPTIONS.items():
        value = getattr(settings, name)
        result[f"ma_{name}"] = value.name if isinstance(option, Choice) else value


def _remember_axis(result: bpy.types.Object, axis: MedialAxis) -> None:
    result[UNBOUNDED] = axis.unbounded
    result[ZERO_AREA] = axis.zero_area
    if axis.level is not None:
        result[BETTI] = axis.level.betti
    elif BETTI in result:
        del result[BETTI]
    result[RADIUS_MIN] = float(axis.radius.min())
    result[RADIUS_MAX] = float(axis.radius.max())
    result.update_tag()
