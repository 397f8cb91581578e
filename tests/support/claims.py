# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that share a folder share work: each takes what no other has taken."""

from __future__ import annotations

from pathlib import Path


def claim(folder: Path, name: str) -> bool:
    """Whether this process is the first that takes the file of tests, or the scene, of this name."""
    try:
        (folder / name).touch(exist_ok=False)
    except FileExistsError:
        return False
    return True
