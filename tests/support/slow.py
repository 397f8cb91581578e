# SPDX-License-Identifier: GPL-3.0-or-later
"""The option --slow, for the tests that take minutes; a conftest imports these three hooks of pytest."""

import pytest


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: minutes long; left out unless --slow is given")
    # Of pytest-xdist: what compiles everything first does it once, not in each worker.
    config.addinivalue_line("markers", "xdist_group(name): of tests that run in one worker")


def pytest_addoption(parser):
    parser.addoption("--slow", action="store_true", help="also run the tests marked slow")


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--slow"):
        for item in items:
            if "slow" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="minutes long; run with --slow"))
