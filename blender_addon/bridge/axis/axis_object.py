# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes as objects: how they are found, made and updated, and what they remember."""

from __future__ import annotations

from functools import partial
from typing import Any

import bpy
import numpy as np

from ...core.axis.colours import radius_range as colours_of_radii
from ...core.axis.compute import Computation
from ...core.axis.medial_axis import MedialAxis
from ...core.axis.verdict import verdict
from ...core.options import Choice
from ...core.settings import (
    ANALYSED,
    LOOKS,
    OPTIONS,
    Criteria,
    Form,
    Look,
    Mesh,
    Settings,
    Side,
)
from ..mesh import stored
from ..mesh.attributes import RADIUS
from ..mesh.colours import colour_mesh, colour_parts, remember_colours
from ..mesh.material import radius_material
from ..mesh.write_mesh import new_axis_mesh
from ..nodes.wires import show_wires
from ..objects.output_object import Product, place, remember, replace_mesh
from .shown_axis import ShownAxis, box_of, shown_axis
from .slider_ranges import remember_ranges
from .structure_object import remember_structure

SUFFIX = " Medial Axis"
# The whole axis, its own master.
ALL = Look(within=0.0, crumbs=0.0)
# The values of options that earlier versions did not have.
_EARLIER = {"form": Form.PUBLISHED, "crisp": False, "mesh": Mesh.VORONOI}


RESULT = Product(SUFFIX, (stored.ANALYSIS,), material=radius_material)
is_result, result_of, check_writable = RESULT.has, RESULT.of, RESULT.check_writable


def write_result(
    source: bpy.types.Object,
    computation: Computation,
    frame: np.ndarray,
    look: Look = ALL,
    product: Product = RESULT,
    between_steps: bool = False,
    shown: ShownAxis | None = None,
) -> bpy.types.Object:
    """Make the result of a source, or update the existing one.

    `product` is that of the whole source, or of one of its parts. `between_steps` is as in `replace_mesh`, and `shown`
    is what the look leaves of the axis, where a thread has computed it.
    """
    box = box_of(computation.chosen.samples.points)
    shown = shown or shown_axis(computation.axis, box, look)
    axis, settings = shown.axis, computation.settings
    result, _ = product.write_mesh(source, partial(_axis_mesh, shown, look), between_steps)
    place(result, frame)
    if result.get(stored.of_option("side")) != settings.side.name:
        result.show_in_front = settings.side is Side.INNER  # it lies inside the surface
    show_wires(result, axis, look.lone_points)
    result[stored.BOX] = box
    _remember(result, source, computation)
    result[stored.TURNED] = computation.turned
    _remember_shown(result, shown, settings, look)
    return result


def update_result(
    result: bpy.types.Object,
    shown: ShownAxis,
    settings: Settings,
    topology: str,
    look: Look = ALL,
    between_steps: bool = False,
) -> None:
    """Give a result another axis of the same analysis, and a sentence about it; it stays where it is.

    `between_steps` is as in `replace_mesh`.
    """
    replace_mesh(result, partial(_axis_mesh, shown, look), between_steps)
    show_wires(result, shown.axis, look.lone_points)
    result[stored.TOPOLOGY] = topology
    _remember_shown(result, shown, settings, look)


def box_on(result: bpy.types.Object) -> list[float] | None:
    """The box of the samples of a result, as `box_of` gives it; None where a result has none."""
    found = result.get(stored.BOX)
    return list(found) if hasattr(found, "__len__") else None


def radius_range(result: bpy.types.Object) -> tuple[float, float]:
    """The smallest and the largest radius."""
    return result.get(stored.RADIUS_MIN, 0.0), result.get(stored.RADIUS_MAX, 0.0)


def settings_of(result: bpy.types.Object) -> Settings:
    """The settings that a result was made with; earlier versions had neither forms, crisp places nor even meshes.

    A property that someone changed to what is no value of its option counts as if it were not there.
    """
    values = {}
    for name, option in OPTIONS.items():
        earlier = _EARLIER.get(name, option.default)
        try:
            values[name] = _value_of(option, result.get(stored.of_option(name), earlier))
        except (KeyError, TypeError, ValueError):
            values[name] = earlier
    return Settings(**values)


def asked_of(settings: Settings) -> dict[str, Any]:
    """The options of the analysis that settings ask for, as a property of an object holds them."""
    return {name: _plain(name, settings.with_side()) for name in ANALYSED}


def asked_on(result: bpy.types.Object) -> dict[str, Any] | None:
    """The same of a result; None where an earlier version made it."""
    found = result.get(stored.ASKED)
    return found.to_dict() if hasattr(found, "to_dict") else None


def _plain(name: str, settings: Settings) -> Any:
    value = getattr(settings, name)
    return value.name if isinstance(OPTIONS[name], Choice) else value


def shown_curve(source: bpy.types.Object) -> Settings | None:
    """The settings of the curve of a source whose Detail was lowered; None where it has another axis, or none."""
    result = result_of(source)
    settings = None if result is None else settings_of(result)
    if settings is None or settings.form is not Form.CURVE or settings.detail >= 1.0:
        return None
    return settings


def _value_of(option: Any, value: Any) -> Any:
    if isinstance(option, Choice):
        return (
            type(option.default)[value] if isinstance(value, str) else type(option.default)(value)
        )
    return type(option.default)(value)


def look_of(result: bpy.types.Object) -> Look:
    """The look of a result; options that an older version did not remember have the value of that version."""
    return Look(**{name: result.get(stored.of_option(name), getattr(ALL, name)) for name in LOOKS})


def _axis_mesh(shown: ShownAxis, look: Look, name: str | bpy.types.Mesh) -> bpy.types.Mesh:
    axis = shown.axis
    mesh = new_axis_mesh(axis, name, shown.arrays)
    if look.colours and _shows_parts(axis, look):
        colour_parts(mesh, axis.structure.part, np.diff(axis.face_offsets))
    elif look.colours:
        colour_mesh(mesh, axis.radius, *colours_of_radii(axis.radius))
    return mesh


def _shows_parts(axis: MedialAxis, look: Look) -> bool:
    return look.by_part and axis.structure is not None


def _remember(result: bpy.types.Object, source: bpy.types.Object, computation: Computation) -> None:
    remember(result, source, computation.points, computation.duplicates, computation.warnings)
    result.pop(stored.DRAFT, None)
    result[stored.ANALYSIS], result[stored.ASKED] = computation.key, asked_of(computation.asked)
    result[stored.INSIDE] = str(computation.sides)
    result[stored.SOURCE_MESH] = str(computation.mesh or "")
    result[stored.TOPOLOGY] = computation.topology
    result[stored.SAMPLED] = computation.chosen.reason
    result[stored.DENSITY] = str(computation.density)
    result[stored.SECONDS] = computation.seconds
    found = verdict(computation.chosen, computation.warnings)
    result[stored.LIGHT], result[stored.VERDICT] = found.light.name, found.sentence


def _remember_shown(
    result: bpy.types.Object, shown: ShownAxis, settings: Settings, look: Look
) -> None:
    """Stores the figures of the shown axis for the panel, and the settings and the look that made it."""
    axis = shown.axis
    for name in OPTIONS:
        result[stored.of_option(name)] = _plain(name, settings)
    for name in LOOKS:
        result[stored.of_option(name)] = getattr(look, name)
    result[stored.UNBOUNDED] = axis.unbounded
    result[stored.ZERO_AREA] = axis.zero_area
    result[stored.HIDDEN], result[stored.CRUMBS] = shown.hidden, shown.crumbs
    result[stored.PIECES] = shown.pieces
    result[stored.ONLY_RATIO], result[stored.ONLY_ANGLE] = _only(axis, settings)
    _remember_level(result, axis)
    result[stored.RADIUS_MIN] = float(axis.radius.min())
    result[stored.RADIUS_MAX] = float(axis.radius.max())
    start, end = colours_of_radii(axis.radius)
    by_radius = look.colours and not _shows_parts(axis, look)
    remember_colours(result, RADIUS.name if by_radius else "", start, end)
    remember_structure(result, axis)
    remember_ranges(result, axis)
    result.update_tag()


def _remember_level(result: bpy.types.Object, axis: MedialAxis) -> None:
    """Stores what only a clean form or a curve has."""
    level = axis.level
    if level is not None:
        result[stored.BETTI], result[stored.PLACES] = level.betti, level.places
        result[stored.REFUSED] = level.refused
        return
    for name in (stored.BETTI, stored.PLACES, stored.REFUSED):
        result.pop(name, None)


def _only(axis: MedialAxis, settings: Settings) -> tuple[float, float]:
    """Shares of the facets that only the Ratio, and that only the Angle condition keeps, where either is enough."""
    if settings.criteria is not Criteria.ANGLE_OR_RATIO or not axis.facets:
        return 0.0, 0.0
    angle, ratio = axis.theta >= settings.theta, axis.rho >= settings.rho
    return (
        float(np.mean(ratio & ~angle)),
        float(np.mean(angle & ~ratio)),
    )
