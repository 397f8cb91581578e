# SPDX-License-Identifier: GPL-3.0-or-later
"""This module finds how much memory is available on this machine now without swapping."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

_GROUPS = Path("/sys/fs/cgroup")
# These files of a control group, in versions 2 and 1, hold its limit, its use, and the part of it that can be freed.
_FILES = (
    ("", "memory.max", "memory.current", "inactive_file"),
    ("memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
)


def free_memory() -> int | None:
    """Return the bytes that are available now, or None if the system does not report them.

    On Linux the containers of this process and its own limit count, too. On Windows it is the available physical
    memory, and elsewhere all memory of the machine.
    """
    if sys.platform == "win32":
        return _of_windows()
    try:
        found = [_available(Path("/proc/meminfo").read_text(encoding="ascii"))]
        groups = Path("/proc/self/cgroup").read_text(encoding="utf-8")
        return min([*found, *_left_in_groups(groups, _GROUPS), *_left_of_addresses()])
    except (OSError, ValueError):
        return _installed()


def _available(text: str) -> int:
    """Return the available bytes that the text of /proc/meminfo states."""
    found = re.search(r"^MemAvailable:\s+(\d+) kB$", text, re.MULTILINE)
    if found is None:
        raise ValueError("no MemAvailable")
    return 1024 * int(found[1])


def _left_in_groups(text: str, root: Path) -> Iterator[int]:
    """Yield the bytes that each control group of a process has left; `text` is the text of /proc/self/cgroup."""
    for line in text.splitlines():
        _, controllers, path = line.split(":", 2)
        for controller, *files in _FILES:
            if controller in controllers.split(","):
                top = root / controller
                place = top / path.strip("/")
                # A container may mount its own group at the top, while the path is that of the machine.
                for folder in (place, *place.parents):
                    if folder.is_relative_to(top) and (left := _left(folder, *files)) is not None:
                        yield left


def _left(folder: Path, limit: str, use: str, droppable: str) -> int | None:
    """Return the bytes that a control group has left, or None if it has no limit."""
    try:
        most = int((folder / limit).read_text(encoding="ascii"))
        used = int((folder / use).read_text(encoding="ascii"))
        stat = (folder / "memory.stat").read_text(encoding="ascii")
    except (OSError, ValueError):  # a group without a limit says 'max'
        return None
    cached = re.search(rf"^{droppable} (\d+)$", stat, re.MULTILINE)
    return max(0, most - used + (int(cached[1]) if cached else 0))


def _left_of_addresses() -> Iterator[int]:
    """Yield the bytes that the process may still map, if it has a limit, as by `ulimit -v`."""
    import resource  # Windows has none

    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit != resource.RLIM_INFINITY:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        yield max(0, limit - pages * resource.getpagesize())


def _installed() -> int | None:
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):
        return None


class _MemoryStatus(ctypes.Structure):
    """This is MEMORYSTATUSEX of Windows."""

    _fields_ = (
        ("length", ctypes.c_uint32),
        ("load", ctypes.c_uint32),
        ("physical", ctypes.c_uint64),
        ("available", ctypes.c_uint64),
        ("others", ctypes.c_uint64 * 5),
    )


def _of_windows() -> int | None:
    status = _MemoryStatus(length=ctypes.sizeof(_MemoryStatus))
    done = ctypes.windll.kernel32.GlobalMemoryStatusEx(  # type: ignore[attr-defined]
        ctypes.byref(status)
    )
    return status.available if done else None
