# SPDX-License-Identifier: GPL-3.0-or-later
"""Git holds our own files alone: every source file names its licence in its first line, or in the second after #! ."""

import shutil
import subprocess

import pytest
from support.package import ROOT

LINE = "SPDX-License-Identifier: GPL-3.0-or-later"
SUFFIXES = {
    ".py", ".pyi", ".sh", ".cmake", ".yaml", ".yml", ".toml", ".map", ".cpp", ".h", ".js", ".css",
}  # fmt: skip
NAMES = {"CMakeLists.txt", ".clang-format", ".clang-tidy", "run"}
#: Files of these kinds hold no comment. Archives, wheels and compiled files are not among them.
OTHERS = {".md", ".png", ".svg", ".txt", ".csv", ".json", ".typed", ".po"}
OTHER_NAMES = {".gitignore", "LICENSE"}


def tracked():
    """All the files that git knows, as paths."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("this is no git checkout")
    listed = subprocess.check_output(["git", "ls-files"], cwd=ROOT, text=True).splitlines()
    return [ROOT / name for name in listed if (ROOT / name).is_file()]


def test_nothing_built_or_fetched_is_in_the_tree():
    """Wheels that a download had left at the top level were once committed with everything else."""
    names = NAMES | OTHER_NAMES
    others = [p for p in tracked() if p.suffix not in SUFFIXES | OTHERS and p.name not in names]
    assert not others, f"take these out of git: {', '.join(str(p) for p in others)}"


def test_every_source_names_its_licence():
    found = [path for path in tracked() if path.suffix in SUFFIXES or path.name in NAMES]
    assert len(found) > 200
    without = []
    for path in found:
        lines = path.read_text(encoding="utf-8").splitlines()[:2]
        first = lines[1:] if lines and lines[0].startswith("#!") else lines[:1]
        if not first or LINE not in first[0]:
            without.append(str(path.relative_to(ROOT)))
    assert not without, f"put the line '{LINE}' first into: {', '.join(without)}"
