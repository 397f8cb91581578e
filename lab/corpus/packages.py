# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages of the corpus: fetched by apt, checked by their SHA-256, unpacked, never installed."""

from __future__ import annotations

import hashlib
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path

LIST = Path(__file__).with_name("packages.toml")


@dataclass(frozen=True)
class Package:
    name: str
    version: str
    sha256: str

    def __str__(self) -> str:
        return f"{self.name} {self.version}"


def listed(path: Path = LIST) -> list[Package]:
    return [Package(**words) for words in tomllib.loads(path.read_text())["package"]]


def unpacked(package: Package, cache: Path) -> Path:
    """The folder with the files of a package, which is fetched and unpacked where that was not done before."""
    folder = cache / f"{package.name}_{package.sha256[:12]}"
    if not folder.is_dir():
        half = folder.with_suffix(".half")
        subprocess.run(["dpkg-deb", "-x", str(_fetched(package, cache)), str(half)], check=True)
        half.rename(folder)
    return folder


def _fetched(package: Package, cache: Path) -> Path:
    """The package as a file of the cache whose SHA-256 is the listed one."""
    cache.mkdir(parents=True, exist_ok=True)
    if (found := _in(cache, package)) is not None:
        return found
    wanted = f"{package.name}={package.version}"
    subprocess.run(["apt-get", "download", wanted], cwd=cache, check=True)
    if (found := _in(cache, package)) is None:
        raise SystemExit(
            f"Expected {package} with the SHA-256 {package.sha256}, found another; change {LIST.name}"
        )
    return found


def _in(cache: Path, package: Package) -> Path | None:
    files = sorted(cache.glob(f"{package.name}_*.deb"))
    return next((path for path in files if digest(path) == package.sha256), None)


def digest(path: Path) -> str:
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
