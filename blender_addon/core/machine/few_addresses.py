# SPDX-License-Identifier: GPL-3.0-or-later
"""This module saves addresses if a process may map only few, as under `ulimit -v`."""

from __future__ import annotations

import ctypes
import mmap
import os
import sys
from pathlib import Path

from ..errors import OutOfMemoryError

_ARENA_MAX = -8  # this is M_ARENA_MAX of glibc
_OF_OPENBLAS = 130 << 20  # bytes of its buffer for a product of matrices, and what surrounds it


def are_few() -> bool:
    """Return whether this process may map a limited number of addresses only."""
    if sys.platform != "linux":
        return False
    import resource  # Windows has none

    return resource.getrlimit(resource.RLIMIT_AS)[0] != resource.RLIM_INFINITY


def share_one_heap() -> None:
    """Let all threads share one heap if addresses are limited; call it before threads start and NumPy is loaded.

    The C library of Linux reserves 128 MB of addresses for the heap of each thread. If it gets none, it maps and unmaps
    pages for every allocated number, and a second of work takes minutes. OpenBLAS, too, reserves as much for each of
    its threads, and while it gets none, NumPy does not finish loading.
    """
    if not are_few():
        return
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)  # other C libraries have none
    if mallopt is not None:
        mallopt(_ARENA_MAX, 1)


def reserve_matrices() -> None:
    """Let OpenBLAS map its buffer if addresses are limited; call it before anything else needs them.

    OpenBLAS maps the buffer at the first product of matrices and keeps it. If there is no room, it tries again forever.
    """
    if not are_few() or "openblas" not in Path("/proc/self/maps").read_text(errors="replace"):
        return
    import numpy as np  # after `share_one_heap`

    try:
        mmap.mmap(-1, _OF_OPENBLAS).close()
    except OSError:
        raise OutOfMemoryError(
            f"Expected {_OF_OPENBLAS >> 20} MB of addresses for NumPy's products of matrices, found fewer; "
            "raise the limit of this process (ulimit -v)"
        ) from None
    np.dot(np.ones((2, 2)), np.ones((2, 2)))
