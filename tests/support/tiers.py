# SPDX-License-Identifier: GPL-3.0-or-later
"""Which tests run, by rules; a conftest imports these three hooks of pytest.

- slow: tests that take minutes; left out unless --slow is given.
- oracle: tests that compare results with independent ones over many cases. With --share I/N the case number k of each
  function runs if k % N == I, so N runs with different I see all cases, and each run sees every function.
- --files I/N: every N-th file from the I-th on, the longest first, so that N Blenders share the work.
"""

from collections import Counter

import pytest


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: minutes long; left out unless --slow is given")
    config.addinivalue_line("markers", "oracle: many cases of one relation; --share I/N takes some")
    config.addinivalue_line("markers", "docs: about the documentation, not about the product")
    # A marker of pytest-xdist: one worker runs them all, so that a shared compilation is done once.
    config.addinivalue_line("markers", "xdist_group(name): tests that run in one worker")


def pytest_addoption(parser):
    parser.addoption("--slow", action="store_true", help="also run the tests marked slow")
    parser.addoption("--share", type=_part, default=(0, 1), help="cases of the oracles: I/N")
    parser.addoption("--files", type=_part, default=(0, 1), help="files of tests: I/N")


def _part(text):
    index, count = map(int, text.split("/"))
    if not 0 <= index < count:
        raise ValueError(f"expected I/N with 0 <= I < N, found {text}")
    return index, count


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--slow"):
        for item in items:
            if "slow" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="minutes long; run with --slow"))
    left_out = {*_other_cases(items, *config.getoption("--share"))}
    left_out |= {*_other_files(items, *config.getoption("--files"))}
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]


def _other_cases(items, index, count):
    """The cases of oracles that another share runs; a function with fewer than N cases runs whole."""
    oracles = [item for item in items if "oracle" in item.keywords]
    function = {item: item.nodeid.partition("[")[0] for item in oracles}
    sizes, seen = Counter(function.values()), Counter()
    for item in oracles:
        name = function[item]
        if sizes[name] >= count and seen[name] % count != index:
            yield item
        seen[name] += 1


def _other_files(items, index, count):
    """The tests in files that another process runs; those that start other Blenders take longest, and come first."""

    def order(path):
        return "subprocess" not in path.read_text(encoding="utf-8"), -path.stat().st_size, path

    files = sorted({item.path for item in items}, key=order)
    mine = set(files[index::count])
    return (item for item in items if item.path not in mine)
