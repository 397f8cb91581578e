# SPDX-License-Identifier: GPL-3.0-or-later
"""The kind of warning that says that a result is probably wrong."""

from __future__ import annotations


class Severe(str):
    """A warning that the result is probably wrong. A plain `str` only reports an assumption."""

    __slots__ = ()
