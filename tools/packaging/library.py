# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts compiled modules into blender_addon/lib. Each is renamed at the end: a running Blender keeps its open file."""

from __future__ import annotations

import os
from pathlib import Path

from . import paths
from .terminal import Failure, run


def put(built: Path, strip: str = "strip") -> Path:
    """Strip a module into blender_addon/lib; returns its place there."""
    fresh = _place_for(_existing(built))
    run(strip, "--strip-unneeded", "-o", fresh, built)
    return _renamed(fresh, built.name)


def write(name: str, content: bytes) -> Path:
    """Write a module into blender_addon/lib as it is; returns its place there."""
    fresh = _place_for(Path(name))
    fresh.write_bytes(content)
    return _renamed(fresh, name)


def _existing(built: Path) -> Path:
    if not built.exists():
        raise Failure(f"Expected {paths.shown(built)}, found none; run clean first")
    return built


def _place_for(module: Path) -> Path:
    paths.LIBRARY.mkdir(exist_ok=True)
    return paths.LIBRARY / Path(module.name).with_suffix(".new")


def _renamed(fresh: Path, name: str) -> Path:
    os.replace(fresh, fresh.with_name(name))
    return fresh.with_name(name)
