# SPDX-License-Identifier: GPL-3.0-or-later
"""THIRD_PARTY_LICENSES: what of others is compiled into the modules, in which version, and under which terms.

The versions are those of the Debian packages that the headers and static libraries belong to; the terms are the files
that these packages bring.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from . import headers, paths, zig
from .terminal import Failure, output_of

DOCUMENTS = Path("/usr/share/doc")
LGPL = Path("/usr/share/common-licenses/LGPL-3")


@dataclass(frozen=True)
class Component:
    """A part made by others: its name, a file of its Debian package, and its licences."""

    name: str
    file: str
    licence: str


EVERYWHERE = (
    Component("CGAL", "/usr/include/CGAL/version.h", "GPL-3.0-or-later, parts LGPL-3.0-or-later"),
    Component("Boost", "/usr/include/boost/version.hpp", "BSL-1.0"),
    Component("pybind11", "/usr/include/pybind11/pybind11.h", "BSD-3-Clause"),
)
# The modules for Linux use the C++ run time of the system; in those for Windows it is compiled in.
WINDOWS = (
    Component(
        "libstdc++ and libgcc",
        "/usr/lib/gcc/x86_64-w64-mingw32/*-posix/libstdc++.a",
        "GPL-3.0-or-later WITH GCC-exception-3.1",
    ),
    Component(
        "mingw-w64 with winpthreads",
        "/usr/x86_64-w64-mingw32/lib/libwinpthread.a",
        "MIT and others",
    ),
)

_INTRODUCTION = """\
The compiled modules of this add-on, lib/_medial.*, contain code of others, as follows. The add-on itself is under the
GNU General Public License, version 3 or later: see LICENSE, whose text also holds for the parts below that name it.
"""
_BY_ZIG = """LLVM's libc++, libc++abi and compiler-rt: Apache-2.0 WITH LLVM-exception
They are compiled into the modules for Macs and for Linux on arm64. These come from: {origin}.

{terms}"""
_OF_ZIG = ("-darwin.so", "-aarch64-linux-gnu.so")
# By the folder in which headers of Pythons lie: how names of modules compiled with them end, and words for the system.
_SYSTEM_OF_HEADERS = {
    "python": ("-x86_64-linux-gnu.so", ""),
    "linux-arm64": ("-aarch64-linux-gnu.so", " for Linux on arm64"),
    "macos": ("-darwin.so", " for Macs"),
    "windows": ("-win_amd64.pyd", " for Windows"),
}
_RULE = "=" * 100


def text(modules: list[str]) -> str:
    """The whole file for a zip with the modules of these names."""
    # Modules by Microsoft's compiler come from another machine and have none of mingw-w64.
    windows = any(name.endswith("-win_amd64.pyd") for name in modules)
    windows = windows and (paths.BUILD / "mingw").is_dir()
    components = [*EVERYWHERE, *(WINDOWS if windows else ())]
    parts = [_INTRODUCTION, *map(_part, components), *_parts_of_zig(modules), _lesser_licence()]
    if others := _newer_pybind11(modules):
        parts.insert(1, f"In modules for other Pythons pybind11 is another version: {others}.\n")
    return f"\n{_RULE}\n\n".join(parts)


def _part(component: Component) -> str:
    package, version = _package(component)
    terms = _terms(component, package)
    return f"{component.name}: {component.licence}\nDebian package {package} {version}\n\n{terms}"


def _parts_of_zig(modules: list[str]) -> list[str]:
    """The C++ library in modules that zig compiled, and its terms; those from other machines have none of it."""
    origin = zig.origin()
    if origin is None or not any(name.endswith(_OF_ZIG) for name in modules):
        return []
    terms = (zig.program().parent / "lib/libcxx/LICENSE.TXT").read_text(encoding="utf-8")
    return [_BY_ZIG.format(origin=", ".join(origin), terms=terms)]


def _package(component: Component) -> tuple[str, str]:
    """The Debian package that a component's file belongs to, and its version."""
    files = sorted(Path("/").glob(component.file[1:]))
    if not files:
        raise Failure(
            f"Expected {component.name} as {component.file}, found none, so its licence is not at hand; "
            "pack on Debian, with the packages that 'build_addon.py build' installs"
        )
    package = output_of("dpkg-query", "--search", files[0]).split(":")[0]
    return package, output_of("dpkg-query", "--show", "--showformat", "${Version}", package)


def _terms(component: Component, package: str) -> str:
    path = DOCUMENTS / package / "copyright"
    if not path.is_file():
        raise Failure(f"Expected the licence of {component.name} at {path}, found none")
    whole = path.read_text(encoding="utf-8")
    return _boost_licence(whole) if component.name == "Boost" else whole


def _boost_licence(whole: str) -> str:
    """The licence alone: Debian's file also lists 46,000 lines of who wrote what."""
    found = re.search(r"^License: BSL-1\.0\n((?: .*\n)+)", whole, re.MULTILINE)
    if found is None:
        raise Failure(
            "Expected the Boost Software License in the copyright file of Boost, found none"
        )
    return re.sub(r"^ \.?", "", found[1], flags=re.MULTILINE)


def _lesser_licence() -> str:
    if not LGPL.is_file():
        raise Failure(f"Expected the text of the LGPL at {LGPL}, found none")
    return LGPL.read_text(encoding="utf-8")


def _newer_pybind11(modules: list[str]) -> str:
    """The versions of pybind11 that came with the headers of other Pythons, such as 'pybind11-dev 3.1.0-1 (3.14)'."""
    found = []
    for folder in sorted((paths.BUILD / "python").glob("**/3.*")):
        ending, label = _SYSTEM_OF_HEADERS[folder.parent.name]
        mark = f"{folder.name.replace('.', '')}{ending}"
        if (folder / headers.STAMP).is_file() and any(name.endswith(mark) for name in modules):
            versions = [name for name in headers.origin(folder) if name.startswith("pybind11")]
            found += [f"{name} (Python {folder.name}{label})" for name in versions]
    return ", ".join(found)
