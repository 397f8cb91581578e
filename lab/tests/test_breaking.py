# SPDX-License-Identifier: GPL-3.0-or-later
"""The calls that the breaking spoils are calls of the module that is shipped, and answer when nothing is spoilt."""

import pytest


@pytest.fixture(scope="module")
def calls(medial):
    from lab.breaking import inside

    return inside._calls()


def test_every_call_answers(calls):
    for name, (function, words) in calls.items():
        assert function(**words) is not None, name
