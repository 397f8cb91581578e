# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods that the paper compares itself with, of the module _medial_study: against the restatement of them in
NumPy (lab/race/rivals.py, which test_race.py holds against brute force), and against convex hulls."""

from itertools import combinations

import numpy as np
import pytest
from scipy.spatial import ConvexHull, cKDTree

from lab.race import rivals, solids


def sampled(name, count):
    return np.ascontiguousarray(solids.SOLIDS[name].shape.random_sample(count, 4))


def grid():
    """A box of 6 x 5 x 4 points: all cells are cospherical."""
    steps = np.meshgrid(range(6), range(5), range(4), indexing="ij")
    return np.column_stack([x.ravel() for x in steps]).astype(float)


SHAPES = {
    "torus": lambda: sampled("torus", 900),
    "knot": lambda: sampled("knot", 1200),  # too few: umbrellas and the surface are odd in places
    "grid": grid,
}


@pytest.fixture(scope="module", params=SHAPES)
def points(request):
    return SHAPES[request.param]()


@pytest.fixture(params=["INNER", "OUTER"])
def samples(points, request):
    return rivals.Samples(points, None, request.param == "OUTER")


def analysed(study, points, **options):
    return study.MedialAnalysis(points, sides=study.SidesFrom.TIGHT_COCONE, **options)


def polygons(vertices, offsets, corners):
    """The polygons by the places of their corners, in an order of these."""
    places = [vertices[c] for c in np.split(corners, offsets[1:-1])] if len(offsets) > 1 else []
    return sorted(sorted(map(tuple, x)) for x in places)


def segments(vertices, edges):
    return {tuple(sorted(map(tuple, vertices[edge]))) for edge in edges}


def expect_same(found, mesh):
    assert polygons(mesh.vertices, mesh.face_offsets, mesh.face_vertices) == polygons(
        found.vertices, found.offsets, found.corners
    )
    assert segments(mesh.vertices, mesh.edges) >= segments(found.vertices, found.edges)


@pytest.mark.parametrize("radius", [0.0, 0.02, 0.06, 0.2])
def test_lambda(study, samples, radius):
    mesh = study.axis_by_size(
        analysed(study, samples.points),
        study.SizeCondition.LAMBDA,
        2 * radius,
        side=samples.side,
    )
    found = rivals.lambda_axis(samples, radius)
    expect_same(found, mesh)
    if len(samples.points) != len(
        grid()
    ):  # where four edges meet in an edge, the reference has none
        assert len(mesh.edges) == len(found.edges)


@pytest.mark.parametrize("degrees, length", [(0.0, 0.0), (45.0, 0.05), (90.0, 0.0), (20.0, 0.15)])
def test_angle_and_length(study, samples, degrees, length):
    mesh = study.axis_by_size(
        analysed(study, samples.points),
        study.SizeCondition.ANGLE_AND_LENGTH,
        length,
        np.radians(degrees) / 2,
        samples.side,
    )
    expect_same(rivals.angle_length(samples, degrees, length), mesh)


@pytest.mark.parametrize(
    "against, pole, polygon",
    [
        ("UMBRELLA", False, False),
        ("POLE", True, False),
        ("POLYGON", False, True),
        ("POLE_AND_POLYGON", True, True),
    ],
)
@pytest.mark.parametrize("outer", [False, True])
@pytest.mark.parametrize("name", ["torus", "knot"])
def test_variants_of_the_remark(study, name, outer, against, pole, polygon):
    """Not on the grid: where umbrellas are exactly flat, last bits decide what lies in them."""
    samples = rivals.Samples(SHAPES[name](), None, outer)
    mesh = study.axis_by_remark(
        analysed(study, samples.points), getattr(study.Against, against), side=samples.side
    )
    expect_same(rivals.variant(samples, pole, polygon), mesh)


def test_poles(study, points):
    analysis, samples = analysed(study, points), rivals.Samples(points)
    mesh, cells = study.pole_axis(analysis), rivals.pole_cells(samples)
    centres, radii = samples.cells[1][cells], samples.cells[2][cells]
    if len(points) == len(grid()):  # of equally far ones anyone is the pole
        assert np.allclose(np.sort(np.unique(mesh.radius)), np.sort(np.unique(radii)))
        return
    assert set(map(tuple, mesh.vertices)) == set(map(tuple, centres))
    assert len(mesh.face_offsets) == 1 and len(mesh.generators) == 0
    assert np.allclose(cKDTree(points).query(mesh.vertices)[0], mesh.radius)
    inner, outer = (
        study.pole_axis(analysis, side) for side in (study.Side.INNER, study.Side.OUTER)
    )
    assert len(inner.vertices) + len(outer.vertices) == len(mesh.vertices)


# --- what the options promise


def test_every_threshold_is_a_mask(study):
    """Thresholds of |pq| are shares of the diagonal, reached and not exceeded; lengths scale with the points."""
    points = sampled("torus", 400)
    for scale in (1.0, 1e-3, 1e6):
        analysis = study.MedialAnalysis(scale * points, sides=study.SidesFrom.NONE)
        ends = points[analysis.edges]
        share = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
        share /= np.linalg.norm(np.ptp(points, axis=0))
        for length in (0.0, 0.1, 0.3, 0.9, 2.0):
            found = study.select_by_size(analysis, study.SizeCondition.LAMBDA, length)
            assert np.array_equal(found, np.flatnonzero(share >= length))


def test_the_points_of_the_bounding_sphere_do_not_count(study):
    points = sampled("torus", 400)
    found = [
        study.axis_by_size(
            study.MedialAnalysis(points, bounding_sphere=sphere),
            study.SizeCondition.LAMBDA,
            0.15,
            side=study.Side.INNER,
        )
        for sphere in (False, True)
    ]
    assert np.array_equal(found[0].generators, found[1].generators)
    assert len(found[0].generators) > 0


def test_threads_change_nothing(study):
    points = sampled("knot", 600)

    def everything(threads):
        analysis = study.MedialAnalysis(points, threads=threads)
        remark = study.axis_by_remark(analysis, study.Against.POLE_AND_POLYGON)
        mesh = study.axis_by_size(analysis, study.SizeCondition.LAMBDA, 0.15)
        poles = study.pole_axis(analysis)
        return remark.theta, remark.rho, mesh.vertices, mesh.edges, poles.vertices

    first = everything(1)
    assert len(first[3]) > 0
    for threads in (2, 3):
        assert all(map(np.array_equal, first, everything(threads)))


def test_what_is_wrong_is_one_sentence(study):
    analysis = study.MedialAnalysis(sampled("torus", 200), sides=study.SidesFrom.NONE)
    for length in (-0.1, np.nan):
        with pytest.raises(study.InvalidInputError, match="Expected a length of 0 or more"):
            study.axis_by_size(analysis, study.SizeCondition.LAMBDA, length)
    with pytest.raises(study.InvalidInputError, match="sides NONE"):
        study.pole_axis(analysis, study.Side.INNER)


# --- the power shape


def hull_simplices(centres, radii):
    """The regular triangulation as the lower side of a convex hull in four dimensions."""
    lifted = np.column_stack((centres, (centres**2).sum(axis=1) - radii**2))
    hull = ConvexHull(lifted)
    cells = hull.simplices[hull.equations[:, 3] < 0]
    return {tuple(sorted(x)) for cell in cells for k in (1, 2, 3) for x in combinations(cell, k)}


def test_power_shape_is_the_lower_hull(study):
    rng = np.random.default_rng(3)
    centres, radii = rng.random((80, 3)), rng.random(80) * 0.5
    wanted = rng.random(80) < 0.7
    balls, triangles, edges = study.power_shape(centres, radii, wanted)
    expected = {x for x in hull_simplices(centres, radii) if wanted[list(x)].all()}
    joined = {pair for row in triangles.tolist() for pair in combinations(row, 2)}
    assert set(map(tuple, triangles.tolist())) == {x for x in expected if len(x) == 3}
    assert {(ball,) for ball in balls.tolist()} == {x for x in expected if len(x) == 1}
    assert len(balls) < wanted.sum(), "some are hidden"
    assert set(map(tuple, edges.tolist())) == {x for x in expected if len(x) == 2} - joined
    assert len(edges) > 0


@pytest.mark.parametrize("scale", [1e-40, 1e45])
def test_power_shape_in_any_unit(study, scale):
    rng = np.random.default_rng(3)
    centres, radii = rng.random((40, 3)), rng.random(40) * 0.3
    wanted = np.ones(40, bool)
    for one, other in zip(
        study.power_shape(centres, radii, wanted),
        study.power_shape(scale * centres, scale * radii, wanted),
        strict=True,
    ):
        assert np.array_equal(one, other)


def test_of_equal_balls_the_first_has_the_cell(study):
    rng = np.random.default_rng(5)
    centres, radii = np.tile(rng.random((20, 3)), (2, 1)), np.full(40, 0.2)
    balls, triangles, _ = study.power_shape(centres, radii, np.ones(40, bool))
    assert balls.max() < 20 and triangles.max() < 20


@pytest.mark.parametrize(
    "centres, radii, wanted, said",
    [
        (np.zeros((2, 3)), np.zeros(1), np.ones(2, bool), "Expected a radius and a flag"),
        (np.zeros((2, 3)), np.array([1.0, -1.0]), np.ones(2, bool), "radii of 0 or more"),
        (np.full((2, 3), np.nan), np.ones(2), np.ones(2, bool), "finite"),
    ],
)
def test_balls_that_are_none_are_refused(study, centres, radii, wanted, said):
    with pytest.raises(study.InvalidInputError, match=said):
        study.power_shape(centres, radii, wanted)


def test_no_balls_have_no_shape(study):
    none = study.power_shape(np.zeros((0, 3)), np.zeros(0), np.zeros(0, bool))
    assert [len(x) for x in none] == [0, 0, 0]
