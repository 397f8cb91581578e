# SPDX-License-Identifier: GPL-3.0-or-later
"""Few balls or capsules as an object: a vertex with a radius for each ball, an edge for each capsule.

Balls are shown as spheres by the modifier *Balls*, capsules by the modifier *Capsules*.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.arrays import Floats, Ints
from ..core.axis.colours import radius_range
from ..core.cover.ball_cover import BallCover, Balls
from ..core.errors import InvalidInputError
from ..core.machine.cache import key_of
from ..core.settings import CoverMode
from .capsules_shown import add_capsules, is_capsules
from .mesh import stored
from .mesh.attributes import RADIUS, read_attribute
from .mesh.material import radius_material
from .mesh.mesh_arrays import read_edges, read_positions
from .mesh.write_mesh import new_mesh
from .nodes.groups import add_coloured_balls, is_group
from .objects.output_object import Product, check_mode, place, remember


@dataclass(frozen=True)
class _Vertices:
    """Polygons of a mesh that has none, with a radius at each vertex."""

    vertices: Floats
    radius: Floats
    face_offsets: Ints
    face_vertices: Ints


BALLS = Product(" Balls", (stored.BALLS_MODE,), material=radius_material)
is_balls, balls_of, check_balls_writable = BALLS.has, BALLS.of, BALLS.check_writable


def write_balls(source: bpy.types.Object, found: BallCover, frame: np.ndarray) -> bpy.types.Object:
    """Make the balls of a source, or update the existing ones."""
    balls = found.balls
    none = np.zeros(1, np.int32)
    rows = _Vertices(balls.centres, balls.radii, none, none[:0])
    build = partial(new_mesh, rows, table=(RADIUS,), edges=balls.edges)
    span = radius_range(balls.radii)
    thing, is_new = BALLS.write_coloured(source, build, RADIUS.name, balls.radii, *span)
    _show(thing, bool(len(balls.edges)), is_new)
    place(thing, frame)
    remember(thing, source, found.points, found.duplicates, found.warnings)
    thing[stored.BALLS_MODE], thing[stored.BALLS_COVERED] = balls.mode.name, balls.covered
    thing[stored.BALLS_OUTSIDE], thing[stored.BALLS_FARTHEST] = balls.outside, balls.farthest
    thing[stored.BALLS_WRITTEN] = _name_of(*_rows(thing))
    return thing


def _show(thing: bpy.types.Object, capsules: bool, is_new: bool) -> None:
    """Show spheres or capsules; where an artist removed the modifier, none comes back."""
    if is_new:
        (add_capsules if capsules else add_coloured_balls)(thing)
        return
    for modifier in list(thing.modifiers):
        group = getattr(modifier, "node_group", None)
        if is_group(group, "BALLS") if capsules else is_capsules(group):
            thing.modifiers.remove(modifier)
            (add_capsules if capsules else add_coloured_balls)(thing)
            return


def read_balls(thing: bpy.types.Object) -> Balls:
    """The balls of an object as they are now, in its own frame; the figures of balls that somebody has changed are
    unknown.

    Raises InvalidInputError where the radii are gone, no ball is left, or somebody is editing them.
    """
    check_mode(thing)
    centres, radii, edges = _rows(thing)
    known = thing.get(stored.BALLS_WRITTEN) == _name_of(centres, radii, edges)
    covered, outside, farthest = (
        float(thing[name]) if known else np.nan
        for name in (stored.BALLS_COVERED, stored.BALLS_OUTSIDE, stored.BALLS_FARTHEST)
    )
    return Balls(
        centres, radii, CoverMode[thing[stored.BALLS_MODE]], covered, outside, farthest, edges
    )


def _rows(thing: bpy.types.Object) -> tuple[Floats, Floats, Ints]:
    mesh = thing.data
    radii = read_attribute(mesh.attributes, RADIUS.name, RADIUS.type, RADIUS.domain)
    if radii is None or not len(radii):
        raise InvalidInputError(
            f"Expected vertices with the attribute '{RADIUS.name}' on '{thing.name}', found none; "
            "make the balls again"
        )
    return read_positions(mesh), radii.astype(np.float64), read_edges(mesh)


def _name_of(*rows: NDArray) -> str:
    return key_of("balls", *rows)
