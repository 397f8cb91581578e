# SPDX-License-Identifier: GPL-3.0-or-later
"""The groups by name: made once per file, as modifiers, and as assets of a library."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from ...core.arrays import Floats
from ..mesh import stored
from ..mesh.mesh_arrays import read_positions
from . import balls, filter, rebuild, thicken, thickness_colour
from .inputs import has_inputs, set_inputs
from .wires import wires_of

FILE = "medial_axis_nodes.blend"
CATALOGUE_FILE = "blender_assets.cats.txt"
CATALOGUE = "0d5dd5d2-6c05-4d0c-8a7a-6d1f5a0c6c1e"  # any UUID, always the same
_MOST_BALLS = 4_000  # about this many balls are left
_HALVINGS = 16  # of the distance within which they are merged


@dataclass(frozen=True)
class Group:
    """A group: how it is called, what it is for, whether it works on medial axes, and inputs that older ones lack."""

    name: str
    about: str
    build: Callable[[str], bpy.types.GeometryNodeTree]
    of_axes: bool = True
    newer: tuple[str, ...] = ()


GROUPS = {
    "FILTER": Group(
        "Medial Axis Filter", "Leave out facets by angle, ratio, radius and sheet", filter.build
    ),
    "BALLS": Group(
        "Medial Axis Balls",
        "A sphere at each vertex, as large as there",
        balls.build,
        newer=(balls.COLOURED,),
    ),
    "REBUILD": Group(
        "Medial Axis Rebuild",
        "The solid again, thicker, thinner or simpler",
        rebuild.build,
        newer=(rebuild.MATERIAL,),
    ),
    "COLOUR": Group(
        "Medial Axis Thickness Colour",
        "Colour by radius, or by another number",
        thickness_colour.build,
    ),
    "THICKEN": Group(
        "Medial Axis Thicken",
        "Move the walls of a mesh as Thicken to the Limit found",
        thicken.build,
        of_axes=False,
    ),
}


def is_group(tree: bpy.types.NodeTree | None, key: str) -> bool:
    """Return whether this is one of our groups, by whatever name."""
    return tree is not None and tree.get(stored.NODES) == key


def group(key: str) -> bpy.types.GeometryNodeTree:
    """The group of this file, built when it has none, or one of an older version only; changes that a user made in it
    stay, and an older one stays where it is used."""
    for found in bpy.data.node_groups:
        if found.library is None and is_group(found, key) and has_inputs(found, *GROUPS[key].newer):
            return found
    made = GROUPS[key].build(GROUPS[key].name)
    made[stored.NODES] = key
    return made


def add_modifier(thing: bpy.types.Object, key: str) -> bpy.types.NodesModifier:
    """A modifier with a group, after those that an object has, but before the tubes that show its wires."""
    modifier = thing.modifiers.new(GROUPS[key].name, "NODES")
    modifier.node_group = group(key)
    wires = wires_of(thing)
    if wires is None:
        return modifier
    name = modifier.name
    with bpy.context.temp_override(object=thing):
        bpy.ops.object.modifier_move_to_index(
            modifier=name, index=list(thing.modifiers).index(wires)
        )
    return thing.modifiers[name]


def add_coloured_balls(thing: bpy.types.Object) -> bpy.types.NodesModifier:
    """The modifier with the group of balls, coloured."""
    modifier = add_modifier(thing, "BALLS")
    set_inputs(modifier, {balls.COLOURED: True})
    return modifier


def add_few_balls(thing: bpy.types.Object) -> bpy.types.NodesModifier:
    """The modifier with the group of balls, merged so that a few thousand are left, which Blender draws fast."""
    modifier = add_coloured_balls(thing)
    distance = _merging_distance(read_positions(thing.data), _MOST_BALLS)
    set_inputs(modifier, {"Merge": distance})
    return modifier


def _merging_distance(points: Floats, most: int) -> float:
    """Return the distance that leaves about `most` of (n, 3) points when they are merged; 0 where there are no more.

    This many cells of a grid of that width have points in them.
    """
    if len(points) <= most:
        return 0.0
    low, high = 0.0, float(np.ptp(points, axis=0).max())
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        few = _cells(points, middle) <= most
        low, high = (low, middle) if few else (middle, high)
    return high


def _cells(points: Floats, width: float) -> int:
    cells = ((points - points.min(axis=0)) / width).astype(np.int64)
    sizes = cells.max(axis=0) + 1
    return len(np.unique((cells[:, 0] * sizes[1] + cells[:, 1]) * sizes[2] + cells[:, 2]))


def write_library(folder: Path) -> None:
    """All groups as assets: a .blend file and the catalogue that Blender's asset browser reads."""
    made = {group(key) for key in GROUPS}
    for one, about in zip(map(group, GROUPS), GROUPS.values(), strict=True):
        one.asset_mark()
        one.asset_data.description = about.about
        one.asset_data.catalog_id = CATALOGUE
    folder.mkdir(parents=True, exist_ok=True)
    bpy.data.libraries.write(str(folder / FILE), made, fake_user=True, compress=True)
    lines = ("VERSION 1", "", f"{CATALOGUE}:Medial Axis:Medial Axis", "")
    (folder / CATALOGUE_FILE).write_text("\n".join(lines), encoding="utf-8")
