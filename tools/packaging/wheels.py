# SPDX-License-Identifier: GPL-3.0-or-later
"""The library as wheels, one per compiled module, and a system's zip that holds them in place of loose modules.

A wheel is what `pip wheel .` makes on that system: the package without Blender's side. It is written from files that
are there, so that one machine can make those of all systems. The extensions platform asks for this layout.
"""

from __future__ import annotations

import base64
import hashlib
import re
from typing import Dict

from . import paths

Files = Dict[str, bytes]  # name -> content
FOLDER = "wheels/"  # in the zip
FRONT = ("__init__.py", "__main__.py", "cli.py", "console.py", "library.py", "py.typed")
PARTS = ("commands/", "core/")
LICENCES = ("LICENSE", "THIRD_PARTY_LICENSES")
# The oldest systems that check_module.py lets modules need, in the words of wheels.
TAGS = {
    "linux-x64": "manylinux_2_28_x86_64",
    "linux-arm64": "manylinux_2_28_aarch64",
    "macos-x64": "macosx_11_0_x86_64",
    "macos-arm64": "macosx_11_0_arm64",
    "windows-x64": "win_amd64",
}
_METADATA = """\
Metadata-Version: 2.1
Name: medial-axis
Version: {version}
Summary: Medial axis of meshes and point clouds, with radii: Dey and Zhao's MEDIAL
License: GPL-3.0-or-later
Requires-Python: >=3.11
Requires-Dist: numpy
"""
_WHEEL = "Wheel-Version: 1.0\nGenerator: medial_axis\nRoot-Is-Purelib: false\nTag: {tag}\n"
_COMMANDS = "[console_scripts]\nmedial-axis = medial_axis.__main__:main\n"


def wheel(files: Files, module: str, platform: str) -> tuple[str, Files]:
    """The name of the wheel with a module, and its contents; `files` are those of the system's zip."""
    python = "cp" + re.search(r"\.(?:cpython-|cp)(\d+)", module)[1]
    tag = f"{python}-{python}-{TAGS[platform]}"
    version = paths.full_version()
    of_package = {
        name: content
        for name, content in files.items()
        if name in FRONT or name == module or (name.startswith(PARTS) and name.endswith(".py"))
    }
    contents = {f"{paths.PACKAGE}/{name}": content for name, content in of_package.items()}
    stub = paths.ROOT / "native" / "python" / "_medial.pyi"
    contents[f"{paths.PACKAGE}/lib/_medial.pyi"] = stub.read_bytes()
    info = f"{paths.PACKAGE}-{version}.dist-info"
    contents[f"{info}/METADATA"] = _METADATA.format(version=version).encode()
    contents[f"{info}/WHEEL"] = _WHEEL.format(tag=tag).encode()
    contents[f"{info}/entry_points.txt"] = _COMMANDS.encode()
    contents.update({f"{info}/licenses/{name}": files[name] for name in LICENCES if name in files})
    contents[f"{info}/RECORD"] = record(contents, f"{info}/RECORD")
    return f"{paths.PACKAGE}-{version}-{tag}.whl", contents


def record(contents: Files, own: str) -> bytes:
    """The list of a wheel's files with their hashes and sizes; its own line has none."""
    lines = []
    for name, content in sorted(contents.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
        lines.append(f"{name},sha256={digest},{len(content)}")
    return "\n".join([*lines, f"{own},,", ""]).encode()


def in_place_of_modules(files: Files, modules: Files) -> Files:
    """The files of a system's zip with wheels, by name, in place of the modules; the manifest names them."""
    names = ", ".join(f'"./{FOLDER}{name}"' for name in sorted(modules))
    line = f"wheels = [{names}]\n\n[".encode()
    rest = {name: content for name, content in files.items() if not name.startswith("lib/")}
    rest["blender_manifest.toml"] = rest["blender_manifest.toml"].replace(b"\n[", b"\n" + line, 1)
    return {**rest, **{FOLDER + name: content for name, content in modules.items()}}
