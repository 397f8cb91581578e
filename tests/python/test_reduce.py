# SPDX-License-Identifier: GPL-3.0-or-later
"""Small medial meshes: topology by an independent count, exact shapes, solids measured by brute force, files."""

from dataclasses import replace

import medial_axis
import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.axis.medial_axis import MedialAxis
from medial_axis.core.axis.polygon_triangles import triangulate_facets
from medial_axis.core.errors import Cancelled, InvalidInputError, ReadError
from medial_axis.core.files.read_ma import read_ma
from medial_axis.core.files.write import export_axis
from medial_axis.core.machine.progress import Progress
from medial_axis.core.rebuild.reduce import reduce_axis, reduced_difference
from support import meshes, readers, topology
from support.reference import betti_numbers
from support.thick_meshes import ellipsoid

pytestmark = pytest.mark.oracle

NO_EDGES = np.zeros((0, 2), np.int32)
NO_TRIANGLES = np.zeros((0, 3), np.int32)


def betti(vertices, triangles, edges):
    return betti_numbers(vertices, triangles.tolist(), edges.tolist())


def grid(along=13, across=9, radius=0.3):
    """A flat rectangle, 6 by 4, as triangles of balls of one radius."""
    x, y = np.meshgrid(np.linspace(0, 6, along), np.linspace(0, 4, across), indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    triangles = meshes.lattice(np.arange(x.size).reshape(along, across))
    return vertices, np.full(len(vertices), radius), triangles, NO_EDGES


def wire(count=40, radii=(0.5, 0.2), length=3.0):
    """The axis of a capsule whose ends have these radii."""
    share = np.linspace(0, 1, count)
    vertices = np.outer(share, [length, 0, 0])
    edges = np.column_stack([np.arange(count - 1), np.arange(1, count)]).astype(np.int32)
    return vertices, radii[0] + share * (radii[1] - radii[0]), NO_TRIANGLES, edges


def random_complex(seed, vertices=14, triangles=16, edges=10):
    random = np.random.default_rng(seed)
    corners = np.array([random.choice(vertices, 3, replace=False) for _ in range(triangles)])
    pairs = np.array([random.choice(vertices, 2, replace=False) for _ in range(edges)])
    corners = np.unique(np.sort(corners, axis=1), axis=0).astype(np.int32)
    places, radii = random.normal(size=(vertices, 3)), random.uniform(0.01, 0.1, vertices)
    return places, radii, corners, pairs.astype(np.int32).reshape(-1, 2)


@pytest.mark.parametrize("seed", range(150))
def test_any_complex_keeps_its_betti_numbers(medial, seed):
    mesh = random_complex(seed, triangles=4 + seed % 30, edges=seed % 17)
    before = betti(len(mesh[0]), *mesh[2:])
    for wanted in (11, 6, 3, 1):
        vertices, radius, triangles, edges = medial.reduce_sphere_mesh(*mesh, wanted)
        assert betti(len(vertices), triangles, edges) == before
        assert len(radius) == len(vertices)


def test_a_complex_that_can_be_a_point_becomes_one(medial):
    vertices, radius, triangles, edges = medial.reduce_sphere_mesh(*grid(), 1)
    assert (len(vertices), len(triangles), len(edges)) == (1, 0, 0)
    assert np.isfinite(vertices).all() and (radius >= 0).all()


@pytest.mark.parametrize("count", [3, 4, 30])
def test_a_loop_keeps_three_vertices(medial, count):
    turn = np.arange(count) * 2 * np.pi / count
    vertices = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    edges = np.column_stack([np.arange(count), (np.arange(count) + 1) % count]).astype(np.int32)
    found = medial.reduce_sphere_mesh(vertices, np.full(count, 0.1), NO_TRIANGLES, edges, 1)
    assert len(found[0]) == 3 and found[3].tolist() == [[0, 1], [0, 2], [1, 2]]


def test_the_shell_of_a_tetrahedron_is_the_least_that_holds_a_cavity(medial):
    points, triangles = meshes.icosphere(2)
    radius = np.full(len(points), 0.1)
    found = medial.reduce_sphere_mesh(points, radius, triangles.astype(np.int32), NO_EDGES, 1)
    assert (len(found[0]), len(found[2]), len(found[3])) == (4, 4, 0)


def test_a_flat_sheet_becomes_two_triangles_without_an_error(medial):
    mesh = grid()
    vertices, radius, triangles, edges = medial.reduce_sphere_mesh(*mesh, 4)
    assert sorted(map(tuple, vertices.tolist())) == [(0, 0, 0), (0, 4, 0), (6, 0, 0), (6, 4, 0)]
    assert (radius == 0.3).all() and len(triangles) == 2 and len(edges) == 0
    points = medial.solid_surface(*mesh, 0.2)
    left = np.asarray((vertices, radius, triangles, edges), dtype=object)
    assert np.abs(medial.solid_distances(points, *left)).max() < 1e-12


@pytest.mark.parametrize("wanted", [200, 100, 60, 25])
@pytest.mark.parametrize("radii", ["wavy", "random"])
def test_no_triangle_of_a_sheet_turns_over(medial, wanted, radii):
    vertices, _, triangles, edges = grid(21, 21)
    away = np.linalg.norm(vertices[triangles].mean(axis=1) - (3, 2, 0), axis=1)
    triangles = triangles[(away > 0.6) & (away < 2)]
    used, corners = np.unique(triangles, return_inverse=True)
    x, y, _ = vertices[used].T
    wavy = 0.3 + 0.1 * np.sin(3 * x) * np.cos(5 * y)
    uneven = np.random.default_rng(1).uniform(0.1, 0.3, len(used))
    balls = vertices[used], wavy if radii == "wavy" else uneven
    ring = corners.reshape(-1, 3).astype(np.int32)
    places, _, left, _ = medial.reduce_sphere_mesh(*balls, ring, edges, wanted)
    assert len(left) > wanted / 2 and (topology.vector_areas(places, left)[:, 2] > 0).all()


@pytest.mark.parametrize("radii", [(0.5, 0.5), (0.5, 0.2), (0.05, 1.0)])
def test_a_cone_becomes_its_two_ends(medial, radii):
    found = medial.reduce_sphere_mesh(*wire(radii=radii), 2)
    order = np.argsort(found[0][:, 0])
    assert found[0][order].tolist() == [[0, 0, 0], [3, 0, 0]]
    assert found[1][order].tolist() == list(radii)
    assert found[3].tolist() == [[0, 1]]


def test_enough_vertices_change_nothing(medial):
    mesh = grid()
    for before, after in zip(mesh, medial.reduce_sphere_mesh(*mesh, len(mesh[0])), strict=True):
        assert np.array_equal(before, after)


def least_of_samples(query, spheres, steps=200):
    """The signed distance to a slab, a cone or a ball at many of its balls: never less, and little more."""
    shares = np.random.default_rng(3).dirichlet([0.6] * len(spheres), steps * steps)
    balls = np.concatenate([shares, np.eye(len(spheres))]) @ spheres
    return (np.linalg.norm(balls[:, :3] - query, axis=1) - balls[:, 3]).min()


@pytest.mark.parametrize("count", [1, 2, 3])
def test_distances_to_slabs_cones_and_balls(medial, count):
    random = np.random.default_rng(count)
    for _ in range(12):
        spheres = np.column_stack([random.normal(size=(count, 3)), random.uniform(0, 1, count)])
        triangles = np.array([[0, 1, 2]], np.int32) if count == 3 else NO_TRIANGLES
        edges = np.array([[0, 1]], np.int32) if count == 2 else NO_EDGES
        queries = 2 * random.normal(size=(4, 3))
        mesh = (np.ascontiguousarray(spheres[:, :3]), spheres[:, 3].copy(), triangles, edges)
        found = medial.solid_distances(queries, *mesh)
        for query, distance in zip(queries, found, strict=True):
            sampled = least_of_samples(query, spheres)
            assert distance - 1e-12 <= sampled < distance + 0.03


def test_points_on_the_surface_of_a_solid(medial):
    mesh = wire(count=3)
    points = medial.solid_surface(*mesh, 0.05)
    assert np.abs(medial.solid_distances(points, *mesh)).max() < 1e-6
    random = np.random.default_rng(1).normal(size=(300, 3))
    outside = random / np.linalg.norm(random, axis=1)[:, None] * 10
    gaps = np.linalg.norm(points[medial.nearest(points, outside)] - outside, axis=1)
    assert np.allclose(gaps, medial.solid_distances(outside, *mesh), atol=0.01)


@pytest.mark.parametrize("spacing", [1e-4, 1e-9, 5e-324])
def test_more_points_than_memory_are_refused(medial, spacing):
    """The work is bounded before it begins, so nothing has to be interrupted."""
    with pytest.raises(medial.InvalidInputError, match="Expected a spacing for fewer than"):
        medial.solid_surface(*wire(count=3), spacing)


@pytest.fixture(scope="module")
def computed():
    shape = meshes.shape_of(ellipsoid(subdivisions=3))
    return shape, medial_axis.compute(shape.points, shape.triangles)


def test_measuring_ends_when_it_is_cancelled(computed):
    shape, found = computed
    small, progress = reduce_axis(found.axis, 20), Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        reduced_difference(small, shape, progress)


@pytest.mark.slow
def test_the_solid_of_an_ellipsoid_stays(computed):
    shape, found = computed
    errors = [reduced_difference(reduce_axis(found.axis, n), shape) for n in (8, 20, 60)]
    assert errors[0].largest < 0.04 and errors[1].largest < 0.02 and errors[2].mean < 0.003
    assert errors[0].mean > errors[1].mean > errors[2].mean


@pytest.mark.slow
@pytest.mark.parametrize("name", ["3holes.off", "rocker-arm.off", "hand_closed.obj", "knot1.off"])
def test_real_meshes_keep_their_holes(data_file, name):
    shape = medial_axis.read(data_file(name))
    axis = medial_axis.compute(shape.points, shape.triangles, sampling="vertices").axis
    triangles = triangulate_facets(axis.vertices, axis.face_offsets, axis.face_vertices)
    before = betti(len(axis.vertices), triangles, axis.edges)
    for wanted in (200, 50):
        reduced = medial_axis.reduce(axis, wanted)
        corners = reduced.face_vertices.reshape(-1, 3)
        assert len(reduced.vertices) <= wanted
        assert betti(len(reduced.vertices), corners, reduced.edges) == before


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"wanted": 0}, "at least 1 wanted vertex, found 0"),
        ({"radius": -0.1}, "radii of 0 or more|radii of 0 to"),
        ({"radius": np.nan}, "radii of 0 to"),
        ({"triangle": 99}, "rows of 117 vertices in triangles, found 117|found 99|found"),
        ({"place": np.inf}, "finite"),
    ],
)
def test_what_is_refused(medial, change, match):
    vertices, radius, triangles, edges = grid()
    radius[3] = change.get("radius", radius[3])
    vertices[4, 1] = change.get("place", 0)
    if "triangle" in change:
        triangles[2, 1] = len(vertices)
    with pytest.raises(medial.InvalidInputError, match=match):
        medial.reduce_sphere_mesh(vertices, radius, triangles, edges, change.get("wanted", 5))


def test_another_side_is_refused(computed):
    axis = computed[1].axis
    other = replace(axis, side=np.full(axis.facets, 2, np.int32))
    with pytest.raises(InvalidInputError, match="axis of the inside"):
        reduce_axis(other, 10)


def test_ma_is_read_back_here_and_elsewhere(computed, tmp_path):
    axis = reduce_axis(computed[1].axis, 40)
    path = export_axis(axis, tmp_path / "small.ma")
    balls, edges, triangles = readers.read_ma(path)
    assert np.array_equal(balls[:, :3], axis.vertices) and np.array_equal(balls[:, 3], axis.radius)
    assert np.array_equal(triangles.reshape(-1), axis.face_vertices)
    assert betti(len(balls), triangles.astype(int), edges.astype(int)) == (1, 0, 0)
    back = read_ma(path)
    for name in MedialAxis.__dataclass_fields__:
        if name != "level":
            assert np.array_equal(getattr(back, name), getattr(axis, name)), name


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("", "numbers of vertices, edges and triangles"),
        ("1 0\n", "numbers of vertices, edges and triangles"),
        ("2 0 0\nv 0 0 0 1\n", "Expected 2 lines"),
        ("1 0 0\nv 0 0 0\n", "'v' and 4 finite numbers in line 2"),
        ("1 0 0\nv 0 0 0 nan\n", "'v' and 4 finite numbers"),
        ("1 0 0\nv 0 0 0 -1\n", "radii of 0 or more"),
        ("1 1 0\nv 0 0 0 1\ne 0 1\n", "between 1 vertices"),
    ],
)
def test_broken_ma(tmp_path, text, match):
    path = tmp_path / "broken.ma"
    path.write_text(text)
    with pytest.raises(ReadError, match=match):
        read_ma(path)


def test_comments_and_wires_of_other_tools(tmp_path):
    path = tmp_path / "other.ma"
    path.write_text(
        "# made by hand\n4 4 1\nv 0 0 0 1\nv 1 0 0 1\n\nv 0 1 0 1\nv 5 5 5 .5\n"
        "e 1 0\ne 1 2\ne 2 0\ne 3 2\nf 0 1 2\n"
    )
    axis = read_ma(path)
    assert axis.face_vertices.tolist() == [0, 1, 2] and axis.edges.tolist() == [[2, 3]]
    assert axis.radius.tolist() == [1, 1, 1, 0.5]


def test_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    meshes.write_off(tmp_path / "shape.off", ellipsoid(subdivisions=3))
    assert cli.main(["shape.off", "shape.ma", "--vertices", "12"]) == 0
    assert len(readers.read_ma(tmp_path / "shape.ma")[0]) <= 12
    assert cli.main(["shape.off", "shape.npz", "--vertices", "12"]) == 0
