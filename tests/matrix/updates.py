#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs the add-on from a remote repository, as users do, and updates it to a newer version.

    python3 tests/matrix/updates.py dist/medial_axis-VERSION-linux-x64.zip [--blender WORDS]

The repository is the folder that `build_addon.py repository` makes, on a web server of this machine. After each step
Blender starts anew, and the add-on must be enabled, have the right version and compute an axis.
"""

from __future__ import annotations

import argparse
import functools
import json
import re
import sys
import tempfile
import threading
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from tools.packaging import pack, paths, repository  # noqa: E402 - the line above makes it found
from tools.packaging.blender import Blender  # noqa: E402
from tools.packaging.terminal import Failure, output_of  # noqa: E402

ID = "medial_axis_test"  # of the repository, in Blender


class Quiet(SimpleHTTPRequestHandler):
    """Serves a folder without a line for each file."""

    def log_message(self, *_words: object) -> None:
        pass


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of a web server with the folder's files."""
    handler = functools.partial(Quiet, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


def newer(archive: Path, folder: Path) -> tuple[Path, str]:
    """The zip with the next version in its manifest, and that version."""
    with zipfile.ZipFile(archive) as files:
        contents = {name: files.read(name) for name in files.namelist()}
    manifest = contents["blender_manifest.toml"].decode()
    stated = re.search(r'^version = "(\d+\.\d+)\.(\d+)', manifest, re.MULTILINE)
    version = f"{stated[1]}.{int(stated[2]) + 1}"
    changed = re.sub(r'^version = ".+"', f'version = "{version}"', manifest, flags=re.MULTILINE)
    target = folder / f"{paths.PACKAGE}-{version}.zip"
    pack.write_zip(target, {**contents, "blender_manifest.toml": changed.encode()})
    return target, version


def installed(blender: Blender, folder: Path) -> str:
    """The version that a fresh start of Blender has enabled and computes with."""
    answer = folder / "enabled.json"
    answer.unlink(missing_ok=True)
    words = ("--background", "--python-exit-code", "1", "--python", HERE / "enabled.py", "--")
    output_of(
        *blender.program, *words, f"bl_ext.{ID}.{paths.PACKAGE}", answer, env=blender.environment
    )
    return json.loads(answer.read_text(encoding="utf-8"))["version"]


def check(archive: Path, program: list[str]) -> tuple[str, str]:
    """Install and update; returns both versions, and raises Failure where Blender does not have the newer one."""
    with tempfile.TemporaryDirectory(prefix="medial_axis_updates_") as name:
        folder, site = Path(name), Path(name) / "site"
        blender = Blender(program, folder / "profile")

        def extension(*words: object) -> None:
            start = (*program, "--online-mode", "--command", "extension")
            output_of(*start, *words, env=blender.environment)

        repository.make([archive], site, program)
        with served(site) as address:
            extension("repo-add", "--clear-all", "--url", f"{address}/index.json", ID)
            extension("install", "--sync", "--enable", paths.PACKAGE)
            first = installed(blender, folder)
            fresh, version = newer(archive, folder)
            repository.make([fresh], site, program)
            extension("update", "--sync")
            second = installed(blender, folder)
    if second != version or first == second:
        raise Failure(f"Expected an update to {version}, found {second} after {first}")
    return first, second


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("archive", type=Path)
    parser.add_argument("--blender", default="blender", metavar="WORDS")
    asked = parser.parse_args()
    first, second = check(asked.archive.resolve(), repository.newer_blender(asked.blender))
    print(f"installed {first} and updated it to {second}")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(str(failure))
