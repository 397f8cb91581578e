# SPDX-License-Identifier: GPL-3.0-or-later
"""A static repository of extensions: a folder for any web server, from which Blender 4.2 and newer installs the add-on
and gets its newer versions. Blender itself writes the index and the page.
"""

from __future__ import annotations

import json
import shlex
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from . import pack, paths
from .blender import Blender
from .terminal import Failure, output_of

_OLDEST = (4, 2)
_ENTER = paths.ROOT / "tests" / "matrix" / "enter.sh"


def make(archives: Iterable[Path], target: Path, program: list[str]) -> list[dict]:
    """Replace the folder `target` by a repository of the zips, one per system; returns the rows of its index.

    It is complete or unchanged. `program` is a Blender of 4.2 or newer; words may stand before it.
    """
    paths.BUILD.mkdir(exist_ok=True)  # a Blender in another Debian sees the checkout alone
    with tempfile.TemporaryDirectory(dir=paths.BUILD) as name:
        fresh = Path(name) / "repository"
        fresh.mkdir()
        for archive in archives:
            shutil.copy(archive, fresh)
        rows = _generate(fresh, Blender(program, Path(name) / "profile"))
        target.parent.mkdir(parents=True, exist_ok=True)
        if target.exists():
            shutil.move(target, Path(name) / "old")
        shutil.move(fresh, target)
    return rows


def _generate(folder: Path, blender: Blender) -> list[dict]:
    """Let Blender write index.json and index.html; Failure when it leaves a zip out."""
    words = ("--command", "extension", "server-generate", f"--repo-dir={folder}", "--html")
    output = output_of(*blender.program, *words, env=blender.environment)
    rows = json.loads((folder / "index.json").read_text(encoding="utf-8"))["data"]
    count = len(list(folder.glob("*.zip")))
    if len(rows) != count or not (folder / "index.html").is_file():
        raise Failure(f"Expected a page and an index of {count} zips, found {len(rows)}: {output}")
    return rows


def built() -> list[Path]:
    """The zips of this version for the extensions platform; Failure when there are none."""
    found = [pack.archive_for(platform) for platform in pack.PLATFORMS]
    if not any(map(Path.is_file, found)):
        raise Failure(
            f"Expected {paths.shown(found[0])} or its like for another system, found none; run "
            "'build_addon.py build' without --local first"
        )
    return list(filter(Path.is_file, found))


def newer_blender(wanted: str) -> list[str]:
    """The words that start the wanted Blender if it is 4.2 or newer, or else one that the matrix of tests made."""
    made = [
        [str(_ENTER), str(folder), "blender"]
        for folder in sorted(paths.BLENDERS.glob("*"))
        if (folder / "usr/bin/blender").exists()
    ]
    with tempfile.TemporaryDirectory() as profile:
        for program in (
            [shlex.split(wanted)] if shutil.which(shlex.split(wanted)[0]) else []
        ) + made:
            if Blender(program, Path(profile)).version() >= _OLDEST:
                return program
    raise Failure(
        f"Expected a Blender of 4.2 or newer, which can write an index, found neither '{wanted}' to be one nor "
        f"another in {paths.shown(paths.BLENDERS)}; pass --blender PATH",
        2,
    )
