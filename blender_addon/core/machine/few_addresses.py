# SPDX-License-Identifier: GPL-3.0-or-later
"""This module saves addresses if a process may map only few, as under `ulimit -v`."""

from __future__ import annotations

import ctypes
import sys

_ARENA_MAX = -8  # this is M_ARENA_MAX of glibc


def share_one_heap() -> None:
    """Let all threads share one heap if addresses are limited; call it before threads start.

    The C library of Linux reserves 128 MB of addresses for the heap of each thread. If it gets none, it maps and unmaps
    pages for every allocated number, and a second of work takes minutes.
    """
    if sys.platform != "linux":
        return
    import resource  # Windows has none

    if resource.getrlimit(resource.RLIMIT_AS)[0] != resource.RLIM_INFINITY:
        mallopt = getattr(ctypes.CDLL(None), "mallopt", None)  # other C libraries have none
        if mallopt is not None:
            mallopt(_ARENA_MAX, 1)
