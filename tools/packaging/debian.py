# SPDX-License-Identifier: GPL-3.0-or-later
"""Debian's packages as files: verified by a private apt, not installed. What cannot be had is a Failure."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from .terminal import Failure

KEYRING = Path("/usr/share/keyrings/debian-archive-keyring.gpg")


def download(folder, suite, packages, processor=""):
    """The packages of a suite, by an apt that sees nothing but that suite; of another processor, named as Debian does,
    such as arm64."""
    fetch(folder, "deb", suite, ["download", *packages], processor)
    return sorted(folder.glob("*.deb"))


def download_source(folder, suite, package):
    """The tarball that a package is made of, as its authors published it."""
    fetch(folder, "deb-src", suite, ["source", "--download-only", package])
    (tarball,) = folder.glob("*.orig.tar.*z")
    return tarball


def extract(packages, folder):
    """The files of packages, as they would be installed below /."""
    for package in packages:
        subprocess.run(["dpkg-deb", "--extract", package, folder], check=True)


def labels(files):
    """Names and versions, such as ['pybind11-dev 3.1.0-1']."""
    return sorted(" ".join(file.name.split("_")[:2]) for file in files)


def fetch(folder, kind, suite, words, processor=""):
    require("apt-get", "dpkg-deb")
    if not KEYRING.exists():
        raise Failure(f"expected {KEYRING}; install debian-archive-keyring")
    for part in ("state/lists/partial", "cache/archives/partial"):
        (folder / part).mkdir(parents=True)
    (folder / "status").touch()
    line = f"{kind} [signed-by={KEYRING}] {mirror()} {suite} main\n"
    (folder / "sources.list").write_text(line, encoding="utf-8")
    options = {
        "Dir::Etc::sourcelist": folder / "sources.list",
        "Dir::Etc::sourceparts": "/dev/null",
        "Dir::State": folder / "state",
        "Dir::State::status": folder / "status",
        "Dir::Cache": folder / "cache",
        "Acquire::Languages": "none",
        # Mirrors of a moving suite may stand still. So an old index would be taken, too: good enough for headers.
        "Acquire::Check-Valid-Until": "false",
        "APT::Sandbox::User": "root",
        "APT::Update::Error-Mode": "any",
    }
    if processor:
        options["APT::Architecture"] = options["APT::Architectures"] = processor
    apt = ["apt-get", "-qq", *(f"-o{name}={value}" for name, value in options.items())]
    for command in (["update"], words):
        done = subprocess.run([*apt, *command], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            reason = (done.stderr.strip().splitlines() or ["no reason given"])[0]
            raise Failure(f"{' '.join(words)} of Debian {suite} failed: {reason}")


def mirror():
    """The address of the Debian archive that this machine installs from."""
    query = ["apt-get", "indextargets", "--format", "$(SITE)", "Identifier: Packages"]
    sites = subprocess.run(query, capture_output=True, text=True).stdout.split()
    mirrors = [site for site in sites if site.rstrip("/").endswith("/debian")]
    if not mirrors:
        raise Failure("expected a Debian mirror among apt's sources, found none")
    return mirrors[0]


def require(*tools):
    for tool in tools:
        if shutil.which(tool) is None:
            raise Failure(f"expected {tool}, found none")
