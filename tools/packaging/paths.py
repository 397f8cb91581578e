# SPDX-License-Identifier: GPL-3.0-or-later
"""The folders of the checkout, and the version of what is built from it."""

from __future__ import annotations

import os
import re
from pathlib import Path

from .terminal import Failure, output_of, succeeds

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "blender_addon"
LIBRARY = ADDON / "lib"  # the compiled modules
BUILD = ROOT / "build"
DIST = ROOT / "dist"
# Other Debians in folders, with their Blenders; tests/matrix makes them.
BLENDERS = Path(os.environ.get("MEDIAL_AXIS_BLENDERS", BUILD / "blenders"))
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


def commit() -> str:
    """The commit that a development build carries in its version, such as g1a2b3c4d, or g1a2b3c4d.modified.

    Empty for the sources of a release, whose tag is v and the version, and where the sources are no git checkout.
    """
    if not (ROOT / ".git").exists() or not succeeds("git", "rev-parse", "HEAD"):
        return ""
    modified = output_of("git", "status", "--porcelain", "--untracked-files=no").strip()
    if not modified and f"v{version()}" in output_of("git", "tag", "--points-at", "HEAD").split():
        return ""
    short = output_of("git", "rev-parse", "--short=8", "HEAD").strip()
    return f"g{short}{'.modified' if modified else ''}"


def full_version() -> str:
    """The version of what is built here: the manifest's, and for a development build its commit."""
    return "+".join(filter(None, (version(), commit())))


def shown(path: Path) -> str:
    """A path as a person at the top of the checkout would type it."""
    return str(path.relative_to(ROOT)) if ROOT in path.parents else str(path)
