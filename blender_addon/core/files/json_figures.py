# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of reports in JSON, which has no infinite numbers."""

from __future__ import annotations

import math


def known(figure: float | None) -> float | None:
    """Return a figure, or None where there is none, or it is infinite or not a number."""
    return figure if figure is not None and math.isfinite(figure) else None
