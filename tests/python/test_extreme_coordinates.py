# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates at the ends of the documented range: the same axis, scaled or moved; rows too close to be told."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from tests.support.fuzz import repeats


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
    np.testing.assert_array_equal(other_analysis.feature_size(), analysis.feature_size() * factor)


@pytest.mark.parametrize("power", [-164, -160, -155, -143, -133, -100, -65, 64, 100, 160, 165])
def test_powers_of_two_change_nothing_but_the_unit(medial, power):
    assert_scaled(medial, ellipsoid(), 2.0**power)


@pytest.mark.parametrize("power", [-160, -100, 100, 160])
def test_hierarchies_too(medial, power):
    levels = []
    for factor in (1.0, 2.0**power):
        hierarchy = medial.MedialAnalysis(ellipsoid() * factor).hierarchy()
        level = hierarchy.extract()
        levels.append(
            (hierarchy.betti, level.vertices / factor, level.radius / factor, level.wires)
        )
    for one, other in zip(*levels, strict=True):
        np.testing.assert_array_equal(one, other)


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
    moved = ellipsoid() + np.array([offset, 0.0, 2 * offset])
    points = moved - (offset, 0.0, 2 * offset)
    one, other = axis_of(medial, points)[1], axis_of(medial, moved)[1]
    np.testing.assert_array_equal(one.generators, other.generators)
    np.testing.assert_allclose(other.radius, one.radius, rtol=1e-12)
    np.testing.assert_allclose(
        other.vertices - (offset, 0.0, 2 * offset), one.vertices, atol=1e-15 * abs(offset)
    )


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
    near, far = medial.MedialAnalysis(points), medial.MedialAnalysis((points + offset) * 2.0**power)
    np.testing.assert_array_equal(near.edges, far.edges)
    assert set(map(tuple, near.edges.tolist())) == delaunay_edges(points)
    np.testing.assert_allclose(far.theta, near.theta, atol=1e-6)
