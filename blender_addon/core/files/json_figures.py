# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of reports in JSON, which has no infinite numbers."""

from __future__ import annotations

import math


def known(figure: float) -> float | None:
    """Return a figure, or None where it is infinite or not a number."""
    return figure if math.isfinite(figure) else None
