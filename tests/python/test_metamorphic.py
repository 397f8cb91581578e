# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes of the input or the thresholds whose effect on the output is known exactly."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from support import inputs, meshes, messy, shapes

pytestmark = pytest.mark.oracle

INPUTS = {
    "ellipsoid": shapes.SHAPES["ellipsoid"].sample(3000, 7),
    "shell": shapes.SHAPES["shell"].sample(3000, 7),
    "random": np.random.default_rng(7).random((1500, 3)),
    "graded": inputs.generic("graded", 1500, 7),
}
DEGENERATE = {
    "grid cube": shapes.grid_cube(6),
    "torus grid": meshes.torus(around=24, across=12)[0],
    "uv sphere": meshes.uv_sphere()[0] * (1.0, 0.8, 0.6),
}
ANALYSIS_ARRAYS = ("samples", "edges", "theta", "rho", "theta_both", "rho_both", "side", "bounded")
MESH_ARRAYS = ("vertices", "radius", "face_offsets", "face_vertices")
MESH_ARRAYS += ("theta", "rho", "side", "generators")


@pytest.fixture(params=INPUTS)
def points(request):
    return INPUTS[request.param]


@pytest.fixture(params=[*INPUTS, *DEGENERATE])
def any_points(request):
    return (INPUTS | DEGENERATE)[request.param]


def everything(analysis, scale=1.0, **thresholds):
    """All arrays of an analysis and of what it extracts, lengths divided by scale."""
    mesh = analysis.extract(**thresholds)
    arrays = {f"analysis.{name}": getattr(analysis, name) for name in ANALYSIS_ARRAYS}
    arrays |= {f"mesh.{name}": getattr(mesh, name) for name in MESH_ARRAYS}
    counts = np.array([mesh.unbounded, mesh.zero_area, analysis.cells, analysis.duplicates])
    lengths = {"mesh.vertices": mesh.vertices / scale, "mesh.radius": mesh.radius / scale}
    return {**arrays, **lengths, "counts": counts}


def assert_same_bytes(a, b):
    for name in a:
        assert a[name].dtype == b[name].dtype and a[name].tobytes() == b[name].tobytes(), name


def facets(mesh, row=None):
    """generators -> number of corners, for facets of any order; samples may have other rows."""
    generators = mesh.generators if row is None else np.sort(row[mesh.generators], axis=1)
    return dict(zip(map(tuple, generators.tolist()), np.diff(mesh.face_offsets).tolist()))


@pytest.mark.parametrize("threads", [2, 3, 7, 0])
def test_thread_count_changes_no_byte(medial, any_points, threads):
    one = everything(medial.MedialAnalysis(any_points, threads=1))
    assert_same_bytes(one, everything(medial.MedialAnalysis(any_points, threads=threads)))


@pytest.mark.parametrize("exponent", [-30, -1, 1, 40])
def test_scale_by_a_power_of_two_changes_no_bit(medial, any_points, exponent):
    scale = 2.0**exponent
    plain, scaled = medial.MedialAnalysis(any_points), medial.MedialAnalysis(any_points * scale)
    for limit_set in (False, True):
        wanted = everything(plain, limit_set=limit_set)
        assert_same_bytes(wanted, everything(scaled, scale, limit_set=limit_set))


@pytest.mark.parametrize("seed", range(3))
def test_rotation_changes_only_last_bits(medial, points, seed):
    turn, digits = inputs.rotation(seed), 1e-7
    plain, moved = medial.MedialAnalysis(points), medial.MedialAnalysis(points @ turn.T)
    assert np.array_equal(plain.edges, moved.edges) and np.array_equal(plain.bounded, moved.bounded)
    for name in ("theta", "rho", "theta_both", "rho_both"):
        a, b = getattr(plain, name), getattr(moved, name)
        assert np.allclose(np.minimum(a, 1.5), np.minimum(b, 1.5), rtol=digits, atol=digits)
        assert np.allclose(a, b, rtol=digits, atol=1e-6)
    before, after = plain.extract(), moved.extract()
    assert np.array_equal(before.generators, after.generators)
    assert np.array_equal(before.face_offsets, after.face_offsets)
    assert (before.unbounded, before.zero_area) == (after.unbounded, after.zero_area)
    corners = before.vertices[before.face_vertices] @ turn.T, after.vertices[after.face_vertices]
    radius = before.radius[before.face_vertices]
    off = np.linalg.norm(np.subtract(*corners), axis=1)
    # The polygons may start at another corner: compare each corner with the nearest of its facet.
    face = np.repeat(np.arange(len(before.generators)), np.diff(before.face_offsets))
    for row in np.unique(face[off > digits * radius]):
        a, b = (places[face == row] for places in corners)
        gap = np.linalg.norm(a[:, None] - b[None], axis=2)
        most = 1e-5 * radius[face == row].max()
        assert max(gap.min(axis=0).max(), gap.min(axis=1).max()) <= most


@pytest.mark.parametrize("seed", range(3))
def test_permutation_permutes_ids(medial, points, seed):
    order = np.random.default_rng(seed).permutation(len(points))
    plain, mixed = medial.MedialAnalysis(points), medial.MedialAnalysis(points[order])
    edges = np.sort(order[mixed.edges], axis=1)
    row = np.lexsort(edges.T[::-1])
    assert np.array_equal(edges[row], plain.edges)
    for name in ("theta", "rho", "theta_both", "rho_both"):
        assert np.allclose(getattr(mixed, name)[row], getattr(plain, name), rtol=1e-9, atol=1e-9)
    assert np.array_equal(mixed.bounded[row], plain.bounded)
    assert facets(mixed.extract(), order) == facets(plain.extract())


SYMMETRIES = [
    [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
    [[0, 1, 0], [-1, 0, 0], [0, 0, 1]],
    [[-1, 0, 0], [0, -1, 0], [0, 0, 1]],
    [[-1, 0, 0], [0, 1, 0], [0, 0, 1]],
]


@pytest.mark.parametrize("turn", SYMMETRIES, ids=range(4))
def test_facets_of_a_grid_do_not_depend_on_how_it_is_triangulated(medial, turn):
    """Exact symmetries map facets of positive area to each other; cocircular triangles share normal and radius."""
    cube = DEGENERATE["grid cube"]
    before, after = (medial.MedialAnalysis(x).extract() for x in (cube, cube @ np.transpose(turn)))
    assert facets(before) == facets(after)


@pytest.mark.parametrize("name", ["torus", "knot"])
def test_limit_set_leaves_tubes_of_8000_samples_as_they_are(medial, name):
    """It acts on dense samples only, as the README and the panel say."""
    analysis = medial.MedialAnalysis(shapes.SHAPES[name].sample(8000, 0))
    inner = {"side": medial.Side.INNER}
    plain, limited = (analysis.extract(**inner, limit_set=x).generators for x in (False, True))
    assert len(plain) > 20_000 and np.array_equal(plain, limited)


def test_limit_set_halves_the_fins_of_a_torus_of_16000_samples(medial):
    torus = shapes.SHAPES["torus"]
    analysis = medial.MedialAnalysis(torus.sample(16000, 0))
    fins = []
    for limit_set in (False, True):
        mesh = analysis.extract(side=medial.Side.INNER, limit_set=limit_set)
        away = torus.axis_distance(mesh.vertices)[mesh.face_vertices] / torus.small
        fins.append(np.count_nonzero(np.maximum.reduceat(away, mesh.face_offsets[:-1]) > 0.01))
    assert 0.4 * fins[0] < fins[1] < 0.6 * fins[0]


def test_duplicates_are_merged_and_counted(medial, points):
    rng = np.random.default_rng(1)
    extra = rng.integers(0, len(points), 200)
    repeated = np.concatenate((points, points[extra]))
    plain, merged = medial.MedialAnalysis(points), medial.MedialAnalysis(repeated)
    assert merged.duplicates == 200 and plain.duplicates == 0
    assert np.array_equal(merged.samples, np.arange(len(points)))
    one, other = (everything(x) | {"counts": np.zeros(1)} for x in (plain, merged))
    assert_same_bytes(one, other)


def test_negative_zero_is_zero(medial):
    points = np.concatenate((inputs.grid((3, 3, 3)), [[-0.0, 0.0, -0.0]]))
    assert medial.MedialAnalysis(points).duplicates == 1


def test_duplicates_keep_a_mesh_closed(medial):
    """A seam of doubled vertices, as every UV-mapped mesh has after import."""
    vertices, triangles = meshes.jitter(meshes.icosphere(2), 1e-2)
    soup = messy.soup((vertices, triangles))
    analysis = medial.MedialAnalysis(*soup)
    plain = medial.MedialAnalysis(vertices, triangles)
    assert analysis.closed and analysis.boundary_edges == 0
    assert analysis.duplicates == len(soup[0]) - len(vertices)
    assert sorted(analysis.side.tolist()) == sorted(plain.side.tolist())


def test_float32_input_is_converted(medial, points):
    single = points.astype(np.float32)
    a, b = medial.MedialAnalysis(single), medial.MedialAnalysis(single.astype(float))
    assert_same_bytes(everything(a), everything(b))


def test_strided_views_are_read_as_they_look(medial, points):
    wide = np.zeros((len(points) * 2, 6))
    wide[::2, 1:4] = points
    wanted = everything(medial.MedialAnalysis(points))
    for view in (wide[::2, 1:4], np.asfortranarray(points)):
        assert_same_bytes(wanted, everything(medial.MedialAnalysis(view)))


def test_one_analysis_may_be_used_from_several_threads(medial):
    analysis = medial.MedialAnalysis(INPUTS["shell"])
    wanted = [everything(analysis, theta=t) for t in (0.1, 0.4, 0.8)]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda t: everything(analysis, theta=t), [0.1, 0.4, 0.8] * 8))
    for i, arrays in enumerate(found):
        assert_same_bytes(wanted[i % 3], arrays)
