# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the library with one fault at a time and says which test notices it.

    python3 lab/mutations/sweep.py --check                  each text occurs once in the sources; takes no time
    python3 lab/mutations/sweep.py --folder FOLDER          all mutations; the table goes into docs/lab/mutations.csv
    python3 lab/mutations/sweep.py --folder FOLDER --only selection.cpp   those with such words in the table

Works on a copy of the tree in FOLDER, so the checkout is not touched. What was found is kept there, and a sweep that
was stopped goes on where it was; --again forgets it. `ctest` is asked first. What it does not notice is put to the
Python tests that the mutation names, or to all of them when it names none.
"""

import argparse
import csv
import json
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from mutations import MUTATIONS, Mutation

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/lab/mutations.md"
TABLE = PAGE.with_suffix(".csv")
MARK = "<!-- The rest is written by lab/mutations/sweep.py. -->\n"
HEADER = ["file", "fault", "noticed by"]
TARGETS = ("medial_tests", "medial_thread_tests", "medial_cost_tests")
EQUIVALENT, SURVIVED, UNDECIDED = "equivalent", "survived", "not noticed by ctest"


def problems() -> list[str]:
    """The errors of the list: texts that do not occur exactly once, and names that occur twice."""
    found = []
    for mutation in MUTATIONS:
        try:
            if mutation.applied((ROOT / mutation.path).read_text()) == "":
                found.append(f"Expected a source, found an empty one: {mutation.path}.")
        except (OSError, ValueError) as error:
            found.append(str(error))
    names = [m.breaks for m in MUTATIONS]
    found += [
        f"Expected one mutation, found several that say {n!r}."
        for n in {*names}
        if names.count(n) > 1
    ]
    return found


class Copy:
    """A copy of the tree with a build folder of its own."""

    def __init__(self, folder: Path, python: str, jobs: int) -> None:
        self.tree, self.build = folder / "tree", folder / "build"
        self.log, self.python, self.jobs = folder / "log.txt", python, jobs

    def update(self) -> None:
        """Brings the copy up to date; files that are the same keep their times, so that little is built again."""
        listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(listed, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for name in filter(None, names.split("\0")):
            here, there = ROOT / name, self.tree / name
            if here.is_file() and not (there.exists() and there.read_bytes() == here.read_bytes()):
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(here, there)

    def run(self, *command: str | Path, cwd: Path | None = None) -> tuple[bool, str]:
        """Whether it succeeded, and what it said, which is also added to the log."""
        words = [str(word) for word in command]
        done = subprocess.run(
            words, cwd=cwd or self.tree, capture_output=True, text=True, errors="replace"
        )
        text = done.stdout + done.stderr
        with self.log.open("a") as log:
            log.write(f"$ {' '.join(words)}\n{text}\n")
        return done.returncode == 0, text

    def configure(self) -> None:
        options = ("-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={self.python}")
        self.must(*self.run("cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", *options))

    def compile(self, *targets: str) -> tuple[bool, str]:
        return self.run(
            "cmake", "--build", self.build, "--parallel", str(self.jobs), "--target", *targets
        )

    def must(self, succeeded: bool, text: str) -> None:
        if not succeeded:
            raise SystemExit(
                f"Expected the sources to build and to pass without a fault, found:\n{text[-3000:]}"
            )

    def noticed_by_ctest(self) -> str:
        """The first test that fails; empty when none does."""
        succeeded, text = self.run(
            "ctest",
            "--test-dir",
            self.build,
            "--stop-on-failure",
            "--timeout",
            "300",
            "-j",
            str(self.jobs),
        )
        if succeeded:
            return ""
        failures = text.partition("The following tests FAILED:")[2]  # skipped ones stand before it
        failed = re.search(r"^\s*\d+ - (\S+)", failures, re.MULTILINE)
        return failed[1] if failed else "?"

    def noticed_by_python(self, files: tuple[str, ...]) -> str:
        """The first Python test that fails; empty when none does."""
        self.must(*self.compile("_medial"))
        library = self.tree / "blender_addon/lib"
        shutil.rmtree(library, ignore_errors=True)
        library.mkdir()
        for module in self.build.glob("_medial.*.so"):
            shutil.copy(module, library)
        names = [f"tests/python/{file}" for file in files] or ["tests/python"]
        succeeded, text = self.run(
            self.python, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *names
        )
        failed = re.search(r"^(?:FAILED|ERROR) (\S+?)(?: - .*)?$", text, re.MULTILINE)
        return "" if succeeded else failed[1].removeprefix("tests/python/") if failed else "?"


def outcome(copy: Copy, mutation: Mutation, native: bool) -> str:
    """The test that notices the mutation; with `native` only ctest runs. The copy is restored."""
    path = copy.tree / mutation.path
    text = path.read_text()
    path.write_text(mutation.applied(text))
    try:
        succeeded, said = copy.compile(*TARGETS)
        if not succeeded:
            raise SystemExit(
                f"Expected a fault that compiles, found ({mutation.breaks}):\n{said[-3000:]}"
            )
        found = copy.noticed_by_ctest()
        if found:
            return f"ctest: {found}"
        if mutation.equivalent:
            return EQUIVALENT
        if native:
            return UNDECIDED
        found = copy.noticed_by_python(mutation.python)
        return f"Python: {found}" if found else SURVIVED
    finally:
        path.write_text(text)


def key(mutation: Mutation) -> str:
    return f"{mutation.file}: {mutation.breaks}"


def is_wanted(mutation: Mutation, words: list[str]) -> bool:
    return not words or any(word in key(mutation) for word in words)


def table(found: dict[str, str]) -> list[list[str]]:
    """A row for each mutation."""
    return [
        [m.file, m.breaks, re.sub(r"^(ctest|Python): ", "", found.get(key(m), "not run"))]
        for m in MUTATIONS
    ]


def save(path: Path, rows: list[list[str]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *rows])


def summary(found: dict[str, str]) -> Iterator[str]:
    """The rest of the page."""
    results = [found.get(key(m), "not run") for m in MUTATIONS]
    native = sum(result.startswith("ctest") for result in results)
    scripted = sum(result.startswith("Python") for result in results)
    yield f"{len(results)} mutations: {native} noticed by `ctest`, {scripted} more by the Python tests, "
    yield f"{results.count(EQUIVALENT)} equivalent, {results.count(SURVIVED)} survived"
    left = results.count("not run")
    yield f", {left} not run.\n" if left else ".\n"
    argued = [m for m in MUTATIONS if m.equivalent]
    if argued:
        yield "\nEquivalent, so that no test can notice them:\n\n"
    for mutation in argued:
        yield f"- `{mutation.file}`, {mutation.breaks}: {mutation.equivalent}\n"


def publish(found: dict[str, str]) -> None:
    head, mark, _ = PAGE.read_text().partition(MARK)
    if not mark:
        raise SystemExit(f"Expected the line {MARK!r} in {PAGE}, found none; put it back.")
    PAGE.write_text(head + mark + "\n" + "".join(summary(found)))
    save(TABLE, table(found))


def sweep(copy: Copy, words: list[str], results: Path, native: bool) -> None:
    copy.update()
    copy.configure()
    copy.must(*copy.compile(*TARGETS))
    first = copy.noticed_by_ctest()
    copy.must(not first, f"{first} fails")
    found = json.loads(results.read_text()) if results.exists() else {}
    for number, mutation in enumerate(MUTATIONS, 1):
        if not is_wanted(mutation, words) or key(mutation) in found:
            continue
        start = time.monotonic()
        result = outcome(copy, mutation, native)
        seconds = time.monotonic() - start
        print(f"{number:3} {seconds:4.0f} s  {key(mutation)}  ->  {result}", flush=True)
        if result != UNDECIDED:
            found[key(mutation)] = result
            results.write_text(json.dumps(found, indent=1))
    publish(found)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--folder", type=Path, help="where the copy is built; may exist")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument(
        "--native", action="store_true", help="leave what ctest does not notice for later"
    )
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--python", default=sys.executable, help="has NumPy, SciPy and pytest")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    wrong = problems()
    if wrong:
        raise SystemExit("\n".join(wrong))
    if options.check:
        return
    if not options.folder:
        parser.error("expected --folder, found none; say where to build, or --check")
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    results = folder / "results.json"
    if options.again:
        results.unlink(missing_ok=True)
    sweep(Copy(folder, options.python, options.jobs), options.only, results, options.native)


if __name__ == "__main__":
    main()
