# SPDX-License-Identifier: GPL-3.0-or-later
"""Memory where a process may map few addresses, as under `ulimit -v`."""

from __future__ import annotations

import ctypes
import sys

_ARENA_MAX = -8  # M_ARENA_MAX of glibc


def share_one_heap() -> None:
    """Let all threads take memory from one heap where addresses are limited; before threads begin.

    The C library of Linux reserves 128 MB of addresses for the heap of each thread. Where it gets none it maps and
    unmaps pages for every number that is allocated, and what takes a second takes minutes.
    """
    if sys.platform != "linux":
        return
    import resource  # there is none on Windows

    if resource.getrlimit(resource.RLIMIT_AS)[0] != resource.RLIM_INFINITY:
        mallopt = getattr(ctypes.CDLL(None), "mallopt", None)  # other C libraries have none
        if mallopt is not None:
            mallopt(_ARENA_MAX, 1)
