# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip that people install, and one per system for the extensions platform."""

from __future__ import annotations

import io
import os
import shutil
import tempfile
import zipfile
from collections.abc import Iterable
from pathlib import Path

from . import licences, macho, node_groups, paths, wheels
from .terminal import python_that, run, say

MODULES = "lib/_medial."  # how the names of compiled modules begin
# How they end, on each system, named as extensions.blender.org does; a module for Macs holds both processors.
PLATFORMS = {
    "linux-x64": "-x86_64-linux-gnu.so",
    "linux-arm64": "-aarch64-linux-gnu.so",
    "macos-x64": "-darwin.so",
    "macos-arm64": "-darwin.so",
    "windows-x64": "-win_amd64.pyd",
}
_SUFFIXES = {".py", ".po", ".toml", ".so", ".pyd", ".png", ".svg", ".yaml"}


def pack(blender: Path | str = "blender", local: bool = False, with_wheels: bool = False) -> Path:
    """The zip that installs on Blender 3.4 (add-on) and 4.2 and newer (extension), and those for the extensions
    platform, which wants one per system and the files at its top; `local` leaves these out. Same files, same bytes.
    `with_wheels` writes wheels, and zips that hold them, into a folder of their own. `blender` writes the library of
    node groups. Returns the first."""
    say("Packing the add-on")
    paths.DIST.mkdir(exist_ok=True)
    files = contents(blender)
    archive = archive_for()
    write_zip(archive, inside_folder(files))
    print(f"{paths.shown(archive)}: {archive.stat().st_size / 1e6:.1f} MB")
    for platform in PLATFORMS:
        archive_for(platform).unlink(missing_ok=True)
        if not local and (own := for_platform(files, platform)):
            write_zip(archive_for(platform), own)
    if with_wheels:
        write_wheels(files, paths.DIST / "wheels")
    abis = sorted(name.split(".")[1] for name in files if name.startswith(MODULES))
    print(f"{len(files)} files; compiled for {', '.join(abis) or 'no Python'}")
    return archive


def archive_for(platform: str = "") -> Path:
    """The zip for people, or one for the extensions platform, named as Blender names such."""
    return (
        paths.DIST / f"{paths.PACKAGE}-{paths.full_version()}{'-' * bool(platform)}{platform}.zip"
    )


def contents(blender: Path | str = "blender") -> dict[str, bytes]:
    """All that the add-on is made of: name below its top folder -> bytes."""
    files = _read(paths.ADDON, _sources())
    files["LICENSE"] = (paths.ROOT / "LICENSE").read_bytes()
    with tempfile.TemporaryDirectory() as name:
        made = Path(name)
        make_manual(made / "manual")
        _make_presets(made / "presets" / paths.PACKAGE)
        files.update(_read(made, made.rglob("*")))
    library = node_groups.library(blender)
    if library is not None:
        found = _read(library, library.iterdir())
        files.update({f"nodes/{name}": content for name, content in found.items()})
    _state_the_commit(files)
    modules = [name for name in files if name.startswith(MODULES)]
    files["THIRD_PARTY_LICENSES"] = licences.text(modules).encode()
    return files


def _state_the_commit(files: dict[str, bytes]) -> None:
    """A development build says so in the manifest and in the package, so that two builds are never called the same."""
    commit = paths.commit().encode()
    if commit:
        for name, line in (
            ("blender_manifest.toml", b'\nversion = "' + paths.version().encode() + b'%s"'),
            ("__init__.py", b'\nCOMMIT = "%s"'),
        ):
            plus = b"+" * name.endswith(".toml")
            files[name] = files[name].replace(line % b"", line % (plus + commit), 1)


def _read(folder: Path, found: Iterable[Path]) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in found if path.is_file()
    }


def _sources() -> list[Path]:
    """The add-on's files without caches, hidden files and leftovers."""
    return [
        path
        for path in paths.ADDON.rglob("*")
        if path.suffix in _SUFFIXES
        and not any(
            part.startswith((".", "__pycache__")) for part in path.relative_to(paths.ADDON).parts
        )
    ]


def make_manual(folder: Path) -> None:
    """The user pages as web pages, for readers without a network."""
    python = python_that("import markdown", "install python3-markdown")
    run(python, "-B", Path(__file__).with_name("manual.py"), folder)


def _make_presets(folder: Path) -> None:
    python = python_that("import sys; assert sys.version_info >= (3, 10)", "install python3")
    run(python, Path(__file__).with_name("presets.py"), folder)


def inside_folder(files: dict[str, bytes]) -> dict[str, bytes]:
    """The files as the zip for people has them: in one folder."""
    return {f"{paths.PACKAGE}/{name}": content for name, content in files.items()}


def for_platform(files: dict[str, bytes], platform: str) -> dict[str, bytes]:
    """The files for one system, if there is a module for it; the manifest says for which, before its first table."""
    parts = {
        name: _module_for(platform, name, content) if name.startswith(MODULES) else content
        for name, content in files.items()
    }
    own = {name: content for name, content in parts.items() if content is not None}
    if not any(name.startswith(MODULES) for name in own):
        return {}
    line = f'platforms = ["{platform}"]\n\n['.encode()
    manifest = files["blender_manifest.toml"].replace(b"\n[", b"\n" + line, 1)
    return {**own, "blender_manifest.toml": manifest}


def _module_for(platform: str, name: str, module: bytes) -> bytes | None:
    """A module as the zip of a system has it, None in those of others; of one for Macs, the processor's image."""
    if not name.endswith(PLATFORMS[platform]):
        return None
    system, _, processor = platform.partition("-")
    if system != "macos":
        return module
    images = {macho.NAMES[key]: image for key, image in macho.processors(module).items()}
    return images.get(processor)


def write_wheels(files: dict[str, bytes], folder: Path) -> None:
    """Replace the folder by a wheel per module, and a zip per system that holds its wheels in place of modules."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for platform in PLATFORMS:
        own = for_platform(files, platform)
        made = {}
        for module in (name for name in own if name.startswith(MODULES)):
            name, contents = wheels.wheel(own, module, platform)
            made[name] = zipped(contents)
            (folder / name).write_bytes(made[name])
        if made:
            archive = folder / archive_for(platform).name
            write_zip(archive, wheels.in_place_of_modules(own, made))
            print(f"{paths.shown(archive)}: {archive.stat().st_size / 1e6:.1f} MB")


def write_zip(target: Path, files: dict[str, bytes]) -> None:
    """A zip, renamed at the end, so that it is whole or not there."""
    fresh = target.with_suffix(".new")
    fresh.write_bytes(zipped(files))
    os.replace(fresh, target)


def zipped(files: dict[str, bytes]) -> bytes:
    """A zip with the same bytes for the same files."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in sorted(files.items()):
            entry = zipfile.ZipInfo(name)  # with the same date always
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
    return stream.getvalue()
