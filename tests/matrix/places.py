# SPDX-License-Identifier: GPL-3.0-or-later
"""The sources of Blenders: this machine, other Debians in folders, the package index of Python."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
INSTALL = ("-m", "pip", "install", "--only-binary", ":all:")
# Folders of Pythons that are not on PATH.
FOLDERS = ("/usr/bin", "/usr/local/bin", str(Path.home() / ".pyenv/versions/{}*/bin"))
READY = "ready"  # a file that is written last
sys.path.insert(0, str(ROOT))

from tools.packaging.debian import mirror  # noqa: E402 - the line above makes it found
from tools.packaging.paths import BLENDERS as CHROOTS  # noqa: E402
from tools.packaging.terminal import Failure  # noqa: E402


class UnavailableError(Exception):
    """A Blender that cannot be had here, and why."""


def system() -> str:
    """The name of this machine's system, such as 'Debian 12'."""
    words = Path("/etc/os-release").read_text(encoding="utf-8").splitlines()
    names = dict(word.replace('"', "").split("=", 1) for word in words if "=" in word)
    return f"{names['NAME'].split()[0]} {names.get('VERSION_ID', '')}".strip()


class Installed:
    """The Blender of this machine."""

    platform = "linux-x64"  # as the extensions platform calls it
    module = ""  # which the zip may lack
    engines = ("Cycles", "EEVEE", "Workbench")
    quick = True
    quick_tests = False  # `build_addon.py test` runs them anyway

    def __init__(self, program: str) -> None:
        self.source, self.words = system(), [program]

    def prepare(self, log: Path) -> list[str]:
        """The options that make tests/addon/run.py use it; raises UnavailableError."""
        if shutil.which(self.words[0]) is None:
            raise UnavailableError(f"no program {self.words[0]}")
        return ["--blender", shlex.join(self.words)]


class Chroot(Installed):
    """The Blender of another Debian, in a folder."""

    quick_tests = True

    def __init__(self, suite: str, source: str) -> None:
        self.suite, self.source = suite, source
        self.words = [str(HERE / "enter.sh"), str(CHROOTS / suite), "blender"]

    def prepare(self, log: Path) -> list[str]:
        if os.geteuid() != 0:
            raise UnavailableError("only root can make and enter a chroot")
        if shutil.which("debootstrap") is None:
            raise UnavailableError("debootstrap is not installed")
        CHROOTS.mkdir(parents=True, exist_ok=True)
        try:
            source = mirror()
        except Failure as reason:
            raise UnavailableError(str(reason)) from None
        run_logged([HERE / "debian_blender.sh", self.suite, CHROOTS / self.suite, source], log)
        return super().prepare(log)


class Bpy:
    """Blender as a Python module, from the package index that pip uses: the official builds."""

    platform, module = "linux-x64", ""
    engines = ("Cycles", "Workbench")
    quick = False
    words: tuple[str, ...] = ()

    def __init__(self, version: str, python: str) -> None:
        self.source, self.folder, self.python = f"bpy {version}", f"bpy-{version}", python
        self.packages = [f"bpy=={version}.*", "pytest", "scipy"]

    def prepare(self, log: Path) -> list[str]:
        return ["--bpy", str(self.environment(log))]

    def environment(self, log: Path) -> Path:
        """The Python of a virtual environment with the packages; raises UnavailableError."""
        folder = CHROOTS / self.folder
        run_logged([self.interpreter(), "-m", "venv", folder], log)
        python = folder / "bin" / "python"
        run_logged([python, *INSTALL, "--upgrade", *self.packages], log)
        return python

    def interpreter(self) -> Path:
        """A Python of the version that brings pip; raises UnavailableError."""
        for path in interpreters(self.python):
            asked = subprocess.run([path, "-c", "import ensurepip"], capture_output=True)
            if asked.returncode == 0:
                return path
        raise UnavailableError(f"no Python {self.python} that makes virtual environments")


class Wine(Bpy):
    """The official builds for Windows, in Wine; their Python is an artifact of the package index of Java."""

    platform, module = "windows-x64", "cp311-win"
    engines = ()  # rendering crashes there
    artifact = "org.bytedeco:cpython:3.11.3-1.5.9:jar:windows-x86_64"

    def __init__(self, version: str) -> None:
        super().__init__(version, "3.11")
        self.source, self.folder = f"bpy {version} for Windows, in Wine", f"windows-{version}"
        self.packages += ["colorama", "numpy==1.26.*"]  # a newer one calls what Wine lacks

    def prepare(self, log: Path) -> list[str]:
        for tool in ("wine", "mvn"):
            if shutil.which(tool) is None:
                raise UnavailableError(f"no program {tool}")
        folder = CHROOTS / self.folder
        if not (folder / READY).exists():
            shutil.rmtree(folder, ignore_errors=True)
            self.fill(folder, log)
            (folder / READY).touch()
        return ["--bpy", shlex.join([str(HERE / "wine.sh"), str(folder)])]

    def fill(self, folder: Path, log: Path) -> None:
        """Python for Windows, with Blender in its folder site."""
        copy = ["dependency:copy", f"-Dartifact={self.artifact}", f"-DoutputDirectory={folder}"]
        run_logged(["mvn", "-q", "-B", *copy], log)
        (archive,) = folder.glob("*.jar")
        with zipfile.ZipFile(archive) as files:
            files.extractall(folder)
        for path in sorted(folder.glob("org/bytedeco/cpython/windows-x86_64/*")):
            path.rename(folder / path.name)
        where = ["--target", folder / "site", "--platform", "win_amd64"]
        version = ["--python-version", self.python]
        run_logged([self.interpreter(), *INSTALL, *where, *version, *self.packages], log)


def interpreters(version):
    """The Pythons of a version on this machine."""
    name = f"python{version}"
    on_path = [Path(found)] if (found := shutil.which(name)) else []
    patterns = [f"{folder.format(version)}/{name}"[1:] for folder in FOLDERS]
    return on_path + [path for pattern in patterns for path in sorted(Path("/").glob(pattern))]


def run_logged(command: list, log: Path) -> None:
    """Run what brings a Blender; raises UnavailableError with its last word."""
    with open(log, "ab") as output:
        words = list(map(str, command))
        code = subprocess.run(words, stdout=output, stderr=subprocess.STDOUT).returncode
    if code != 0:
        last = (log.read_text(encoding="utf-8", errors="replace").strip() or "?").splitlines()[-1]
        raise UnavailableError(f"{Path(command[0]).name} failed: {last.strip()[:200]} (see {log})")
