# SPDX-License-Identifier: GPL-3.0-or-later
"""The structure of an axis on its object: a table as text, and the attributes of its mesh."""

from __future__ import annotations

import json

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.arrays import Ints
from ...core.axis.medial_axis import MedialAxis
from ...core.axis.structure import FIELDS, Structure
from ...core.axis.structure_table import counts_of
from ..mesh import stored
from ..mesh.attributes import STRUCTURE_ATTRIBUTES, read_attribute
from ..mesh.mesh_arrays import read_edges

_OF_TABLE = tuple(name for name in FIELDS if name.startswith(("part_", "curve_", "node_")))


def remember_structure(result: bpy.types.Object, axis: MedialAxis) -> None:
    """Keep the table of an axis on its object, or forget an older one."""
    structure = axis.structure
    if structure is None:
        for name in (stored.STRUCTURE, stored.STRUCTURE_COUNTS):
            if name in result:
                del result[name]
        return
    table = {name: getattr(structure, name).tolist() for name in _OF_TABLE}
    result[stored.STRUCTURE] = json.dumps(table, separators=(",", ":"))
    result[stored.STRUCTURE_COUNTS] = list(counts_of(structure).values())


def counts_on(result: bpy.types.Object) -> dict[str, int]:
    """The numbers of sheets, seams, rims, creases, junctions and corners; nothing where they are not known."""
    names = ("sheets", "seams", "rims", "creases", "junctions", "corners")
    found = list(result.get(stored.STRUCTURE_COUNTS, ()))
    return dict(zip(names, found, strict=True)) if len(found) == len(names) else {}


def read_structure(
    mesh: bpy.types.Mesh, alone: NDArray[np.intp], result: bpy.types.Object, generators: Ints
) -> Structure | None:
    """The structure of a mesh; None where it has none, or where an artist has changed its elements.

    `alone` are the edges without a face; `generators` are as the mesh has them: exchanged where the facet was turned.
    """
    if stored.STRUCTURE not in result:
        return None
    table = {
        name: np.array(
            values, np.float64 if name.endswith(("area", "radius", "length")) else np.int32
        )
        for name, values in json.loads(result[stored.STRUCTURE]).items()
    }
    columns = {
        a.field: read_attribute(mesh.attributes, a.name, a.type, a.domain)
        for a in STRUCTURE_ATTRIBUTES
    }
    if any(column is None for column in columns.values()):
        return None
    of_facets = np.ones(len(mesh.edges), bool)
    of_facets[alone] = False
    edges = read_edges(mesh)[of_facets]
    for name in ("seam", "curve"):
        columns[name] = columns[name][of_facets]
    table["part_patches"] = table["part_patches"].reshape(-1, 2)
    found = Structure(
        turned=generators[:, 0] > generators[:, 1], facet_edges=edges, **columns, **table
    )
    return found if _is_whole(found) else None


def _is_whole(structure: Structure) -> bool:
    """Return whether the elements are still those that the table is about: every part, curve and node is there once."""
    parts, curves = np.unique(structure.part), np.unique(structure.curve[structure.curve >= 0])
    nodes = np.flatnonzero(np.isin(structure.kind, (2, 4)))
    return (
        np.array_equal(parts, np.arange(structure.parts))
        and np.array_equal(curves, np.arange(len(structure.curve_kind)))
        and np.array_equal(nodes, np.sort(structure.node_vertex))
    )
