# SPDX-License-Identifier: GPL-3.0-or-later
"""The asset library of the add-on's groups of nodes, written by a Blender.

Blender never writes the same file twice: addresses in its memory are in it. So a library is kept in the build folder as
long as its sources do not change, and the same sources make the same zip. A library opens in Blenders not older
than the one that wrote it.
"""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from pathlib import Path

from . import paths
from .blender import Blender, find_blender

_SCRIPT = Path(__file__).with_name("write_node_groups.py")
_SOURCES = (
    "bridge/nodes/*.py",
    "bridge/mesh/attributes.py",
    "bridge/mesh/colours.py",
    "core/axis/colours.py",
)


def library(blender: Path | str = "blender") -> Path | None:
    """The folder with the library; None for an add-on without groups of nodes.

    Raises
    ------
    Failure
        No Blender, or it could not write the library.
    """
    sources = [path for pattern in _SOURCES for path in sorted(paths.ADDON.glob(pattern))]
    if not sources:
        return None
    program = find_blender(str(blender))
    kept = paths.BUILD / "nodes" / _key(program, sources)
    if not kept.is_dir():
        _write(program, kept)
    return kept


def _key(program: Path, sources: list[Path]) -> str:
    """A hash of everything that a library depends on."""
    digest = hashlib.sha256(str(program.resolve()).encode())
    for path in sources:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _write(program: Path, folder: Path) -> None:
    """Write the library into a temporary folder, then move it into place."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent) as private:
        blender = Blender([str(program)], Path(private) / "profile")
        fresh = Path(private) / "library"
        blender.script(_SCRIPT, fresh, options=["--factory-startup"])
        shutil.rmtree(folder, ignore_errors=True)
        fresh.rename(folder)
