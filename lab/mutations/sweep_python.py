# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes one small bug at a time in the Python of the core and says which test notices it.

    python3 lab/mutations/sweep_python.py --check            each text occurs once in the sources; takes no time
    python3 lab/mutations/sweep_python.py --folder FOLDER    all; the table goes into docs/lab/mutations_python.csv
    python3 lab/mutations/sweep_python.py --folder FOLDER --only batch/

The package is copied into FOLDER with its compiled module, so the checkout is not touched and nothing is compiled. The
tests are those that run by default, with --share for the cases of the oracles. Each file of tests that a mutation
names is asked on its own, up to the first failure, and that test has to pass without the bug. The results are kept as
in sweep.py.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from python_mutations import MUTATIONS, SOURCES
from sweep import MARK, PAGE, ROOT, SURVIVED, is_wanted, key, save

BEGIN = "<!-- The line up to the next comment is written by lab/mutations/sweep_python.py. -->\n"
TABLE = PAGE.with_name("mutations_python.csv")
PACKAGE = SOURCES.parent


def problems() -> list[str]:
    """Describe texts that do not occur once, and names that occur twice."""
    found = []
    for mutation in MUTATIONS:
        try:
            mutation.applied((ROOT / mutation.path).read_text())
        except (OSError, ValueError) as error:
            found.append(str(error))
    names = [key(m) for m in MUTATIONS]
    return found + [
        f"Expected one mutation {n!r}, found several."
        for n in sorted(set(names))
        if names.count(n) > 1
    ]


class Tests:
    """The tests of the checkout on a copy of the package."""

    def __init__(self, folder: Path, python: str, share: str) -> None:
        self.package = folder / PACKAGE.name
        self._command = [
            python,
            "-m",
            "pytest",
            "-q",
            "-x",
            "-p",
            "no:cacheprovider",
            "--share",
            share,
        ]
        shutil.copytree(
            ROOT / PACKAGE,
            self.package,
            dirs_exist_ok=True,
            ignore=shutil.ignore_patterns("__pycache__"),
        )

    def failure(self, names: list[str]) -> str:
        """The first test that fails; empty when none does."""
        environment = {
            **os.environ,
            "MEDIAL_AXIS_PACKAGE": str(self.package),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        for name in names:
            done = subprocess.run(
                [*self._command, f"tests/python/{name}"],
                cwd=ROOT,
                capture_output=True,
                text=True,
                env=environment,
            )
            if done.returncode:
                failed = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", done.stdout, re.MULTILINE)
                return (
                    failed[1].removeprefix("tests/python/") if failed else f"{name} (does not run)"
                )
        return ""


def table(found: dict[str, str]) -> list[list[str]]:
    """A row for each mutation."""
    return [[m.file, m.breaks, found.get(key(m), "not run")] for m in MUTATIONS]


def summary(found: dict[str, str]) -> str:
    results = [found.get(key(m), "not run") for m in MUTATIONS]
    survived, left = results.count(SURVIVED), results.count("not run")
    text = f"{len(results)} mutations of Python: {len(results) - survived - left} noticed, {survived} survived"
    return text + (f", {left} not run.\n" if left else ".\n")


def publish(found: dict[str, str]) -> None:
    head, begin, rest = PAGE.read_text().partition(BEGIN)
    _, mark, tail = rest.partition(MARK)
    if not (begin and mark):
        raise SystemExit(f"Expected the lines {BEGIN!r} and {MARK!r} in {PAGE}; put them back.")
    PAGE.write_text(f"{head}{begin}\n{summary(found)}\n{mark}{tail}")
    save(TABLE, table(found))


def sweep(tests: Tests, words: list[str], results: Path) -> None:
    found = json.loads(results.read_text()) if results.exists() else {}
    wanted = [m for m in MUTATIONS if is_wanted(m, words) and key(m) not in found]
    for mutation in wanted:
        path = tests.package.parent / mutation.path
        text = path.read_text()
        path.write_text(mutation.applied(text))
        try:
            failed = tests.failure(list(mutation.python))
        finally:
            path.write_text(text)
        if failed and tests.failure([failed]):
            raise SystemExit(
                f"Expected a test that passes without a bug, found {failed}; mend it first."
            )
        found[key(mutation)] = failed.partition("[")[0] or SURVIVED
        print(f"{key(mutation)}  ->  {found[key(mutation)]}", flush=True)
        results.write_text(json.dumps(found, indent=1))
    publish(found)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--folder", type=Path, help="where the copy lies; may exist")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--again", action="store_true", help="forget what was found before")
    parser.add_argument("--python", default=sys.executable, help="has NumPy, SciPy and pytest")
    parser.add_argument(
        "--share", default="0/4", help="the cases of the oracles that run, as by default"
    )
    options = parser.parse_args()
    if wrong := problems():
        raise SystemExit("\n".join(wrong))
    if options.check:
        return
    if not options.folder:
        parser.error("--folder is missing")
    options.folder.mkdir(parents=True, exist_ok=True)
    results = options.folder / "results_python.json"
    if options.again:
        results.unlink(missing_ok=True)
    sweep(Tests(options.folder, options.python, options.share), options.only, results)


if __name__ == "__main__":
    main()
