# SPDX-License-Identifier: GPL-3.0-or-later
"""zig in build/zig: Clang with C++ library, linker and names of other systems, from Python's package index.

Beside it are newer headers of CGAL and Boost, because its Clang refuses those of Debian 12, and for each target a
folder with the commands c++, ar and ranlib, which native/zig.cmake names. What cannot be had is a Failure.
"""

from __future__ import annotations

import shlex
import shutil
import tempfile
from pathlib import Path

from . import paths
from .debian import download, extract, labels
from .terminal import python_that, run

VERSION = "0.17.1"
PACKAGES = ["libcgal-dev", "libboost1.88-dev"]
SUITE = "trixie"
STAMP = "packages.txt"  # written last: what was unpacked, by version
# By preset. zig compiles its C++ library anew for each spelling, so each target has one.
TARGETS = {
    "zig-macos-arm64": "aarch64-macos.11.0",
    "zig-macos-x64": "x86_64-macos.11.0",
    "zig-linux-arm64": "aarch64-linux-gnu.2.28",
}


def folder() -> Path:
    return paths.BUILD / "zig"


def program() -> Path:
    return folder() / "ziglang" / "zig"


def bring() -> list[str]:
    """Fill build/zig, unless it is full; returns what it came from, such as 'ziglang 0.17.1'."""
    if origin() is None:
        fresh = folder().with_name("zig.new")
        shutil.rmtree(fresh, ignore_errors=True)
        fresh.mkdir(parents=True)
        names = [*_bring_headers(fresh / "include"), _bring_compiler(fresh)]
        (fresh / STAMP).write_text("\n".join(names) + "\n", encoding="utf-8")
        shutil.rmtree(folder(), ignore_errors=True)
        fresh.rename(folder())
    for target in TARGETS.values():
        write_commands(target)
    return origin()


def origin() -> list[str] | None:
    """The packages in build/zig, with their versions; None when it is not full, or another version of zig is wanted."""
    stamp = folder() / STAMP
    names = stamp.read_text(encoding="utf-8").splitlines() if stamp.is_file() else []
    return names if f"ziglang {VERSION}" in names else None


def _bring_compiler(target: Path) -> str:
    python = python_that("import pip", "install python3-pip")
    words = ["-m", "pip", "install", "--quiet", "--no-deps", "--no-compile"]
    words += ["--only-binary=:all:", "--disable-pip-version-check", f"--target={target}"]
    run(python, *words, f"ziglang=={VERSION}")
    return f"ziglang {VERSION}"


def _bring_headers(target: Path) -> list[str]:
    with tempfile.TemporaryDirectory() as private:
        packages = download(Path(private, "packages"), SUITE, PACKAGES)
        extract(packages, Path(private, "all"))
        for name in ("CGAL", "boost"):
            shutil.copytree(Path(private, "all/usr/include", name), target / name)
        return labels(packages)


def write_commands(target: str) -> None:
    """The commands of a target. zig keeps what it compiled next to itself, not in the home of who builds, and adds no
    checks of undefined behaviour, for which it would compile one more library.
    """
    commands = folder() / target
    commands.mkdir(parents=True, exist_ok=True)
    cache = shlex.quote(str(folder() / "cache"))
    zig = shlex.quote(str(program()))
    for name in ("c++", "ar", "ranlib"):
        option = f" -target {target} -fno-sanitize=undefined" if name == "c++" else ""
        lines = [f"export ZIG_GLOBAL_CACHE_DIR={cache} ZIG_LOCAL_CACHE_DIR={cache}"]
        lines += [f'exec {zig} {name}{option} "$@"']
        text = "\n".join(["#!/bin/sh", *lines, ""])
        command = commands / name
        if not command.is_file() or command.read_text(encoding="utf-8") != text:
            command.write_text(text, encoding="utf-8")
            command.chmod(0o755)
