# SPDX-License-Identifier: GPL-3.0-or-later
"""Small medial meshes as objects: how they are found, made and updated."""

from __future__ import annotations

from functools import partial

import bpy

from ... import __version__
from ...core.axis.colours import radius_range as colours_of_radii
from ...core.axis.medial_axis import MedialAxis
from ...core.settings import Side
from ..mesh import stored
from ..mesh.attributes import RADIUS
from ..mesh.material import radius_material
from ..mesh.write_mesh import new_axis_mesh
from ..nodes.wires import show_wires
from ..objects.output_object import Product, follow_like, source_of

REDUCED_MESH = Product(" Small Mesh", (stored.REDUCED,), material=radius_material)
is_reduced, reduced_of = REDUCED_MESH.has, REDUCED_MESH.of


def check_reduced_writable(result: bpy.types.Object) -> None:
    """Check that `write_reduced` can change the object that there is."""
    REDUCED_MESH.check_writable(source_of(result) or result)


def write_reduced(result: bpy.types.Object, axis: MedialAxis, vertices: int) -> bpy.types.Object:
    """Make the small medial mesh of a result, or update the existing one.

    `axis` is in the frame of the result, and `vertices` is the wanted number.
    """
    source = source_of(result) or result
    span = colours_of_radii(axis.radius)
    thing, is_new = REDUCED_MESH.write_coloured(
        source, partial(new_axis_mesh, axis), RADIUS.name, axis.radius, *span
    )
    if is_new:
        thing.show_in_front = True  # it lies inside the surface
    follow_like(thing, result)
    show_wires(thing, axis)
    _remember(thing, source, axis, vertices)
    return thing


def _remember(
    thing: bpy.types.Object, source: bpy.types.Object, axis: MedialAxis, vertices: int
) -> None:
    thing[stored.REDUCED] = vertices
    thing[stored.SOURCE], thing[stored.VERSION] = source, __version__
    thing[stored.of_option("side")] = Side.INNER.name
    thing[stored.RADIUS_MIN], thing[stored.RADIUS_MAX] = (
        float(axis.radius.min()),
        float(axis.radius.max()),
    )
    thing.update_tag()
