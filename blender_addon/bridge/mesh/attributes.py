# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes in Blender: tables of those of a medial axis and of samples, and the normals of oriented points."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.arrays import Floats
from ...core.axis.medial_axis import LevelValues, MedialAxis
from ...core.axis.structure import Structure
from ...core.errors import InvalidInputError
from ...core.samples.sampling_report import SamplingReport


@dataclass(frozen=True)
class Attribute:
    """One attribute of a mesh that is made, with Blender's identifiers of its domain and its type.

    `field` is that of `MedialAxis`, its level, or `SamplingReport`; `column` picks one where Blender has no type for
    pairs. `dtype` is what Blender stores, so that it is copied without conversion.
    """

    name: str
    field: str
    domain: str
    type: str
    dtype: type
    column: int | None = None

    @property
    def key(self) -> str:
        """Blender's name for the numbers of an element."""
        return _key_of(self.type)

    def values(self, axis: MedialAxis | LevelValues | Structure | SamplingReport) -> NDArray:
        """The flat array that `foreach_set` wants; of edges, those that the values are about."""
        array = getattr(axis, self.field)
        if self.column is not None:
            array = array[:, self.column]
        if self.dtype is np.float32:
            array = as_float32(array)
        return np.ascontiguousarray(array, self.dtype).ravel()


# The numbers of an element of each kind of attribute: how many there are, and Blender's type of them.
_NUMBERS = {
    "FLOAT": (1, np.float32),
    "FLOAT_VECTOR": (3, np.float32),
    "INT": (1, np.int32),
    "INT32_2D": (2, np.int32),
    "BOOLEAN": (1, np.bool_),
}


def as_float32(values: Floats) -> NDArray[np.float32]:
    """Numbers as Blender holds them; what is too large for it is the largest one, for infinity spoils colours."""
    return np.minimum(values, np.finfo(np.float32).max).astype(np.float32)


RADIUS = Attribute("ma_radius", "radius", "POINT", "FLOAT", np.float32)
_FACE = (
    Attribute("ma_theta", "theta", "FACE", "FLOAT", np.float32),
    Attribute("ma_rho", "rho", "FACE", "FLOAT", np.float32),
    Attribute("ma_side", "side", "FACE", "INT", np.int32),
)
_PAIR = (Attribute("ma_generators", "generators", "FACE", "INT32_2D", np.int32),)
_TWO_INTS = (
    Attribute("ma_generator_a", "generators", "FACE", "INT", np.int32, column=0),
    Attribute("ma_generator_b", "generators", "FACE", "INT", np.int32, column=1),
)
# Only clean forms and curves have these attributes; lengths are percent of the diagonal, as on the sliders.
LEVEL_ATTRIBUTES = (
    Attribute("ma_exact", "exact", "POINT", "FLOAT_VECTOR", np.float32),
    Attribute("ma_exact_radius", "exact_radius", "POINT", "FLOAT", np.float32),
    Attribute("ma_place", "place", "POINT", "INT", np.int32),
    Attribute("ma_sheet", "sheet", "FACE", "FLOAT", np.float32),
    Attribute("ma_erosion", "erosion", "FACE", "FLOAT", np.float32),
    Attribute("ma_limb", "limb", "EDGE", "FLOAT", np.float32),
)

# Only clean forms have these; the edges are those of the facets, which come first.
PART = Attribute("ma_part", "part", "FACE", "INT", np.int32)
_KIND = Attribute("ma_kind", "kind", "POINT", "INT", np.int32)
STRUCTURE_ATTRIBUTES = (
    PART,
    Attribute("ma_seam", "seam", "EDGE", "INT", np.int32),
    Attribute("ma_curve", "curve", "EDGE", "INT", np.int32),
    _KIND,
)

# Directions at vertices, of sheets and of curves; no fields of an axis, for they follow from it.
NORMAL, TANGENT = "ma_normal", "ma_tangent"

EPSILON = Attribute("ma_epsilon", "epsilon", "POINT", "FLOAT", np.float32)
SAMPLE_ATTRIBUTES = (
    EPSILON,
    Attribute("ma_feature_size", "feature_size", "POINT", "FLOAT", np.float32),
    Attribute("ma_spacing", "spacing", "POINT", "FLOAT", np.float32),
    Attribute("ma_moved", "moved", "POINT", "FLOAT", np.float32),
)


def attributes() -> tuple[Attribute, ...]:
    """The attributes of every medial axis, as this Blender can hold them."""
    types = bpy.types.Attribute.bl_rna.properties["data_type"].enum_items
    return (RADIUS, *_FACE, *(_PAIR if "INT32_2D" in types else _TWO_INTS))


def _key_of(kind: str) -> str:
    """The property in which Blender keeps the values of a kind of attribute."""
    return "vector" if kind == "FLOAT_VECTOR" else "value"


def set_attribute(mesh: bpy.types.Mesh, name: str, kind: str, domain: str, values: NDArray) -> None:
    """Give a mesh in object mode an attribute; one of that name and of another kind is replaced.

    Raises InvalidInputError where something else has the name, such as a vertex group.
    """
    found = mesh.attributes.get(name)
    if found is not None and (found.domain, found.data_type) != (domain, kind):
        mesh.attributes.remove(found)
        found = None
    target = found or _new_attribute(mesh, name, kind, domain)
    target.data.foreach_set(_key_of(kind), values)


def _new_attribute(mesh: bpy.types.Mesh, name: str, kind: str, domain: str) -> bpy.types.Attribute:
    made = mesh.attributes.new(name, kind, domain)
    if made is not None and made.name == name:
        return made
    if made is not None:  # by another name, which nothing would read
        mesh.attributes.remove(made)
    raise InvalidInputError(
        f"Expected the name '{name}' to be free on the mesh '{mesh.name}', found a vertex group, a UV "
        "map or the like that has it; rename that"
    )


def read_attribute(
    attributes: bpy.types.AttributeGroup, name: str, kind: str, domain: str
) -> NDArray | None:
    """Return the numbers of an attribute, (n,) or (n, 2 or 3); None where there is none of that kind and domain."""
    found = attributes.get(name)
    if found is None or (found.domain, found.data_type) != (domain, kind):
        return None
    width, dtype = _NUMBERS[kind]
    values = np.empty(len(found.data) * width, dtype)
    found.data.foreach_get(_key_of(kind), values)
    return values.reshape(-1, width) if width > 1 else values


# Normals of points, a vector each. "normal" is what Blender's PLY importer writes from 4.0; earlier
# versions keep that name of a mesh to themselves and make no such attribute.
NORMAL_NAMES = ("normal", "ma_normal")


def add_normals(attributes: bpy.types.AttributeGroup, normals: NDArray) -> None:
    """Give the points of a mesh or point cloud, by its `attributes`, (n, 3) normals."""
    made = (attributes.new(name, "FLOAT_VECTOR", "POINT") for name in NORMAL_NAMES)
    found = next(attribute for attribute in made if attribute is not None)
    found.data.foreach_set("vector", np.ascontiguousarray(normals, np.float32).ravel())


def read_normals(attributes: bpy.types.AttributeGroup) -> Floats | None:
    """Return the normals of the points of a mesh or point cloud, (n, 3); None when it has none.

    Those of the sheets of a medial axis are none: neither side of a sheet is outside.
    """
    for name in NORMAL_NAMES:
        if name == NORMAL and _KIND.name in attributes:
            continue
        found = read_attribute(attributes, name, "FLOAT_VECTOR", "POINT")
        if found is not None:
            return found.astype(np.float64)
    return None


def read_vectors(elements: bpy.types.bpy_prop_collection, name: str) -> Floats:
    """Return a vector property of all elements, (n, 3)."""
    values = np.empty(3 * len(elements), np.float32)
    elements.foreach_get(name, values)
    return values.astype(np.float64).reshape(-1, 3)
