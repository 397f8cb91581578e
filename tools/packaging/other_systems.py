# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles modules on Debian for systems that this machine does not run."""

from __future__ import annotations

import functools
import tempfile
from pathlib import Path

from . import headers, library, macho, paths, zig
from .headers_for_macs import fetch_for_macs
from .headers_for_windows import fetch_for_windows
from .terminal import Failure, build_preset, run

# The Pythons of the Blenders on these systems, and the suite of Debian that the headers come from.
WINDOWS_PYTHONS = {"3.11": "bookworm", "3.13": "trixie"}
MAC_PYTHONS = {"3.11": "trixie", "3.13": "trixie"}
# Debian's Blenders; blender.org has none for Linux on arm64.
LINUX_ARM_PYTHONS = {"3.11": "bookworm", "3.13": "trixie", "3.14": "sid"}
# No Blender since 5.0 is made for Macs with Intel's processors.
INTEL_MAC_PYTHONS = ("3.11",)


def build_for_windows() -> list[Path]:
    folders = headers.folders_of(
        WINDOWS_PYTHONS, paths.BUILD / "python" / "windows", fetch_for_windows
    )
    build_preset("mingw", headers.definition_of(folders))
    names = [f"_medial.cp{headers.digits(version)}-win_amd64.pyd" for version in folders]
    strip = "x86_64-w64-mingw32-strip"
    return [library.put(paths.BUILD / "mingw" / name, strip) for name in names]


def build_for_macs() -> list[Path]:
    """For Apple's processors and Intel's; both have the same name, so one file holds both."""
    zig.bring()
    folders = headers.folders_of(MAC_PYTHONS, paths.BUILD / "python" / "macos", fetch_for_macs)
    intel = {version: folders[version] for version in INTEL_MAC_PYTHONS if version in folders}
    built: dict[str, list[bytes]] = {}
    for preset, pythons in (("zig-macos-arm64", folders), ("zig-macos-x64", intel)):
        if pythons:
            build_preset(preset, headers.definition_of(pythons))
        for version in pythons:
            name = f"_medial.cpython-{headers.digits(version)}-darwin.so"
            built.setdefault(name, []).append(stripped(paths.BUILD / preset / name))
    return [
        library.write(name, images[0] if len(images) == 1 else macho.join(images))
        for name, images in built.items()
    ]


def build_for_linux_arm() -> list[Path]:
    zig.bring()
    bring = functools.partial(headers.fetch, processor="arm64")
    folders = headers.folders_of(LINUX_ARM_PYTHONS, paths.BUILD / "python" / "linux-arm64", bring)
    build_preset("zig-linux-arm64", headers.definition_of(folders))
    names = [
        f"_medial.cpython-{headers.digits(version)}-aarch64-linux-gnu.so" for version in folders
    ]
    return [library.put(paths.BUILD / "zig-linux-arm64" / name, "llvm-strip") for name in names]


def stripped(module: Path) -> bytes:
    """A module for Macs without the names and folders of which debuggers alone ask, signed anew: zig's linker does not
    end when it is asked to leave them out."""
    if not module.is_file():
        raise Failure(f"Expected {paths.shown(module)}, found none; run clean first")
    with tempfile.TemporaryDirectory() as private:
        target = Path(private, module.name)
        run("llvm-strip", "-x", "-o", target, module)
        return target.read_bytes()


BUILDERS = {
    "windows": build_for_windows,
    "macos": build_for_macs,
    "linux_arm64": build_for_linux_arm,
}
