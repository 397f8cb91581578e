# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the fuzzes run: once in every run of the tests, ten times as long by tests/fuzz.py before a release."""

import os

TIMES = int(os.environ.get("MEDIAL_AXIS_FUZZ_TIMES", "1"))


def repeats(count: int) -> range:
    """The seeds of a fuzz that runs `count` times; longer runs have others behind them."""
    return range(count * TIMES)
