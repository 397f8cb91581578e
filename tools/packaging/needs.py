# SPDX-License-Identifier: GPL-3.0-or-later
"""The Debian packages that each command needs; they are installed where that is allowed, or else named."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import IO

from . import paths
from .terminal import Failure, run, say, succeeds

# Each table maps a need to the Debian package that provides it.
HEADERS = {
    "CGAL headers": "libcgal-dev",
    "Boost headers": "libboost-dev",
    "pybind11 headers": "pybind11-dev",
}
CORE = {
    "C++ compiler": "g++",
    "CMake": "cmake",
    "Ninja": "ninja-build",
    **HEADERS,
    "Python headers": "python3-dev",
}
PACK = {
    **HEADERS,  # their packages bring the licences
    "Markdown, for the pages in the zip": "python3-markdown",
    "NumPy for Blender's Python": "python3-numpy",
    "Blender": "blender",
}
BUILD = {**CORE, **PACK}
WINDOWS = {"compiler for Windows": "g++-mingw-w64-x86-64-posix"}
LINUX_ARM64 = {"pip, which brings zig": "python3-pip", "strip for all systems": "llvm"}
MACOS = {**LINUX_ARM64, "Maven, which brings Python's headers": "maven"}
OF_SYSTEM = {
    "windows": WINDOWS,
    "macos": MACOS,
    "linux_arm64": LINUX_ARM64,
}
DEMO = {
    **BUILD,
    "software OpenGL": "libgl1-mesa-dri",
    "EGL, to draw without a display": "libegl1",
}
FAST = {
    **BUILD,
    "GoogleTest": "libgtest-dev",
    "SciPy, the independent triangulation": "python3-scipy",
    "pytest": "python3-pytest",
    "pytest on all cores": "python3-pytest-xdist",
    "YAML, to check workflows": "python3-yaml",
    "layout of the C++ sources": "clang-format",
}
TEST = {
    **DEMO,
    **FAST,
    "virtual display": "xvfb",
    "X authority for xvfb-run": "xauth",
    "mouse and keyboard for the GUI tests": "xdotool",
    "screenshots": "imagemagick",
    "C++ linter": "clang-tidy",
    "types of the Python sources": "mypy",
    "spelling of the docs": "hunspell",
    "its British dictionary": "hunspell-en-gb",
}
FULL = {
    **TEST,
    "second C++ compiler": "clang",
    "its standard library": "libc++-dev",
    "and what that needs": "libc++abi-dev",
}
ROOT_ALONE = {"Debian in a folder, by root alone": "debootstrap"}
BENCH = {
    **BUILD,
    "SciPy, whose Qhull is measured, too": "python3-scipy",
    "virtual display": "xvfb",
    "software OpenGL": "libgl1-mesa-dri",
}
RACE = {**BUILD, "SciPy, for the judge": "python3-scipy"}


def of_systems(systems: Iterable[str]) -> dict[str, str]:
    """The packages for building modules for other systems, by need."""
    return {name: package for system in systems for name, package in OF_SYSTEM[system].items()}


def require(needs: dict[str, str]) -> None:
    """Install the missing packages, or report how and stop with exit code 2."""
    if missing := missing_of(needs):
        say("Missing: " + ", ".join(f"{name} ({package})" for name, package in missing.items()))
        install(missing, rights_to_install(missing), None)


def require_rights(needs: dict[str, str]) -> None:
    """Stop with exit code 2 before anything is done, if packages are missing and this user may not install them."""
    if missing := missing_of(needs):
        rights_to_install(missing)


@contextlib.contextmanager
def required_meanwhile(needs: dict[str, str]) -> Iterator[None]:
    """Install the missing packages while the body of the `with` statement runs; they are there at its end.

    The output of apt-get goes to a file, because the body prints as well; a failure shows its end.
    """
    missing = missing_of(needs)
    rights = rights_to_install(missing) if missing else []
    if missing:
        say(f"Installing in the background: {', '.join(missing.values())}")
    with ThreadPoolExecutor(1) as background:
        installed = background.submit(_install_quietly, missing, rights) if missing else None
        yield
        if installed is not None:
            print("Waiting for the packages ...", flush=True)
            installed.result()


def missing_of(needs: dict[str, str]) -> dict[str, str]:
    """The needs whose packages are not installed; none on a system without Debian's packages."""
    if shutil.which("dpkg-query") is None:
        print(
            "This is no Debian system: nothing is installed; needed are " + ", ".join(needs) + "."
        )
        return {}
    return {name: package for name, package in needs.items() if not is_installed(package)}


def rights_to_install(missing: dict[str, str]) -> list[str]:
    """The words before apt-get; Failure with the command to run when this user may not install packages."""
    rights = administrator_prefix()
    if rights is None:
        raise Failure(
            "Debian packages are missing and this user may not install them: " + advice(missing), 2
        )
    return rights


def install(missing: dict[str, str], rights: list[str], log: IO[str] | None) -> None:
    """Run apt-get, with its output to the terminal or to `log`."""
    options = {"stdout": log, "stderr": log} if log else {}
    try:
        run(*rights, "apt-get", "update", "-q", **options)
        run(*rights, "env", "DEBIAN_FRONTEND=noninteractive", *command(missing), **options)
    except Failure as failure:
        text = f"Installing Debian packages failed ({failure}): {advice(missing)}"
        raise Failure(text, 2) from None


def _install_quietly(missing: dict[str, str], rights: list[str]) -> None:
    paths.BUILD.mkdir(exist_ok=True)
    with open(paths.BUILD / "packages.log", "w+", encoding="utf-8") as log:
        try:
            install(missing, rights, log)
        except Failure:
            log.seek(0)
            print("".join(log.readlines()[-30:]), flush=True)
            raise


def command(missing: dict[str, str]) -> list[str]:
    return ["apt-get", "install", "-y", "--no-install-recommends", *missing.values()]


def advice(missing: dict[str, str]) -> str:
    return "run  sudo apt-get update && sudo " + " ".join(command(missing)) + "  and start again"


def is_installed(package: str) -> bool:
    query = ["dpkg-query", "-W", "-f", "${db:Status-Status}", package]
    return subprocess.run(query, capture_output=True, text=True).stdout.startswith("installed")


def administrator_prefix() -> list[str] | None:
    """The words before a command that only root may run; None when this user may not."""
    if os.geteuid() == 0:
        return []
    if shutil.which("sudo") and succeeds("sudo", "-n", "true"):
        return ["sudo", "-n"]
    return None
