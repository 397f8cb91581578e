# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges at which sheets end, as chains: their order, their stretches, and ways back in them."""

import numpy as np
import pytest
from medial_axis.core.mid_surface.sheet_chains import (
    chains_of,
    nearest_along,
    runs_of,
    without_ways_back,
)


def test_chains_follow_their_sheet():
    """A ring of sheet 0, whose edges come in any order, and two edges of sheet 1 that begin at a vertex of it."""
    ends = np.array([(2, 0), (0, 1), (1, 5), (1, 2), (5, 6)])
    chains = chains_of(ends, np.array([0, 0, 1, 0, 1], np.int32))
    found = [(each.rows.tolist(), each.closed) for each in chains]
    assert found == [([2, 4], False), ([0, 1, 3], True)]


def test_chains_end_where_rims_cross():
    """Two rings of one sheet share vertex 0, so no edge there has one that follows it."""
    ends = np.array([(0, 1), (1, 2), (2, 0), (0, 3), (3, 4), (4, 0)])
    chains = chains_of(ends, np.zeros(6, np.int32))
    assert sorted(each.rows.tolist() for each in chains) == [[0, 1, 2], [3, 4, 5]]
    assert not any(each.closed for each in chains)


def test_runs_of_a_ring_go_over_its_beginning():
    apart = np.array([False, True, False, False, True, False])
    assert [run.tolist() for run in runs_of(apart)] == [[1, 2, 3], [4, 5, 0]]
    assert [run.tolist() for run in runs_of(np.zeros(3, bool))] == [[0, 1, 2]]


@pytest.mark.parametrize(
    "some, closed, nearest",
    [
        ([1, 4], False, [1, 1, 1, 4, 4, 4]),
        ([1, 4], True, [1, 1, 1, 4, 4, 4]),
        ([3, 5], False, [3, 3, 3, 3, 3, 5]),
        ([3, 5], True, [5, 5, 3, 3, 3, 5]),
    ],
)
def test_the_nearest_along_a_chain_may_be_beyond_its_beginning(some, closed, nearest):
    assert nearest_along(np.ones(6), np.array(some), closed).tolist() == nearest


def test_a_straight_stretch_never_goes_back():
    along = np.array([0.0, 2.0, 1.0, 4.0, 3.5, 3.0])
    places = np.column_stack((along, 2 * along, np.zeros(6)))
    found = without_ways_back(places, np.tile((1.0, 2.0, 0.0), (5, 1)))
    np.testing.assert_array_equal(found[:, 0], [0.0, 2.0, 2.0, 3.0, 3.0, 3.0])
    np.testing.assert_array_equal(found[:, 1], 2 * found[:, 0])


def test_a_bent_stretch_never_goes_back():
    """Round a quarter of a circle, with one place before the one before it; the others stay."""
    turn = np.radians((0, 20, 45, 40, 70, 90))
    places = np.column_stack((np.cos(turn), np.sin(turn), np.zeros(6)))
    between = 0.5 * (turn[1:] + turn[:-1])
    ways = np.column_stack((-np.sin(between), np.cos(between), np.zeros(5)))
    found = without_ways_back(places, ways)
    np.testing.assert_array_equal(found, places[[0, 1, 2, 2, 4, 5]])


def test_edges_without_a_wall_have_no_way():
    places = np.array([(0.0, 0, 0), (2, 0, 0), (1, 0, 0), (3, 0, 0)])
    assert np.array_equal(without_ways_back(places, np.zeros((3, 3))), places)
