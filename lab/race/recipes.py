# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs of the race, as `recipes.toml` lists them."""

from __future__ import annotations

import importlib.util
import shutil
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from . import ROOT

FILE = Path(__file__).parent / "recipes.toml"
GROUPS = ("ours", "rival", "peer")
GIVEN = ("points", "normals", "mesh")


@dataclass(frozen=True)
class Recipe:
    """One program; the fields are those of `recipes.toml`. `largest`: the most samples that it is given."""

    name: str
    group: str
    gets: str
    command: tuple[str, ...]
    output: str
    outer: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    largest: int = 10**9

    def __post_init__(self) -> None:
        if self.group not in GROUPS or self.gets not in GIVEN:
            raise ValueError(
                f"Expected a group of {GROUPS} and what it gets of {GIVEN} for '{self.name}', "
                f"found '{self.group}' and '{self.gets}'; correct the recipe"
            )

    def missing(self) -> list[str]:
        """The needs of the recipe that this machine does not meet."""
        return [need for need in self.needs if not _there(need.format(root=ROOT))]

    def words(self, files: dict[str, Path], outer: bool = False) -> list[str]:
        known = {"python": sys.executable, "root": ROOT, **files}
        return [word.format(**known) for word in (*self.command, *(self.outer if outer else ()))]


def _there(need: str) -> bool:
    if need.startswith("python:"):
        return importlib.util.find_spec(need.removeprefix("python:")) is not None
    return shutil.which(need) is not None


def read(path: Path = FILE) -> list[Recipe]:
    rows = tomllib.loads(path.read_text(encoding="utf-8"))["program"]
    tuples = ("command", "outer", "needs")
    return [Recipe(**{k: tuple(v) if k in tuples else v for k, v in row.items()}) for row in rows]
