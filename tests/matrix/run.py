#!/usr/bin/env python3
"""Tests the installed add-on in every Blender that this machine has or can get.

    python3 tests/matrix/run.py ZIP EXTENSION_ZIP [--quick] [--keep FOLDER] [--table docs/compatibility.md]

In each: the zip passes Blender's own check and is installed, the tests run without a window and in one,
one mesh is computed, exported and rendered. The exported files must be the same, byte for byte. --quick
runs the main things, and none of the official bpy modules. Screenshots and logs go to the folder that
--keep names, and --table writes the results. What cannot be had is skipped by name; exit code 1 when
something failed in a Blender that runs.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TESTS = ROOT / "tests" / "addon" / "run.py"
CHROOTS = Path(os.environ.get("MEDIAL_AXIS_BLENDERS", ROOT / "build" / "blenders"))
FOLDERS = ("/usr/bin", "/usr/local/bin", str(Path.home() / ".pyenv/versions/{}*/bin"))  # of Pythons

QUICK_SCENES = ["compute_drag_undo", "missing_module"]
MARK = "<!-- written by tests/matrix/run.py: do not edit below -->"
HEADER = (
    "Blender",
    "Where from",
    "Python",
    "NumPy",
    "Installed as",
    "Tests",
    "Window",
    "Rendered",
    "Export, SHA-256",
)


class UnavailableError(Exception):
    """A Blender that cannot be had here, and why."""


@dataclass
class Row:
    """What was found out about one Blender."""

    source: str
    skipped: str = ""
    facts: dict = field(default_factory=dict)
    tests: str = ""
    window: str = "none"
    failures: list[str] = field(default_factory=list)

    def cells(self) -> tuple[str, ...]:
        if self.skipped:
            return ("", self.source, *[""] * 6, f"not tested: {self.skipped}")
        facts = self.facts
        colours = facts.get("colours", {})
        return (
            facts.get("blender", "?"),
            self.source,
            facts.get("python", "?"),
            facts.get("numpy", "?"),
            facts.get("installed", "?"),
            self.tests,
            self.window,
            ", ".join(colours) or "?",
            f"`{facts.get('export', 'none')[:16]}`",
        )


def system() -> str:
    """The name of this machine's system, such as 'Debian 12'."""
    words = Path("/etc/os-release").read_text(encoding="utf-8").splitlines()
    names = dict(word.replace('"', "").split("=", 1) for word in words if "=" in word)
    return f"{names['NAME'].split()[0]} {names.get('VERSION_ID', '')}".strip()


class Installed:
    """The Blender of this machine."""

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
        run_logged([HERE / "debian_blender.sh", self.suite, CHROOTS / self.suite], log)
        return super().prepare(log)


class Bpy:
    """Blender as a Python module, from the package index that pip uses: the official builds."""

    engines = ("Cycles", "Workbench")
    quick = False

    def __init__(self, version: str, python: str) -> None:
        self.version, self.python = version, python
        self.source = f"bpy {version}"
        self.words: list[str] = []

    def prepare(self, log: Path) -> list[str]:
        found = [
            path
            for pattern in FOLDERS
            for path in Path("/").glob(f"{pattern.format(self.python)}/python{self.python}"[1:])
            if subprocess.run([path, "-c", "import ensurepip"], capture_output=True).returncode == 0
        ]
        if not found:
            raise UnavailableError(f"no Python {self.python} that makes virtual environments")
        folder = CHROOTS / f"bpy-{self.version}"
        run_logged([found[0], "-m", "venv", folder], log)
        packages = [f"bpy=={self.version}.*", "pytest", "scipy"]
        install = ["-m", "pip", "install", "--upgrade", "--only-binary", ":all:", *packages]
        run_logged([folder / "bin" / "python", *install], log)
        return ["--bpy", str(folder / "bin" / "python")]


def run_logged(command: list, log: Path) -> None:
    """Run what brings a Blender; raises UnavailableError with its last word."""
    with open(log, "ab") as output:
        code = subprocess.run(
            list(map(str, command)), stdout=output, stderr=subprocess.STDOUT
        ).returncode
    if code != 0:
        last = (log.read_text(encoding="utf-8", errors="replace").strip() or "?").splitlines()[-1]
        raise UnavailableError(f"{Path(command[0]).name} failed: {last.strip()[:200]} (see {log})")


def examine(blender, arguments: argparse.Namespace) -> Row:
    """All that is asked of one Blender."""
    keep = arguments.keep / re.sub(r"\W+", "_", blender.source)
    keep.mkdir(parents=True, exist_ok=True)
    row = Row(blender.source)
    try:
        use = blender.prepare(keep / "prepare.log")
    except UnavailableError as reason:
        row.skipped = str(reason)
        return row
    probe(row, blender, use, keep, arguments)
    if arguments.quick and not blender.quick_tests:
        return row
    code, text = run_tests([*use, "--zip", arguments.zip], keep / "tests.log")
    row.tests = summary_of(text)
    if code != 0:
        row.failures.append(f"tests: {row.tests} (see {keep / 'tests.log'})")
    if blender.words:
        window(row, use, keep, arguments)
    return row


def probe(row: Row, blender, use: list[str], keep: Path, arguments: argparse.Namespace) -> None:
    """One computation with each zip that this Blender takes, and Blender's own check of them."""
    engines = blender.engines[:1] if arguments.quick else blender.engines
    answers = []
    for archive in (arguments.zip, arguments.extension_zip):
        answer = (keep / "probe.json").resolve()
        answer.unlink(missing_ok=True)
        script = ["--script", HERE / "probe.py", answer, *engines]
        code, _ = run_tests([*use, "--zip", archive, *script], keep / "probe.log")
        if code != 0 or not answer.exists():
            row.failures.append(f"{archive.name}: no result (see {keep / 'probe.log'})")
            return
        answers.append(json.loads(answer.read_text(encoding="utf-8")))
        row.facts = answers[0]
        if answers[0]["installed"] != "extension":
            return  # before 4.2 there is the first zip alone
        engines = ()
        if blender.words:
            validate = [*blender.words, "--command", "extension", "validate", archive.resolve()]
            checked = subprocess.run(list(map(str, validate)), capture_output=True, text=True)
            if checked.returncode != 0:
                row.failures.append(f"validate {archive.name}: {checked.stdout}{checked.stderr}")
    if answers[0]["export"] != answers[1]["export"]:
        row.failures.append("the two zips give different exports")
    dull = [engine for engine, colours in row.facts["colours"].items() if colours < 100]
    if dull:
        row.failures.append(f"empty pictures: {', '.join(dull)}")


def window(row: Row, use: list[str], keep: Path, arguments: argparse.Namespace) -> None:
    """Mouse and keyboard; the screenshots are checked by the scenes."""
    if missing := [tool for tool in ("Xvfb", "xdotool", "import") if shutil.which(tool) is None]:
        row.window = f"skipped: no {', '.join(missing)}"
        return
    scenes = QUICK_SCENES if arguments.quick else []
    options = ["--zip", arguments.zip, "--gui", "--keep", keep / "gui", *scenes]
    code, text = run_tests([*use, *options], keep / "gui.log")
    passed, failed = (
        re.findall(rf"^{verdict}  (\w+)", text, re.M) for verdict in ("passed", "FAILED")
    )
    row.window = f"{len(passed)} of {len(passed) + len(failed)} scenes"
    if code != 0 or not passed:
        row.failures.append(f"window: {', '.join(failed) or 'no scene'} (see {keep / 'gui.log'})")


def run_tests(options: list, log: Path) -> tuple[int, str]:
    """tests/addon/run.py with its output in a log; returns its exit code and output."""
    command = [sys.executable, str(TESTS), *map(str, options)]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    log.write_text(done.stdout, encoding="utf-8")
    return done.returncode, done.stdout


def summary_of(text: str) -> str:
    """pytest's last line without its seconds: '334 passed, 5 skipped'."""
    counts = re.findall(r"^=*\s?((?:\d+ \w+,? ?)+) in [\d.]+s", text, re.M)
    kinds = [part for part in (counts[-1].split(", ") if counts else []) if "warning" not in part]
    return ", ".join(part for part in kinds if "deselected" not in part) or "no result"


def compare(rows: list[Row]) -> list[str]:
    """The sentence that says that exports differ, if they do."""
    exports = {row.facts["export"]: row.facts["blender"] for row in rows if "export" in row.facts}
    if len(exports) < 2:
        return []
    return [
        "the same mesh gives different .ma files: " + ", ".join(map(" in ".join, exports.items()))
    ]


def table(rows: list[tuple[str, ...]]) -> str:
    lines = [HEADER, tuple("---" for _ in HEADER), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def write_table(path: Path, rows: list[Row], sources: list[str]) -> None:
    """Replace what stands below the mark; of Blenders that were not asked now, the old row stays."""
    above, _, below = path.read_text(encoding="utf-8").partition(MARK)
    old = [tuple(line[2:-2].split(" | ")) for line in below.splitlines() if line.startswith("| ")]
    cells = {row[1]: row for row in [*old[2:], *(row.cells() for row in rows)] if row[1] in sources}
    whole = table([cells[source] for source in sources if source in cells])
    path.write_text(f"{above}{MARK}\n\n{whole}\n", encoding="utf-8")


def main() -> int:
    formatter = argparse.RawTextHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=formatter)
    parser.add_argument("zip", type=Path, help="the zip with one folder in it")
    parser.add_argument("extension_zip", type=Path, help="the zip for the extensions platform")
    parser.add_argument("--blender", default="blender", help="the installed Blender")
    parser.add_argument("--quick", action="store_true", help="the main things only")
    parser.add_argument("--only", default="", help="Blenders whose source contains this word")
    parser.add_argument("--keep", type=Path, default=ROOT / "build" / "matrix")
    parser.add_argument("--table", type=Path, help="write the results below the mark in this file")
    arguments = parser.parse_args()
    blenders = [
        Installed(arguments.blender),
        Chroot("trixie", "Debian 13"),
        Chroot("sid", "Debian sid"),
        *map(Bpy, ("4.2", "4.5", "5.0", "5.2"), ("3.11", "3.11", "3.11", "3.13")),
    ]
    rows = []
    for blender in blenders:
        if (arguments.quick and not blender.quick) or arguments.only not in blender.source:
            continue
        print(f"{blender.source} ...", flush=True)
        rows.append(examine(blender, arguments))
        print(
            table([rows[-1].cells()]).splitlines()[-1], *rows[-1].failures, sep="\n  ", flush=True
        )
    print("\n" + table([row.cells() for row in rows]))
    if arguments.table:
        write_table(arguments.table, rows, [blender.source for blender in blenders])
    failures = [f"{row.source}: {failure}" for row in rows for failure in row.failures]
    failures += compare(rows)
    print(*(f"FAILED {failure}" for failure in failures), sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
