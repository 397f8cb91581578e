# SPDX-License-Identifier: GPL-3.0-or-later
"""Every source file names its licence in its first line, or in the second after #! ."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LINE = "SPDX-License-Identifier: GPL-3.0-or-later"
SUFFIXES = {
    ".py",
    ".pyi",
    ".sh",
    ".cmake",
    ".yaml",
    ".yml",
    ".toml",
    ".map",
    ".cpp",
    ".h",
    ".js",
    ".css",
}
NAMES = {"CMakeLists.txt", ".clang-format", ".clang-tidy", "run"}


def sources():
    """All that git knows and that can hold a comment."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("this is no git checkout")
    listed = subprocess.check_output(["git", "ls-files"], cwd=ROOT, text=True).splitlines()
    paths = [ROOT / name for name in listed]
    return [p for p in paths if p.is_file() and (p.suffix in SUFFIXES or p.name in NAMES)]


def test_every_source_names_its_licence():
    found = sources()
    assert len(found) > 200
    without = []
    for path in found:
        lines = path.read_text(encoding="utf-8").splitlines()[:2]
        first = lines[1:] if lines and lines[0].startswith("#!") else lines[:1]
        if not first or LINE not in first[0]:
            without.append(str(path.relative_to(ROOT)))
    assert not without, f"put the line '{LINE}' first into: {', '.join(without)}"
