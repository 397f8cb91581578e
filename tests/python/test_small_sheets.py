# SPDX-License-Identifier: GPL-3.0-or-later
"""Small medial meshes of solids with sharp edges: nodes, curves and flat sheets stay, exactly."""

from dataclasses import replace
from functools import cache

import medial_axis
import numpy as np
import pytest
from medial_axis.core.axis.polygon_triangles import axis_triangles
from medial_axis.core.files.read_ma import read_ma
from medial_axis.core.files.write import export_axis
from medial_axis.core.rebuild.reduce import reduce_axis
from support import crisp_solids
from support.measure import polygons
from test_reduce import NO_EDGES, betti, grid

pytestmark = pytest.mark.oracle


@cache
def computed(name):
    mesh = crisp_solids.solid(name).mesh
    return medial_axis.compute(*mesh, sampling="surface", samples=4000).axis


def betti_of(axis):
    return betti(len(axis.vertices), axis_triangles(axis), axis.edges)


@pytest.mark.parametrize(("name", "vertices", "sheets"), [("box", 12, 13), ("wedge", 8, 9)])
@pytest.mark.parametrize("wanted", [12, 200])
def test_flat_sheets_are_one_polygon_each_on_exact_nodes(name, vertices, sheets, wanted):
    solid, whole = crisp_solids.solid(name), computed(name)
    small = reduce_axis(whole, wanted)
    assert (len(small.vertices), small.facets, len(small.edges)) == (vertices, sheets, 0)
    assert solid.off_axis(small.vertices).max() < 1e-12 * solid.diagonal
    assert np.abs(solid.distance(small.vertices) - small.radius).max() < 1e-12 * solid.diagonal
    nodes = whole.vertices[whole.structure.node_vertex]
    assert np.array_equal(np.unique(nodes, axis=0), np.unique(small.vertices, axis=0))


@pytest.mark.parametrize(
    ("name", "wanted"), [("box", 30), ("wedge", 30), ("bracket", 30), ("plate", 30), ("plate", 100)]
)
def test_topology_nodes_and_valid_polygons(name, wanted):
    whole = computed(name)
    small = reduce_axis(whole, wanted)
    assert len(small.vertices) <= wanted and small.facets >= whole.structure.parts
    assert betti_of(small) == tuple(whole.level.betti)
    nodes = set(map(tuple, whole.vertices[whole.structure.node_vertex].tolist()))
    assert nodes <= set(map(tuple, small.vertices.tolist()))
    faces = [corners.tolist() for corners in polygons(small)]
    assert all(len(set(face)) == len(face) for face in faces)
    assert len({tuple(sorted(face)) for face in faces}) == len(faces)


@pytest.mark.parametrize(("name", "wanted"), [("box", 3), ("bracket", 40)])
def test_an_axis_stored_in_single_precision_becomes_the_same_mesh(name, wanted):
    whole = computed(name)
    single = lambda values: values.astype(np.float32).astype(float)
    level = replace(whole.level, exact=single(whole.level.exact))
    places, radius = single(whole.vertices), single(whole.radius)
    stored = replace(whole, vertices=places, radius=radius, level=level)
    one, two = reduce_axis(whole, wanted), reduce_axis(stored, wanted)
    assert np.array_equal(one.face_vertices, two.face_vertices)
    assert np.array_equal(one.face_offsets, two.face_offsets)
    assert np.array_equal(one.vertices.astype(np.float32), two.vertices.astype(np.float32))


def test_fewer_vertices_than_nodes_make_a_mesh_without_sheets():
    small = reduce_axis(computed("box"), 8)
    assert len(small.vertices) <= 8 and betti_of(small) == (1, 0, 0)


def test_a_smooth_body_has_triangles_only():
    small = reduce_axis(computed("ellipsoid"), 40)
    assert len(small.vertices) == 40
    assert (np.diff(small.face_offsets) == 3).all()


# --- flat sheets by themselves


def sheets(medial, mesh, part, nodes, wanted, **options):
    nodes = np.array(nodes, np.int32)
    return medial.reduce_sheets(*mesh, part.astype(np.int32), nodes, wanted, **options)


def test_a_concave_sheet_is_one_polygon_and_a_sheet_with_a_hole_two(medial):
    vertices, radius, triangles, _ = grid(13, 13)
    x, y, _ = vertices[triangles].mean(axis=1).T
    concave, ring = ~((x > 3) & (y > 2)), ~((abs(x - 3) < 1) & (abs(y - 2) < 1))
    for kept, corners, wanted in ((concave, 6, 1), (ring, 8, 2)):
        used, rows = np.unique(triangles[kept], return_inverse=True)
        left = rows.reshape(-1, 3).astype(np.int32)
        mesh = (vertices[used], radius[used], left, NO_EDGES)
        found = sheets(medial, mesh, np.zeros(len(left)), [], 20)
        assert len(found[3]) - 1 == wanted and len(np.unique(found[4])) == corners
        assert (found[2] >= 0).all() and (found[1] == 0.3).all()


def test_the_border_between_two_sheets_stays(medial):
    mesh = grid(13, 9)
    part = mesh[0][mesh[2]].mean(axis=1)[:, 0] > 2.5
    found = sheets(medial, mesh, part, [], 20)
    assert len(found[3]) - 1 == 2 and found[5].tolist() == [0, 1]
    assert sorted(set(found[0][:, 0].tolist())) == [0, 2.5, 6] and len(found[0]) == 6


@pytest.mark.parametrize("wanted", range(1, 7))
def test_a_bent_sheet_without_nodes_is_never_lost(medial, wanted):
    """A saddle, however few vertices are wanted: it is a triangle at least, or it cannot be so small."""
    vertices, *others = grid(9, 9)
    x, y, _ = vertices.T
    saddle = (np.column_stack((x, y, 0.2 * (x - x.mean()) * (y - y.mean()))), *others)
    found = sheets(medial, saddle, np.zeros(len(others[1])), [], wanted)
    assert found is None or (len(found[5]) >= 1 and len(found[0]) >= 3 and not len(found[6]))


def test_threads_and_scale_change_no_sheet(medial):
    whole, size = computed("bracket"), 2.0**30
    part = np.repeat(whole.structure.part, np.diff(whole.face_offsets) - 2)
    others = part, whole.structure.node_vertex, 60
    mesh = (whole.vertices, whole.radius, axis_triangles(whole), NO_EDGES)
    one, three = (sheets(medial, mesh, *others, threads=threads) for threads in (1, 3))
    assert all(a.tobytes() == b.tobytes() for a, b in zip(one, three, strict=True))
    large = sheets(medial, (size * mesh[0], size * mesh[1], *mesh[2:]), *others)
    assert np.array_equal(large[0], size * one[0]) and np.array_equal(large[4], one[4])


@pytest.mark.parametrize(
    ("parts", "nodes", "match"),
    [(5, [], "one part per triangle, found 5"), (192, [999], "Expected nodes .* found 999")],
)
def test_labels_that_do_not_fit_are_refused(medial, parts, nodes, match):
    with pytest.raises(medial.InvalidInputError, match=match):
        sheets(medial, grid(), np.zeros(parts), nodes, 20)


def test_files_of_polygons(tmp_path):
    small = reduce_axis(computed("bracket"), 60)
    back = read_ma(export_axis(small, tmp_path / "small.ma"))
    assert np.array_equal(back.vertices, small.vertices)
    assert np.array_equal(back.radius, small.radius)
    assert betti_of(back) == (1, 0, 0)
    for suffix in ("ply", "obj", "off", "npz"):
        assert export_axis(small, tmp_path / f"small.{suffix}").stat().st_size > 0
