# SPDX-License-Identifier: GPL-3.0-or-later
"""Nearness where squares of distances leave the range of a double: as in another unit, and no warning."""

import warnings

import numpy as np
import pytest
from medial_axis.core.shape.nearness import near, nearest, sample_of_row


@pytest.fixture(autouse=True)
def warnings_are_errors():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def clouds(seed):
    random = np.random.default_rng(seed)
    return random.normal(size=(60, 3)), random.normal(size=(40, 3)), random.uniform(0.05, 0.6)


def distances(points, others):
    return np.linalg.norm(points[:, None] - others[None], axis=2)


@pytest.mark.parametrize("exponent", [-1060, -900, -520, 0, 520, 900, 1020])
def test_a_unit_changes_nothing(exponent):
    for seed in range(5):
        points, others, reach = clouds(seed)
        if exponent < -900:  # few digits are left of them
            points, others, reach = np.round(points * 64), np.round(others * 64), round(reach * 64)
        expected = distances(points, others)
        here, there = np.ldexp(points, exponent), np.ldexp(others, exponent)
        np.testing.assert_array_equal(
            near(here, there, float(np.ldexp(reach, exponent))), (expected <= reach).any(axis=1)
        )
        np.testing.assert_array_equal(nearest(here, there), expected.argmin(axis=1))


@pytest.mark.parametrize("far", [1e9, 1e20, 1e60, 1e100])
def test_what_lies_far_off_hides_nothing(far):
    points, others, reach = clouds(7)
    expected = distances(points, others)
    others = np.concatenate((others, [(far, -far, far), (-far, far, 0.0)]))
    found = near(np.concatenate((points, others[-2:])), others, reach)
    np.testing.assert_array_equal(found, [*(expected <= reach).any(axis=1), True, True])
    np.testing.assert_array_equal(nearest(points, others), expected.argmin(axis=1))


@pytest.mark.parametrize("reach", [5e-324, 1e-200, 1e200, 1.7e308])
def test_a_reach_of_another_size(reach):
    points, others, _ = clouds(9)
    found = near(np.concatenate((points, others)), others, reach)
    assert found[: len(points)].tolist() == [reach > 1.0] * len(points)
    assert found[len(points) :].all()


def test_the_largest_numbers():
    ends = np.array([(1.7e308, -1.7e308, 0.0), (-1.7e308, 1.7e308, 0.0)])
    assert near(ends, ends[:1], 1e300).tolist() == [True, False]
    assert nearest(ends[::-1], ends).tolist() == [1, 0]
    assert nearest(np.zeros((2, 3)), np.zeros((5, 3))).tolist() == [0, 0]


def test_rows_that_the_module_merged_belong_to_the_nearest_sample():
    """Denormal differences: the module merges them and NumPy does not. The row once was read from unset memory."""
    points = np.array([(0, 0, 0), (1e-310, 0, 0), (1, 0, 0), (1, 1e-312, 0), (0, 1, 0)])
    samples = np.array([0, 2, 4], np.int32)
    assert sample_of_row(points, samples).tolist() == [0, 0, 1, 1, 2]
