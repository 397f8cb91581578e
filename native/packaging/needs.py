# SPDX-License-Identifier: GPL-3.0-or-later
"""The Debian packages that each command needs; they are installed where that is allowed, or else named."""

from __future__ import annotations

import os
import shutil
import subprocess

from .terminal import Failure, run, say, succeeds

# What is needed -> the Debian package that brings it.
BUILD = {
    "C++ compiler": "g++",
    "CMake": "cmake",
    "Ninja": "ninja-build",
    "CGAL headers": "libcgal-dev",
    "Boost headers": "libboost-dev",
    "pybind11 headers": "pybind11-dev",
    "Python headers": "python3-dev",
    "NumPy for Blender's Python": "python3-numpy",
    "Blender": "blender",
    "GoogleTest": "libgtest-dev",
    "mkdocs, for the manual": "mkdocs",
}
WINDOWS = {"compiler for Windows": "g++-mingw-w64-x86-64-posix"}
DEMO = {
    **BUILD,
    "CGAL's demo meshes": "libcgal-demo",
    "software OpenGL": "libgl1-mesa-dri",
    "EGL, to draw without a display": "libegl1",
}
FAST = {
    **BUILD,
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
    "second C++ compiler": "clang",
    "its standard library": "libc++-dev",
    "and what that needs": "libc++abi-dev",
}
MATRIX = {**TEST, "Debian in a folder, by root alone": "debootstrap"}
BENCH = {
    **BUILD,
    "SciPy, whose Qhull is measured, too": "python3-scipy",
    "virtual display": "xvfb",
    "software OpenGL": "libgl1-mesa-dri",
}
RACE = {**BUILD, "SciPy, for the judge": "python3-scipy"}


def require(needs: dict[str, str]) -> None:
    """Install the missing packages, or say how and stop with exit code 2."""
    if shutil.which("dpkg-query") is None:
        print(
            "This is no Debian system: nothing is installed; needed are " + ", ".join(needs) + "."
        )
        return
    missing = {name: package for name, package in needs.items() if not is_installed(package)}
    if not missing:
        return
    say("Missing: " + ", ".join(f"{name} ({package})" for name, package in missing.items()))
    install = ["apt-get", "install", "-y", "--no-install-recommends", *missing.values()]
    advice = "run  sudo apt-get update && sudo " + " ".join(install) + "  and start again"
    rights = administrator_prefix()
    if rights is None:
        raise Failure(
            "Debian packages are missing and this user may not install them: " + advice, 2
        )
    try:
        run(*rights, "apt-get", "update", "-q")
        run(*rights, "env", "DEBIAN_FRONTEND=noninteractive", *install)
    except Failure as failure:
        raise Failure(f"Installing Debian packages failed ({failure}): {advice}", 2) from None


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
