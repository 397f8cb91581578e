#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the installed add-on in every Blender that this machine has or can get.

    python3 tests/matrix/run.py ZIP [--quick] [--keep FOLDER] [--table docs/compatibility.md]

In each: the zip passes Blender's own check and is installed, also from a remote repository that brings its next
version, the tests run without a window and in one, one mesh is computed, exported and rendered, and given to the
command line. The files must be the same, byte for byte.
--quick runs the main things, and none of the official bpy modules. Screenshots and logs go to the folder that
--keep names, and --table writes the results. What cannot be had is skipped by name; exit code 1 when
something failed in a Blender that runs.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TESTS = ROOT / "tests" / "addon" / "run.py"
sys.path.insert(0, str(HERE))

import updates  # noqa: E402 - beside this, as the next
from places import Bpy, Chroot, Failure, Installed, UnavailableError, Wine  # noqa: E402

QUICK_SCENES = ["compute_drag_undo", "missing_module"]
NO_RESULT = "no result"  # as after a crash, which not everything tells by its exit code
HASHES = ("export", "command")  # of the .ma files of the operator and of the command line
MARK = "<!-- written by tests/matrix/run.py: do not edit below -->"
HEADER = (
    *("Blender", "Where from", "Python", "NumPy", "Installed as", "Tests", "Window", "Rendered"),
    *("Export, SHA-256", "Command line, SHA-256"),
)


@dataclass
class Row:
    """The results of one Blender."""

    source: str
    skipped: str = ""
    facts: dict = field(default_factory=dict)
    tests: str = ""
    window: str = "none"
    failures: list[str] = field(default_factory=list)

    def cells(self) -> tuple[str, ...]:
        if self.skipped:
            return ("", self.source, *[""] * 7, f"not tested: {self.skipped}")
        names = ("blender", "python", "numpy", "installed")
        blender, *others = (self.facts.get(name, "?") for name in names)
        rendered = ", ".join(self.facts.get("colours", {})) or "none"
        hashes = (self.facts.get(what, "none")[:16] for what in HASHES)
        return (blender, self.source, *others, self.tests, self.window, rendered, *hashes)


def examine_all(blenders: list, arguments: argparse.Namespace) -> list[Row]:
    """The rows in order; several Blenders at a time where --quick asks little of each."""
    rows = []
    with ThreadPoolExecutor(len(os.sched_getaffinity(0)) if arguments.quick else 1) as pool:
        for row in pool.map(lambda blender: examine(blender, arguments), blenders):
            rows.append(row)
            print(table([row.cells()]).splitlines()[-1], *row.failures, sep="\n  ", flush=True)
    return rows


def examine(blender, arguments: argparse.Namespace) -> Row:
    """All that is asked of one Blender."""
    keep = arguments.keep / re.sub(r"\W+", "_", blender.source)
    keep.mkdir(parents=True, exist_ok=True)
    print(f"{blender.source} ...", flush=True)
    row = Row(blender.source)
    if blender.module and not has_module(arguments.zip, blender.module):
        row.skipped = f"no module {blender.module} in the zip"
        return row
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
    if code != 0 or row.tests == NO_RESULT:
        row.failures.append(f"tests: {row.tests} (see {keep / 'tests.log'})")
    if blender.words:
        window(row, use, keep, arguments)
        if row.facts.get("installed") == "extension":
            update(row, blender, arguments.zip)
    return row


def update(row: Row, blender, archive: Path) -> None:
    """A remote repository brings the add-on and its next version."""
    try:
        updates.check(extension_zip(archive, blender.platform).resolve(), list(blender.words))
        row.facts["installed"] += ", and updated from a repository"
    except Failure as reason:
        row.failures.append(f"repository: {reason}")


def has_module(archive: Path, name: str) -> bool:
    with zipfile.ZipFile(archive) as files:
        return any(f"_medial.{name}" in file for file in files.namelist())


def probe(row: Row, blender, use: list[str], keep: Path, arguments: argparse.Namespace) -> None:
    """One computation with each zip that this Blender takes, and Blender's own check of them."""
    engines = blender.engines[:1] if arguments.quick else blender.engines
    answers = []
    for archive in (arguments.zip, extension_zip(arguments.zip, blender.platform)):
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
    if any(answers[0][what] != answers[1][what] for what in HASHES):
        row.failures.append("the two zips give different exports")
    dull = [engine for engine, colours in row.facts["colours"].items() if colours < 100]
    if dull:
        row.failures.append(f"empty pictures: {', '.join(dull)}")


def extension_zip(archive: Path, platform: str) -> Path:
    """The zip for the extensions platform, which lies next to the one for people."""
    return archive.with_name(f"{archive.stem}-{platform}.zip")


def window(row: Row, use: list[str], keep: Path, arguments: argparse.Namespace) -> None:
    """Mouse and keyboard; the screenshots are checked by the scenes."""
    if missing := [tool for tool in ("Xvfb", "xdotool", "import") if shutil.which(tool) is None]:
        row.window = f"skipped: no {', '.join(missing)}"
        return
    scenes = QUICK_SCENES if arguments.quick else []
    options = ["--zip", arguments.zip, "--gui", "--keep", keep / "gui", *scenes]
    code, text = run_tests([*use, *options], keep / "gui.log")
    passed, failed = (re.findall(rf"^{how}  (\w+)", text, re.M) for how in ("passed", "FAILED"))
    row.window = f"{len(passed)} of {len(passed) + len(failed)} scenes"
    if code != 0 or not passed:
        row.failures.append(f"window: {', '.join(failed) or 'no scene'} (see {keep / 'gui.log'})")


def run_tests(options: list, log: Path) -> tuple[int, str]:
    """tests/addon/run.py with its output in a log; returns its exit code and output."""
    return logged([sys.executable, TESTS, *options], log)


def logged(command: list, log: Path, environment: Mapping[str, str] = {}) -> tuple[int, str]:
    """Run a command with its output in a log; returns its exit code and output."""
    done = subprocess.run(
        list(map(str, command)),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, **environment},
    )
    log.write_text(done.stdout, encoding="utf-8")
    return done.returncode, done.stdout


def summary_of(text: str) -> str:
    """pytest's last line without its seconds: '334 passed, 5 skipped'."""
    counts = re.findall(r"^=*\s?((?:\d+ \w+,? ?)+) in [\d.]+s", text, re.M)
    kinds = [part for part in (counts[-1].split(", ") if counts else []) if "warning" not in part]
    return ", ".join(part for part in kinds if "deselected" not in part) or NO_RESULT


def compare(rows: list[Row]) -> list[str]:
    """The sentences that say that files differ, if they do."""
    different = []
    for what in HASHES:
        found = {row.facts[what]: row.source for row in rows if what in row.facts}
        if len(found) > 1:
            places = ", ".join(map(" in ".join, found.items()))
            different.append(f"the same mesh gives different .ma files ({what}): {places}")
    return different


def table(rows: list[tuple[str, ...]]) -> str:
    lines = [HEADER, tuple("---" for _ in HEADER), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def write_table(path: Path, rows: list[Row], sources: list[str]) -> None:
    """Replaces the text below the mark; Blenders that did not run this time keep their rows."""
    above, _, below = path.read_text(encoding="utf-8").partition(MARK)
    old = [tuple(line[2:-2].split(" | ")) for line in below.splitlines() if line.startswith("| ")]
    cells = {row[1]: row for row in [*old[2:], *(row.cells() for row in rows)] if row[1] in sources}
    whole = table([cells[source] for source in sources if source in cells])
    path.write_text(f"{above}{MARK}\n\n{whole}\n", encoding="utf-8")


def main() -> int:
    formatter = argparse.RawTextHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=formatter)
    help_of_zip = "the zip with one folder in it; those for the extensions platform lie beside it"
    parser.add_argument("zip", type=Path, help=help_of_zip)
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
        *map(Wine, ("4.2", "4.5", "5.0")),
    ]
    wanted = [b for b in blenders if b.quick or not arguments.quick]
    rows = examine_all([b for b in wanted if arguments.only in b.source], arguments)
    print("\n" + table([row.cells() for row in rows]))
    if arguments.table:
        write_table(arguments.table, rows, [blender.source for blender in blenders])
    failures = [f"{row.source}: {failure}" for row in rows for failure in row.failures]
    failures += compare(rows)
    print(*(f"FAILED {failure}" for failure in failures), sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
