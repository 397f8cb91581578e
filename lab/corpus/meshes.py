# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of a folder: files in formats that the command line reads, each content once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from .packages import digest

SUFFIXES = (".obj", ".off", ".ply", ".stl")


@dataclass(frozen=True)
class Mesh:
    """A file of the corpus; `name` is its path in the folder and stays the same on every machine."""

    source: str
    name: str
    path: Path
    sha256: str


def meshes(source: str, folder: Path, words: Iterable[str] = ()) -> list[Mesh]:
    """The meshes of a folder by name, without those that repeat another one; with one of the words in the name."""
    found: dict[str, Mesh] = {}
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() in SUFFIXES and path.is_file() and not path.is_symlink():
            name = path.relative_to(folder).as_posix().removeprefix("usr/share/")
            mesh = Mesh(source, name, path, digest(path))
            found.setdefault(mesh.sha256, mesh)
    wanted = [word.lower() for word in words]
    names = [mesh for mesh in found.values() if _is_wanted(mesh.name.lower(), wanted)]
    return sorted(names, key=lambda mesh: mesh.name)


def _is_wanted(name: str, words: list[str]) -> bool:
    return not words or any(word in name for word in words)
