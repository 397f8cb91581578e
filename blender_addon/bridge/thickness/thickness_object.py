# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness in Blender: `ma_thickness`, `ma_thin` and colours on a source, or on a copy of the measured surface where
the source has other vertices or too few to show it; and the figures that are remembered.

The object that is coloured, source or copy, is the carrier: it keeps the figures, and changes with the limit.
"""

from __future__ import annotations

from functools import partial

import bpy
import numpy as np

from ...core.arrays import Flags, Floats
from ...core.shape.triangle_faces import TriangleFaces
from ...core.thickness.measurement import Measurement
from ...core.thickness.thickness_colours import ThicknessScale, histogram, scale_of
from ...core.thickness.thin_parts import ThinParts
from ..mesh import stored
from ..mesh.attributes import as_float32, set_attribute
from ..mesh.colours import colour_mesh, remember_colours
from ..mesh.evaluated_rows import keeps_rows
from ..mesh.material import colour_material
from ..mesh.mesh_arrays import read_loop_triangles
from ..mesh.write_mesh import new_mesh
from ..objects.output_object import Product, check_mode, is_gone, place, remember, source_of

THICKNESS, THIN = "ma_thickness", "ma_thin"
_MOST_PLACES = 1000  # of patches that are stored
# A source with at least this many vertices for each sample shows its thickness.
_ENOUGH = 0.25


class _Surface(TriangleFaces):
    """The measured surface, as `new_mesh` wants it."""

    def __init__(self, found: Measurement) -> None:
        self.vertices, self.triangles = found.points, found.triangles


def is_carrier(thing: bpy.types.Object) -> bool:
    return thing.type == "MESH" and stored.THICKNESS_KEY in thing


# An object that was made to show thickness; a source that carries its thickness itself is none.
COPY = Product(" Thickness", (stored.THICKNESS_KEY, stored.SOURCE), material=colour_material)
is_copy = COPY.has


def carrier_of(thing: bpy.types.Object | None) -> bpy.types.Object | None:
    """The carrier of the thickness of an object: its copy, or itself; None where it was not measured."""
    if is_gone(thing):
        return None
    if is_copy(thing):
        return thing
    return COPY.of(thing) or (thing if is_carrier(thing) else None)


def check_thickness_writable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when thickness of a source cannot be written now."""
    COPY.check_writable(source)
    if source.type == "MESH" and source.data.library is None:
        check_mode(source)


def write_thickness(
    source: bpy.types.Object, found: Measurement, parts: ThinParts, frame: Floats
) -> bpy.types.Object:
    """Write what was measured; returns the carrier.

    The source gets the attributes where its own vertices and faces were measured. `frame`, (4, 4), is where the shape
    lies in the world.
    """
    own = _has_own(source, found) and keeps_rows(source)
    if own:
        _write_attributes(source.data, found.of_vertices)
    dense = own and len(source.data.vertices) >= _ENOUGH * found.samples
    if dense and COPY.of(source) is None and len(found.shape.triangles):
        carrier = source
        local = np.linalg.inv(np.array(source.matrix_world, np.float64)) @ frame
    else:
        carrier, local = _write_copy(source, found, frame), np.identity(4)
    _remember(carrier, found, local)
    carrier[stored.THICKNESS_ON_SOURCE] = own
    show_limit(carrier, found, parts)
    return carrier


def show_limit(carrier: bpy.types.Object, found: Measurement, parts: ThinParts) -> None:
    """Flags, colours and figures for a limit, on the carrier and on its source; neither may be in edit mode."""
    on_copy = is_copy(carrier)
    source = source_of(carrier) if on_copy else carrier
    if (
        not is_gone(source)
        and carrier.get(stored.THICKNESS_ON_SOURCE, True)
        and _has_own(source, found)
    ):
        set_attribute(source.data, THIN, "BOOLEAN", "FACE", _thin_polygons(source.data, parts))
        source.data.update()
    lengths = found.of_vertices
    if on_copy:
        lengths = found.lengths
        set_attribute(carrier.data, THIN, "BOOLEAN", "FACE", parts.patch_of_triangles >= 0)
    scale = scale_of(found, parts.limit)
    alone = on_copy or not len(
        carrier.data.color_attributes
    )  # else renders show those of the artist
    colour_mesh(carrier.data, scale.positions(lengths), 0.0, 1.0, render=alone)
    remember_colours(carrier, THICKNESS, scale.high, scale.low)
    carrier[stored.THICKNESS_SCALE] = scale.low, scale.limit, scale.high
    carrier[stored.THICKNESS_HISTOGRAM] = histogram(found, scale).tolist()
    carrier.data.update()
    _remember_parts(carrier, parts)


def scale_on(carrier: bpy.types.Object) -> ThicknessScale | None:
    """The scale that the colours of a carrier stand for; None where an older version made them."""
    return (
        ThicknessScale(*carrier[stored.THICKNESS_SCALE])
        if stored.THICKNESS_SCALE in carrier
        else None
    )


def _has_own(source: bpy.types.Object, found: Measurement) -> bool:
    """Return whether a source has as many vertices and faces as were measured, and can be written."""
    if source.type != "MESH" or source.data.library is not None or source.mode != "OBJECT":
        return False
    mesh = source.data
    if not found.shape.has_vertices(len(mesh.vertices)):
        return False
    mesh.calc_loop_triangles()
    return len(mesh.loop_triangles) == len(found.shape.triangles)


def _thin_polygons(mesh: bpy.types.Mesh, parts: ThinParts) -> Flags:
    _, polygons = read_loop_triangles(mesh)
    thin = np.zeros(len(mesh.polygons), bool)
    thin[polygons[parts.patch_of_faces >= 0]] = True
    return thin


def _write_attributes(mesh: bpy.types.Mesh, lengths: Floats) -> None:
    set_attribute(mesh, THICKNESS, "FLOAT", "POINT", as_float32(lengths))


def _write_copy(source: bpy.types.Object, found: Measurement, frame: Floats) -> bpy.types.Object:
    copy, is_new = COPY.write_mesh(source, partial(_copy_mesh, found))
    if is_new:
        copy.show_in_front = True  # it lies on its source
    place(copy, frame)
    remember(copy, source, found.samples, found.duplicates, found.warnings)
    return copy


def _copy_mesh(found: Measurement, name: str) -> bpy.types.Mesh:
    mesh = new_mesh(_Surface(found), name, ())
    _write_attributes(mesh, found.lengths)
    return mesh


def _remember(carrier: bpy.types.Object, found: Measurement, local: Floats) -> None:
    carrier[stored.THICKNESS_KEY] = found.key
    carrier[stored.THICKNESS_MINIMUM] = found.minimum
    carrier[stored.THICKNESS_GAP] = found.settings.between.name == "GAP"
    carrier[stored.THICKNESS_NORMALS] = found.normals
    carrier[stored.SAMPLED] = found.chosen.reason
    carrier[stored.SECONDS] = found.seconds
    carrier[stored.WARNINGS] = "\n".join(found.warnings)
    carrier[stored.THICKNESS_LOCAL] = local.ravel().tolist()
    if len(found.triangles):
        carrier[stored.THICKNESS_PLACE] = _moved(local, found.thinnest_place).tolist()


def _remember_parts(carrier: bpy.types.Object, parts: ThinParts) -> None:
    local = np.reshape(carrier[stored.THICKNESS_LOCAL], (4, 4))
    rows = [
        (*_moved(local, np.array(patch.place)).tolist(), patch.area, patch.minimum)
        for patch in parts.patches[:_MOST_PLACES]
    ]
    carrier[stored.THICKNESS_LIMIT] = parts.limit
    carrier[stored.THICKNESS_AREA], carrier[stored.THICKNESS_SHARE] = parts.area, parts.share
    carrier[stored.THICKNESS_PATCHES] = len(parts.patches)
    carrier[stored.THICKNESS_PLACES] = [number for row in rows for number in row]
    carrier[stored.THICKNESS_CURRENT] = -1
    carrier.update_tag()


def _moved(matrix: Floats, point: Floats) -> Floats:
    return matrix[:3, :3] @ point + matrix[:3, 3]
