#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fuzzes, ten times as long as in every run of the tests; once before a release: python3 tests/fuzz.py [times].

Prints a table of how many inputs each had, how many of its tests failed and the processor time, for the docs.
"""

import os
import resource
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parents[1]
# Each row: the file, its tests, and how many inputs one of them tries.
FUZZES = {
    "polygons on few places": ("test_polygon_triangles.py", "fuzzed_polygons", 100),
    "simple polygons": ("test_polygon_triangles.py", "fuzzed_simple", 1),
    "thin plates": ("test_walls.py", "fuzzed_plates", 1),
    "narrow facets": ("test_narrow_facets.py", "fuzzed_boxes", 1),
    "scales and offsets": ("test_extreme_coordinates.py", "fuzzed_scales", 1),
    "signals": ("test_batch_faults.py", "fuzzed_signals", 1),
    "names of outputs": ("test_fuzzed_outputs.py", "fuzzed_outputs", 3),
    "broken files": ("test_broken_files.py", "fuzzed_files", 50),
}


def main(times: int) -> int:
    environment = {**os.environ, "MEDIAL_AXIS_FUZZ_TIMES": str(times)}
    print("| class | inputs | failed | processor time |\n|---|---|---|---|", flush=True)
    failed = 0
    for name, (file, word, inputs) in FUZZES.items():
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with TemporaryDirectory() as folder:
            report = Path(folder) / "report.xml"
            command = [sys.executable, "-m", "pytest", "-q", f"tests/python/{file}", "-k", word]
            subprocess.run(
                [*command, f"--junitxml={report}"],
                cwd=ROOT,
                env=environment,
                stdout=subprocess.DEVNULL,
                check=False,
            )
            suite = ElementTree.parse(report).find(".//testsuite")
        assert suite is not None
        wrong = int(suite.get("failures", 0)) + int(suite.get("errors", 0))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        tried = inputs * int(suite.get("tests", 0))
        print(f"| {name} | {tried:,} | {wrong} | {spent:,.0f} s |", flush=True)
        failed += wrong
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 10))
