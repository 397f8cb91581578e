# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates at the ends of the documented range: the same axis, scaled or moved; rows that nearly coincide."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle


def ellipsoid(count=700, seed=1):
    rows = np.random.default_rng(seed).normal(size=(count, 3))
    return rows / np.linalg.norm(rows, axis=1)[:, None] * (1.0, 0.8, 0.6)


def axis_of(medial, points):
    analysis = medial.MedialAnalysis(points)
    return analysis, analysis.extract(side=medial.Side.BOTH)


def assert_scaled(medial, points, factor):
    """The same bits, multiplied by a power of two."""
    analysis, mesh = axis_of(medial, points)
    other_analysis, other = axis_of(medial, points * factor)
    assert len(mesh.theta) > 100 or len(points) < 300
    for name in ("face_offsets", "face_vertices", "theta", "rho", "side", "generators"):
        np.testing.assert_array_equal(getattr(other, name), getattr(mesh, name))
    np.testing.assert_array_equal(other.vertices, mesh.vertices * factor)
    np.testing.assert_array_equal(other.radius, mesh.radius * factor)
    assert (other.zero_area, other.unbounded) == (mesh.zero_area, mesh.unbounded)
    np.testing.assert_array_equal(other_analysis.spacing, analysis.spacing * factor)
    # Which of the close vertices it leaves out goes with the unit; it is too large by at most so much.
    np.testing.assert_allclose(
        other_analysis.feature_size(), analysis.feature_size() * factor, rtol=1 / 32
    )


@pytest.mark.parametrize("power", [-164, -160, -155, -143, -133, -100, -65, 64, 100, 160, 165])
def test_powers_of_two_change_nothing_but_the_unit(medial, power):
    assert_scaled(medial, ellipsoid(), 2.0**power)


def test_a_lattice_in_the_last_bits_of_an_offset(medial):
    """Steps of 2^-52 at 1: the differences are exact, so the place makes no difference."""
    lattice = np.stack(np.meshgrid(*[np.arange(8.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
    near = medial.MedialAnalysis(lattice)
    far = medial.MedialAnalysis(1.0 + lattice * 2.0**-52)
    np.testing.assert_array_equal(far.select(), near.select())
    np.testing.assert_array_equal(far.theta, near.theta)
    np.testing.assert_array_equal(far.rho, near.rho)


@pytest.mark.parametrize("offset", [2.0**30, -(2.0**40), 1e9])
def test_an_offset_that_loses_nothing(medial, offset):
    """Rounded there first, so that both are the same points."""
    away = np.array([offset, 0.0, 2 * offset])
    moved = ellipsoid() + away
    one, other = axis_of(medial, moved - away)[1], axis_of(medial, moved)[1]
    np.testing.assert_array_equal(one.generators, other.generators)
    np.testing.assert_allclose(other.radius, one.radius, rtol=1e-12)
    np.testing.assert_allclose(other.vertices - away, one.vertices, atol=1e-15 * abs(offset))


@pytest.mark.parametrize("tiny", [1e-60, 1e-80, 1e-100, 1e-150, 1e-200, 1e-300, 5e-324])
def test_rows_closer_than_can_be_told_are_one(medial, tiny):
    """Differences below 2^-160 of the extent; the rest is as if each of these rows lay at 0."""
    random = np.random.default_rng(3)
    points, close = random.normal(size=(200, 3)), tiny * random.normal(size=(20, 3))
    analysis = medial.MedialAnalysis(np.concatenate([points, close]))
    assert analysis.duplicates == 19 and np.isfinite(analysis.rho).all()
    alone = medial.MedialAnalysis(np.concatenate([points, [[0.0, 0.0, 0.0]]]))
    np.testing.assert_array_equal(analysis.theta, alone.theta)
    np.testing.assert_array_equal(analysis.rho, alone.rho)


@pytest.mark.parametrize("small", [1e-20, 1e-30, 1e-40, 1e-46])
def test_rows_that_can_be_told_are_several(medial, small):
    random = np.random.default_rng(3)
    points = np.concatenate([random.normal(size=(200, 3)), small * random.normal(size=(20, 3))])
    analysis = medial.MedialAnalysis(points)
    assert analysis.duplicates == 0
    assert np.isfinite(analysis.rho).all() and np.isfinite(analysis.extract().vertices).all()


# --- other results that are lengths

FRAMES = [
    *[(2.0**power, (0.0, 0.0, 0.0)) for power in (-160, -80, 80, 150)],
    *[(2.0**power, (2.0**30, 0.0, -(2.0**26))) for power in (0, 80)],
]
frames = pytest.mark.parametrize(("factor", "offset"), FRAMES)


def two_ellipsoids():
    """(n, 3) points and outward normals, on a lattice that an offset of 2^30 does not round; 0.5 apart."""
    sphere = ellipsoid() / (1.0, 0.8, 0.6)
    places = [sphere * (3.0, 0.8, 0.6) + (0.0, y, 0.0) for y in (-1.05, 1.05)]
    points = np.round(np.concatenate(places) * 2**20) / 2**20
    return points, np.tile(sphere / (3.0, 0.8, 0.6), (2, 1))


@frames
@pytest.mark.parametrize("side", ["INNER", "OUTER"])
@pytest.mark.parametrize("mode", ["WALL", "BALL"])
def test_thickness_is_told_in_the_unit_of_the_input(medial, factor, offset, mode, side):
    points, normals = two_ellipsoids()
    found = []
    for place in (points, (points + offset) * factor):
        analysis = medial.MedialAnalysis(place, sides=medial.SidesFrom.TIGHT_COCONE)
        options = {"mode": getattr(medial.ThicknessMode, mode), "side": getattr(medial.Side, side)}
        found.append(analysis.thickness(normals, **options))
    assert np.isfinite(found[0].values).sum() > 200
    np.testing.assert_array_equal(found[1].measured, found[0].measured)
    np.testing.assert_allclose(found[1].values, found[0].values * factor, rtol=1e-12)


def delaunay_edges(points):
    tetrahedra = Delaunay(points).simplices
    pairs = tetrahedra[:, [0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3]].reshape(-1, 2)
    return {tuple(sorted(pair)) for pair in pairs.tolist()}


@pytest.mark.parametrize("seed", repeats(40))
def test_fuzzed_scales_and_offsets(medial, seed):
    random = np.random.default_rng([seed, 17])
    points = np.round(random.normal(size=(int(random.integers(20, 250)), 3)) * 2**20) / 2**20
    power = int(random.integers(-160, 160))
    assert_scaled(medial, points, 2.0**power)
    offset = 2.0 ** random.integers(0, 31, 3) * random.choice([-1, 0, 1], 3)
    moved = (points + offset) * 2.0 ** min(power, 130)  # below the largest coordinate, 1e50
    near, far = medial.MedialAnalysis(points), medial.MedialAnalysis(moved)
    np.testing.assert_array_equal(near.edges, far.edges)
    assert set(map(tuple, near.edges.tolist())) == delaunay_edges(points)
    np.testing.assert_allclose(far.theta, near.theta, atol=1e-6)
