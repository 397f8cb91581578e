# SPDX-License-Identifier: GPL-3.0-or-later
"""Where things lie in the checkout, and the one version number."""

from __future__ import annotations

import re
from pathlib import Path

from .terminal import Failure

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "blender_addon"
LIBRARY = ADDON / "lib"  # the compiled modules
BUILD = ROOT / "build"
DIST = ROOT / "dist"
PACKAGE = "medial_axis"  # the add-on's name inside Blender, and the top folder of its zip


def version() -> str:
    """The version that the manifest states; Failure when `bl_info` says another."""
    manifest = (ADDON / "blender_manifest.toml").read_text(encoding="utf-8")
    stated = re.search(r'^version = "(.+)"', manifest, re.MULTILINE)[1]
    init = (ADDON / "__init__.py").read_text(encoding="utf-8")
    info = re.search(r'"version": \((.+?)\)', init)[1]
    if stated.split("-")[0] != ".".join(part.strip() for part in info.split(",")):
        raise Failure(
            f"blender_manifest.toml says version {stated}, bl_info says ({info}); make them equal"
        )
    return stated


def shown(path: Path) -> str:
    """A path as a person at the top of the checkout would type it."""
    return str(path.relative_to(ROOT)) if ROOT in path.parents else str(path)
