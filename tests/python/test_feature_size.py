# SPDX-License-Identifier: GPL-3.0-or-later
"""How densely the samples lie: their spacing, the local feature size, and the quotient that the theorem speaks of."""

import re

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import inputs
from support.shapes import SHAPES

pytestmark = pytest.mark.oracle

# Some vertices are left out that are closer together than that, in radii of their balls.
THINNING = 1 / 32
CLOUD = np.random.default_rng(0).random((60, 3))


def analysis_of(medial, points, **options):
    return medial.MedialAnalysis(points, sides=medial.SidesFrom.NONE, **options)


def vertices_of_selected(study, analysis, points, **thresholds):
    """Voronoi vertices, by the cells, of the selected facets: those that are finite."""
    cells, _, centres = study.delaunay(points)
    selected = set(map(tuple, analysis.edges[analysis.select(**thresholds)].tolist()))
    finite = (cells >= 0).all(axis=1)
    pairs = np.sort(cells[finite][:, [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]], axis=2)
    chosen = [any(tuple(pair) in selected for pair in cell) for cell in pairs.tolist()]
    return centres[finite][chosen]


CASES = {
    "ellipsoid": SHAPES["ellipsoid"].sample(1000, 3),
    "random": np.random.default_rng(3).random((1500, 3)),
    "graded": inputs.generic("graded", 1500, 3),
    "clusters": inputs.generic("clusters", 1500, 3),
    "grid": inputs.hollow((8, 6, 5)),
    "turned grid": inputs.hollow((8, 6, 5)) @ inputs.rotation(1).T,
    "box": SHAPES["box"].random_sample(1500, 3),
}


@pytest.mark.parametrize("theta, rho", [(np.pi / 8, 8.0), (0.8, 100.0), (0.0, 0.0)])
@pytest.mark.parametrize("name", CASES)
def test_distance_to_the_selected_vertices(study, name, theta, rho):
    """Brute force gives a lower bound, exceeded by the thinning at most; finite vertices of unbounded facets count."""
    points = CASES[name]
    analysis = analysis_of(study, points)
    vertices = vertices_of_selected(study, analysis, points, theta=theta, rho=rho)
    wanted = cKDTree(vertices).query(points[analysis.samples])[0]
    found = analysis.feature_size(theta, rho)
    assert (found >= wanted * (1 - 1e-9)).all()
    assert (found <= wanted * (1 + THINNING + 1e-9)).all()


def test_vertices_of_unbounded_facets_count(study):
    """With few points nearly all facets are unbounded."""
    points = inputs.generic("cube", 8, 1)
    analysis = analysis_of(study, points)
    selected = analysis.select(0.0, 0.0)
    assert (~analysis.bounded[selected]).any()
    only = analysis.extract(0.0, 0.0).vertices
    every = vertices_of_selected(study, analysis, points, theta=0.0, rho=0.0)
    assert len(every) > len(only)
    wanted = cKDTree(every).query(points[analysis.samples])[0]
    assert (cKDTree(only).query(points[analysis.samples])[0] > 1.1 * wanted).any()
    assert (analysis.feature_size(0.0, 0.0) <= wanted * (1 + THINNING + 1e-9)).all()


# Largest relative error at 2,000 and 8,000 samples; measured, and a quarter more. The walls of the shell are
# nearly as thin as the samples of 2,000 are apart.
ERRORS = {
    "ellipsoid": (0.18, 0.13), "oblate": (0.13, 0.077), "slab": (0.15, 0.037),
    "torus": (0.061, 0.042), "capsule": (0.034, 0.042), "shell": (0.61, 0.2),
}  # fmt: skip


def exact_feature_size(name, points):
    """Distance to the axis of either side; the outer one of a convex shape is empty."""
    shape = SHAPES[name]
    inner = shape.axis_distance(points)
    if name == "torus":
        return np.minimum(inner, shape.outer_axis_distance(points))
    if name == "shell":  # in its cavity is the axis of the middle surface
        cavity = np.where(shape.middle.inside(points), shape.middle.axis_distance(points), np.inf)
        return np.minimum(inner, cavity)
    return inner


@pytest.mark.parametrize("density", range(2))
@pytest.mark.parametrize("name", ERRORS)
def test_feature_size_of_exact_shapes(medial, name, density):
    points = SHAPES[name].sample((2000, 8000)[density], 1)
    analysis = analysis_of(medial, points)
    wanted = exact_feature_size(name, points)[analysis.samples]
    error = np.abs(analysis.feature_size() / wanted - 1)
    assert error.max() < ERRORS[name][density]


def test_bounding_sphere_has_no_feature_size(medial):
    points = SHAPES["ellipsoid"].sample(2000, 2)
    plain, bounded = (analysis_of(medial, points, bounding_sphere=b) for b in (False, True))
    assert len(bounded.feature_size()) == len(bounded.spacing) == len(points)
    assert np.allclose(bounded.feature_size(), plain.feature_size(), rtol=THINNING, atol=0)
    assert np.median(bounded.spacing / plain.spacing) == 1.0


@pytest.mark.parametrize("name", ["ellipsoid", "random", "turned grid", "box"])
def test_spacing_is_the_largest_circumradius_of_the_umbrella(study, name):
    points = CASES[name]
    analysis = analysis_of(study, points)
    offsets, triangles = study.umbrellas(points)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    sides = [np.linalg.norm(u - v, axis=1) for u, v in ((a, b), (b, c), (c, a))]
    radius = np.prod(sides, axis=0) / (2 * np.linalg.norm(np.cross(b - a, c - a), axis=1))
    wanted = np.maximum.reduceat(radius, offsets[:-1])
    assert (np.diff(offsets) > 0).all()
    assert np.allclose(analysis.spacing, wanted, rtol=1e-6, atol=0)


@pytest.mark.parametrize(
    "thresholds", [{"theta": -1.0}, {"theta": 2.0}, {"rho": -1.0}, {"rho": np.nan}]
)
def test_thresholds_out_of_range(medial, thresholds):
    with pytest.raises(medial.InvalidInputError, match=f"^Expected {next(iter(thresholds))}"):
        analysis_of(medial, CLOUD).feature_size(**thresholds)


@pytest.mark.parametrize(
    "rows",
    [
        np.array([0, 60], np.int32), np.array([-1], np.int32), np.array([0, 1]), np.array([0.5]),
        np.zeros((1, 2), np.int32), np.arange(8, dtype=np.int32)[::2], [0, 1],
    ],
    ids=["beyond", "negative", "int64", "float", "two axes", "strided", "list"],
)  # fmt: skip
def test_rows_that_are_not_valid(medial, rows):
    with pytest.raises(medial.InvalidInputError) as error:
        analysis_of(medial, CLOUD).feature_size(rows=rows)
    assert re.match(r"^Expected rows .+found.+;", str(error.value))
