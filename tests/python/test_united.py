# SPDX-License-Identifier: GPL-3.0-or-later
"""Items that pairs connect, against a search from each item; and chains, which took a round for each step."""

import numpy as np
import pytest
from medial_axis.core.united import united


def searched(count, pairs):
    beside = [set() for _ in range(count)]
    for a, b in pairs.tolist():
        beside[a].add(b)
        beside[b].add(a)
    smallest = [-1] * count
    for start in range(count):
        left = [start]
        while left:
            if smallest[item := left.pop()] < 0:
                smallest[item] = start
                left += beside[item]
    return smallest


@pytest.mark.parametrize("seed", range(60))
def test_each_item_has_the_smallest_that_it_is_connected_with(seed):
    random = np.random.default_rng(seed)
    count = int(random.integers(1, 60))
    dtype = random.choice([np.int32, np.int64])
    pairs = random.integers(0, count, (int(random.integers(0, 80)), 2)).astype(dtype)
    assert united(count, pairs).tolist() == searched(count, pairs)


def test_a_long_chain_in_any_order_is_one():
    for order in (np.random.default_rng(0).permutation(300_000), np.arange(300_000)):
        assert not united(len(order), np.column_stack((order[:-1], order[1:]))).any()
