# SPDX-License-Identifier: GPL-3.0-or-later
"""Which tests run, by rules; a conftest imports these three hooks of pytest.

- slow: tests that take minutes; left out unless --slow is given.
- oracle: tests that compare results with independent ones over many cases. With --share I/N the case number k of each
  function runs if k % N == I, so N runs with different I see all cases, and each run sees every function.
- long tests, those of long_tests.txt, take turns. With --share I/N they are divided like oracles, or, with fewer than N
  cases, the case number k of all of them runs if k % N == I.
- --claims FOLDER: processes that share the folder share the files of tests. Each takes the next file that none has
  taken, the longest first, and notes it there.
"""

from pathlib import Path

import pytest

from .claims import claim

LONG = frozenset(Path(__file__).with_name("long_tests.txt").read_text(encoding="utf-8").split())


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: minutes long; left out unless --slow is given")
    config.addinivalue_line("markers", "oracle: many cases of one relation; --share I/N takes some")
    config.addinivalue_line("markers", "docs: about the documentation, not about the product")
    # A marker of pytest-xdist: one worker runs them all, so that a shared compilation is done once.
    config.addinivalue_line("markers", "xdist_group(name): tests that run in one worker")


def pytest_addoption(parser):
    parser.addoption("--slow", action="store_true", help="also run the tests marked slow")
    parser.addoption(
        "--share", type=_part, default=(0, 1), help="cases of oracles and of long tests: I/N"
    )
    parser.addoption("--claims", type=Path, help="where processes note the files that they take")


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
    share = config.getoption("--share")
    left_out = {*_of_other_shares(items, *share)}
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]
    if config.getoption("--claims"):
        _longest_first(items)


def pytest_runtest_protocol(item):
    """Passes over a test whose file another process has taken: True tells pytest that it is done."""
    folder = item.config.getoption("--claims")
    return True if folder and not _is_mine(item.path, folder) else None


def _of_other_shares(items, index, count):
    """The cases of oracles and of long tests that another share runs; an oracle with few cases runs whole."""
    functions = {}
    for item in items:
        functions.setdefault(item.nodeid.partition("[")[0], []).append(item)
    turns = []
    for cases in functions.values():
        long = _name(cases[0]) in LONG
        if len(cases) < count:
            turns += cases if long else []
        elif long or "oracle" in cases[0].keywords:
            yield from (case for k, case in enumerate(cases) if k % count != index)
    yield from (case for k, case in enumerate(turns) if k % count != index)


def _name(item):
    return f"{item.path.parent.name}/{item.path.name}::{item.name.partition('[')[0]}"


def _longest_first(items):
    """The tests in files that start other processes take longest, and come first."""

    def order(path):
        return "subprocess" not in path.read_text(encoding="utf-8"), -path.stat().st_size, path

    places = {path: order(path) for path in {item.path for item in items}}
    items.sort(key=lambda item: places[item.path])


def _is_mine(path, folder, known={}):  # noqa: B006 - what this process has taken, or found taken
    if path not in known:
        known[path] = claim(folder, path.name)
    return known[path]
