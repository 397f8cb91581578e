# SPDX-License-Identifier: GPL-3.0-or-later
"""Middle surfaces as objects: sheets with their thickness as attributes, and a Solidify modifier that is the solid."""

from __future__ import annotations

from functools import partial

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.axis.colours import radius_range
from ..core.mid_surface.mid_surface import MidSurface
from .mesh import stored
from .mesh.attributes import Attribute
from .mesh.material import THICKNESS, thickness_material
from .mesh.step_weights import write_steps
from .mesh.write_mesh import new_mesh
from .objects.output_object import Product, follow_like, place, remember, remove_object, source_of
from .thickness.thickness_object import carrier_of

_NAME = "Medial Axis Thickness"  # of the modifier and of the vertex group
_ALIKE = 1e-3  # thicknesses that differ by less than this share need no vertex group
_TABLE = (
    Attribute(THICKNESS, "of_vertices", "POINT", "FLOAT", np.float32),
    Attribute("ma_face_thickness", "thickness", "FACE", "FLOAT", np.float32),
    Attribute("ma_part", "part", "FACE", "INT", np.int32),
)


THICK_PARTS = Product(" Thick Parts", (stored.THICK_FACES,))
MID_SURFACE = Product(" Mid-Surface", (stored.MID_SHEETS,), material=thickness_material)
is_mid_surface, is_thick = MID_SURFACE.has, THICK_PARTS.has


def check_mid_surface_writable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when an object that was made of a source cannot be updated now."""
    MID_SURFACE.check_writable(source)
    THICK_PARTS.check_writable(source)


def write_mid_surface(
    source: bpy.types.Object, found: MidSurface, frame: Floats
) -> bpy.types.Object:
    """Make the middle surface of a source, or update the existing one."""
    build = partial(new_mesh, found, table=_TABLE)
    span = radius_range(found.of_vertices)
    thing, is_new = MID_SURFACE.write_coloured(source, build, THICKNESS, found.of_vertices, *span)
    if is_new:
        _show_in_front(thing, source)
    place(thing, frame)
    remember(thing, source, found.points, found.duplicates, found.warnings)
    thing[stored.MID_SHEETS], thing[stored.MID_SHARE] = found.sheets, found.share
    _solidify(thing, found.of_vertices)
    _write_thick(source, found, frame)
    return thing


def _write_thick(source: bpy.types.Object, found: MidSurface, frame: Floats) -> None:
    """Make or update the object of the faces that no sheet stands for, or remove it where there are none."""
    thick = found.thick
    if thick is None or not len(thick.triangles):
        old = THICK_PARTS.of(source)
        if old is not None:
            remove_object(old)
        return
    thing, _ = THICK_PARTS.write_mesh(source, partial(new_mesh, thick))
    place(thing, frame)
    remember(thing, source, found.points, found.duplicates, ())
    thing[stored.THICK_FACES] = len(thick.triangles)


def place_thick_parts(sheets: bpy.types.Object) -> None:
    """Let the thick parts next to a middle surface, if there are any, have its place and its parent."""
    source = source_of(sheets)
    thick = None if source is None else THICK_PARTS.of(source)
    if thick is not None:
        follow_like(thick, sheets)


def _show_in_front(thing: bpy.types.Object, source: bpy.types.Object) -> None:
    """Let the sheets be seen, which lie inside the solid, also where a copy of this with its thickness is in front."""
    carrier = carrier_of(source)
    if carrier is not None and carrier != source:
        carrier.show_in_front = False
    thing.show_in_front = True


def _solidify(thing: bpy.types.Object, lengths: Floats) -> None:
    """Add or update the modifier, switched off in the view: at first the sheets are seen."""
    modifier = thing.modifiers.get(_NAME)
    if modifier is None or modifier.type != "SOLIDIFY":
        modifier = thing.modifiers.new(_NAME, "SOLIDIFY")
        modifier.solidify_mode = "NON_MANIFOLD"
        modifier.nonmanifold_thickness_mode = "CONSTRAINTS"
        modifier.offset = 0.0
        modifier.show_viewport = modifier.show_render = False
    most = float(lengths.max())
    modifier.thickness = most
    if float(lengths.min()) > (1.0 - _ALIKE) * most:
        modifier.vertex_group = ""
        return
    write_steps(thing, _NAME, lengths / most)
    modifier.vertex_group = _NAME
