# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports of samples: objects of their own, or an attribute of the source; how they are found and updated."""

from __future__ import annotations

from functools import partial

import bpy
import numpy as np
from mathutils.kdtree import KDTree
from numpy.typing import NDArray

from ...core.arrays import Floats
from ...core.errors import InvalidInputError
from ...core.machine.native import own_errors
from ...core.samples.sampling_report import SamplingReport
from ..mesh import stored
from ..mesh.attributes import EPSILON, SAMPLE_ATTRIBUTES, as_float32, set_attribute
from ..mesh.colours import colour_mesh, remember_colours
from ..mesh.evaluated_rows import keeps_rows
from ..mesh.material import epsilon_material
from ..mesh.step_weights import write_steps
from ..mesh.write_mesh import new_mesh
from ..objects.output_object import Product, place, remember

# A source with at least this many vertices for each sample shows a report well enough.
_ENOUGH = 0.25
_SCALE = 2.0  # where the colours end, in limits
FEATURE_SIZE = "ma_feature_size"  # of the attribute and of the vertex group, for modifiers that ask where detail is
# Weights of the group go from 1 at this share of the smallest sizes to 0 at the same share of the largest.
_ENDS = 0.05

REPORT = Product(" Sampling", (stored.EPSILON_SHARE, stored.SOURCE), material=epsilon_material)
is_report, report_of, check_report_writable = REPORT.has, REPORT.of, REPORT.check_writable


def has_report(thing: bpy.types.Object) -> bool:
    """Return whether this is a report, or a source that carries its report itself."""
    return thing.type == "MESH" and stored.EPSILON_SHARE in thing


def write_report(
    source: bpy.types.Object, found: SamplingReport, frame: np.ndarray, colours: bool = True
) -> bpy.types.Object:
    """Make the report of a source, or update the existing one; with `colours` it has `ma_color`."""
    build = partial(new_mesh, found, table=SAMPLE_ATTRIBUTES)
    of, end = (EPSILON.name if colours else ""), _SCALE * found.density.limit
    report, is_new = REPORT.write_coloured(source, build, of, found.epsilon, 0.0, end)
    if is_new:
        report.show_in_front = True  # it lies exactly on its source
    place(report, frame)
    analysis = found.chosen.samples.analysis
    remember(report, source, len(found.vertices), analysis.duplicates, found.warnings)
    _remember_density(report, found)
    return report


def _remember_density(report: bpy.types.Object, found: SamplingReport) -> None:
    density, worst = found.density, found.density.worst
    report[stored.SAMPLED] = found.chosen.reason
    report[stored.DENSITY] = str(density)
    report[stored.EPSILON_LIMIT] = density.limit
    report[stored.EPSILON_MEDIAN] = density.median
    report[stored.EPSILON_P95] = density.p95
    report[stored.EPSILON_SHARE] = density.share
    report[stored.EPSILON_SHARE_OF_ALL] = density.share_of_all
    report[stored.EPSILON_WORST] = [epsilon for _, epsilon in worst]
    report[stored.EPSILON_WORST_PLACES] = [number for where, _ in worst for number in where]
    report.update_tag()


# --- on the source itself


def check_source_writable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when a source cannot take an attribute for its vertices now."""
    if source.type != "MESH" or source.data.library is not None:
        kind = "of another file" if source.type == "MESH" else f"of type {source.type.capitalize()}"
        raise InvalidInputError(
            f"Expected a mesh of this file for Write To Source, found an object {kind}; "
            "choose Write To Copy"
        )
    if source.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected '{source.name}' in object mode, found it in {source.mode.lower()} mode; "
            "leave that mode, or choose Write To Copy"
        )


def shows_well(source: bpy.types.Object, found: SamplingReport) -> bool:
    """Return whether a source can take its report now, and has vertices enough to show it."""
    try:
        check_source_writable(source)
    except InvalidInputError:
        return False
    vertices = len(source.data.vertices)
    enough = found.shape.has_vertices(vertices) and vertices >= _ENOUGH * len(found.vertices)
    return enough and keeps_rows(source)


def write_on_source(
    source: bpy.types.Object, found: SamplingReport, colours: bool = True
) -> bpy.types.Object:
    """Give the vertices of a source `ma_epsilon`, the largest of the samples to which each is nearest, colours, and the
    feature size with its vertex group.

    Raises InvalidInputError where the source cannot take it, or its modifiers make other vertices.
    """
    check_source_writable(source)
    vertices, original = len(found.shape.points), len(source.data.vertices)
    if not found.shape.has_vertices(original):
        raise InvalidInputError(
            f"Expected as many vertices with modifiers as without for Write To Source, found "
            f"{vertices:,} and {original:,}; apply the modifiers, or choose Write To Copy"
        )
    if not keeps_rows(source):
        raise InvalidInputError(
            "Expected modifiers that keep the order of vertices for Write To Source, found some that "
            "change it; apply the modifiers, or choose Write To Copy"
        )
    values = _on_vertices(found)
    set_attribute(source.data, EPSILON.name, EPSILON.type, EPSILON.domain, values)
    _write_feature_size(source, found)
    if colours:
        alone = not len(source.data.color_attributes)  # else renders show those of the artist
        colour_mesh(source.data, values, 0.0, _SCALE * found.density.limit, render=alone)
    source.data.update()
    source[stored.POINTS] = len(found.vertices)
    source[stored.DUPLICATES] = found.chosen.samples.analysis.duplicates
    source[stored.WARNINGS] = "\n".join(found.warnings)
    of, end = (EPSILON.name if colours else ""), _SCALE * found.density.limit
    remember_colours(source, of, 0.0, end)
    _remember_density(source, found)
    return source


def _on_vertices(found: SamplingReport) -> NDArray[np.float32]:
    """Return the largest epsilon of the samples nearest to each vertex, (v,); where there is none, that of the sample
    nearest to the vertex."""
    vertices = found.shape.points
    to_vertex = _nearest(found.vertices, vertices)
    values = np.full(len(vertices), -1.0)
    np.maximum.at(values, to_vertex, found.epsilon)
    bare = np.flatnonzero(values < 0.0)
    values[bare] = found.epsilon[_nearest(vertices[bare], found.vertices)]
    return as_float32(values)


def _write_feature_size(source: bpy.types.Object, found: SamplingReport) -> None:
    """Give the vertices of a source the feature size at the nearest sample, and weights of where detail is."""
    with own_errors() as module:
        sizes = found.feature_size[module.nearest(found.vertices, found.shape.points)]
    set_attribute(source.data, FEATURE_SIZE, "FLOAT", "POINT", as_float32(sizes))
    write_steps(source, FEATURE_SIZE, _detail_of(sizes))


def _detail_of(sizes: Floats) -> Floats:
    """(n,) 1 where the feature size is smallest, 0 where it is largest, even steps of its logarithm in between; 0 where
    it is not known."""
    known = np.isfinite(sizes) & (sizes > 0.0)
    if not known.any():
        return np.zeros(len(sizes))
    logarithms = np.log(np.where(known, sizes, np.inf))
    low, high = np.quantile(logarithms[known], [_ENDS, 1.0 - _ENDS])
    if low == high:
        return known.astype(np.float64)
    return np.clip((high - logarithms) / (high - low), 0.0, 1.0)


def _nearest(points: Floats, others: Floats) -> NDArray[np.intp]:
    """Return the row of the nearest of the others to each point, (n,)."""
    tree = KDTree(len(others))
    for row, other in enumerate(others.tolist()):
        tree.insert(other, row)
    tree.balance()
    return np.fromiter((tree.find(point)[1] for point in points.tolist()), np.intp, len(points))
