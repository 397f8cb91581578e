# SPDX-License-Identifier: GPL-3.0-or-later
"""What `build_addon.py test` runs, part by part.

A part is a function of the Blender. It returns nothing, or a remark for the summary; it raises Failure when something
does not hold, and Skip when a tool is missing.
"""

from __future__ import annotations

import functools
import os
import shutil
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Callable, Optional

from native.packaging import needs, pack, paths
from native.packaging.blender import blender_python
from native.packaging.modules import build_modules
from native.packaging.terminal import (
    Failure,
    build_preset,
    output_of,
    parallel_jobs,
    run,
    say,
    succeeds,
)

from . import lint
from .lint import Skip

Part = Callable[[Path], Optional[str]]
LONGEST = 15  # tests that pytest names with their seconds

# Python tests that are quick and see most faults: oracles in rational arithmetic and by brute force on small inputs,
# Qhull, invariance under threads, order and scale, samples, files, layers, packing.
QUICK_TESTS = (
    "test_equality.py",
    "test_cocone.py::test_equals_brute_force",
    "test_delaunay.py",
    "test_sides.py::test_sides_equal_brute_force",
    "test_tight_cocone.py::test_topology_is_exact",
    "test_tight_cocone.py::test_grids",
    "test_metamorphic.py::test_thread_count_changes_no_byte",
    "test_metamorphic.py::test_permutation_permutes_ids",
    "test_metamorphic.py::test_scale_by_a_power_of_two_changes_no_bit",
    "test_metamorphic.py::test_rotation_changes_only_last_bits",
    "test_invariants.py",
    "test_blue_noise.py",
    "test_export.py",
    "test_import.py",
    "test_layers.py",
    "test_stub.py",
    "test_checklist.py",
    "test_build_addon.py",
    "test_manual.py",
    "test_manual_api.py",
    "test_parts.py",
    "test_matrix.py",
)


# Those that send every kind of input through every stage of the compiled module, from Python's arrays and back.
SANITIZED_TESTS = (
    "test_equality.py",
    "test_delaunay.py",
    "test_cocone.py::test_equals_brute_force",
    "test_sides.py::test_sides_equal_brute_force",
    "test_metamorphic.py::test_thread_count_changes_no_byte",
    "test_polygon_edges.py",
    "test_bad_input.py",
)


# --- running them


def choose(fast: bool, matrix: bool, only: list[str]) -> dict[str, Part]:
    """The parts to run, in order; Failure for a name that is none of them."""
    parts = FAST if fast else MATRIX if matrix else PARTS
    unknown = set(only) - set(parts)
    if unknown:
        raise Failure(
            f"Expected parts out of {', '.join(parts)}, found {', '.join(sorted(unknown))}"
        )
    return {name: part for name, part in parts.items() if not only or name in only}


def needed(fast: bool, matrix: bool) -> dict[str, str]:
    """The Debian packages that the parts use; `debootstrap` makes other Debians, which only root may."""
    if fast:
        return needs.FAST
    asked = needs.MATRIX if os.geteuid() == 0 else needs.TEST
    return {**asked, **needs.WINDOWS} if matrix else asked


def run_parts(parts: Mapping[str, Part], blender: Path) -> None:
    """Run all, also after a failure, and tell how each went; Failure when one failed."""
    started = time.monotonic()
    results = {name: run_part(name, part, blender) for name, part in parts.items()}
    say(f"Summary after {time.monotonic() - started:.0f} s")
    for name, (verdict, seconds) in results.items():
        print(f"{name:<10} {seconds:6.0f} s  {verdict}")
    failed = [name for name, (verdict, _) in results.items() if verdict.startswith("FAILED")]
    if failed:
        raise Failure("failed: " + ", ".join(failed))
    print("all passed")


def run_part(name: str, part: Part, blender: Path) -> tuple[str, float]:
    """The verdict on one part, and the seconds that it took."""
    say(f"Testing: {name}")
    started = time.monotonic()
    try:
        remark = part(blender)
        verdict = f"passed; {remark}" if remark else "passed"
    except Skip as reason:
        verdict = f"skipped: {reason}"
    except Failure as failure:
        verdict = f"FAILED: {failure}"
    print(verdict, flush=True)
    return verdict, time.monotonic() - started


# --- the parts


def build(blender: Path, **options: bool) -> None:
    build_modules(blender, **options)
    pack.pack(blender)


def native(blender: Path) -> None:
    run("ctest", "--preset", "release", "--parallel", parallel_jobs())


def python(blender: Path) -> None:
    run_pytest(blender, "--slow", "tests/python")


def quick_python(blender: Path) -> None:
    run_pytest(blender, *(f"tests/python/{name}" for name in QUICK_TESTS))


def run_pytest(blender: Path, *options: str, **environment: str) -> None:
    """pytest with the Python that Blender uses, on all cores where pytest-xdist is installed."""
    interpreter, _ = blender_python(blender)
    spread = succeeds(interpreter, "-c", "import xdist")
    workers = ["-n", parallel_jobs(), "--dist", "loadgroup"] if spread else []
    words = ["-q", f"--durations={LONGEST}", *workers, *options]
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment}
    run(interpreter, "-m", "pytest", *words, env=environment)


def addon(blender: Path) -> None:
    run_inside(blender, "--slow", f"--durations={LONGEST}")


def gui(blender: Path) -> None:
    for tool in ("Xvfb", "xdotool", "import"):
        if shutil.which(tool) is None:
            raise Skip(f"{tool} is not installed")
    run_inside(blender, "--gui", "--keep", paths.BUILD / "gui")


def run_inside(blender: Path, *options: object) -> None:
    """The tests of the installed zip inside Blender."""
    interpreter, _ = blender_python(blender)
    archive = pack.archive_for()
    run(interpreter, "tests/addon/run.py", "--zip", archive, "--blender", blender, *options)


def blenders(blender: Path) -> None:
    """The main things in every Blender that Debian has; the rest of the matrix takes longer."""
    run_matrix(blender, "--quick")


def matrix(blender: Path) -> None:
    run_matrix(blender, "--table", paths.ROOT / "docs" / "compatibility.md")


def run_matrix(blender: Path, *options: object) -> None:
    interpreter, _ = blender_python(blender)
    options = ("--blender", blender, "--keep", paths.BUILD / "matrix", *options)
    run(interpreter, "tests/matrix/run.py", pack.archive_for(), *options)


def asan(blender: Path) -> None:
    """The native tests and some Python tests, for addresses and undefined behaviour."""
    interpreter, abi = blender_python(blender)
    run_sanitized("asan", f"-DPython_EXECUTABLE={interpreter}")
    package = paths.BUILD / "asan" / "package"
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(paths.ADDON, package, ignore=shutil.ignore_patterns("lib", "__pycache__"))
    (package / "lib").mkdir()
    shutil.copy2(paths.BUILD / "asan" / f"_medial.{abi}.so", package / "lib")
    # The sanitizer has to be the first library of the process, and sees exceptions of C++ if their library comes
    # with it. What the interpreter itself never gives back is no leak of ours.
    first = " ".join(library_of(name) for name in ("asan", "stdc++"))
    environment = {"LD_PRELOAD": first, "ASAN_OPTIONS": "detect_leaks=0"}
    environment.update({"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1"})
    tests = [f"tests/python/{name}" for name in SANITIZED_TESTS]
    run_pytest(blender, *tests, MEDIAL_AXIS_PACKAGE=str(package), **environment)


def tsan(blender: Path) -> None:
    """The native tests, for what threads do to each other."""
    run_sanitized("tsan")


def run_sanitized(preset: str, *definitions: str) -> None:
    """The native tests under a sanitizer; without address randomisation, which older ones cannot live with."""
    library_of(preset)
    build_preset(preset, *definitions)
    fixed = ["setarch", os.uname().machine, "-R"]
    run(*(fixed if succeeds(*fixed, "true") else []), "ctest", "--preset", preset)


def library_of(name: str) -> str:
    """The path of a library of the compiler's."""
    path = output_of("g++", f"-print-file-name=lib{name}.so").strip()
    if not Path(path).is_absolute():
        raise Skip(f"the compiler has no lib{name}")
    return path


def clang(blender: Path) -> None:
    """The native tests, compiled by clang with its own standard library."""
    if shutil.which("clang++") is None:
        raise Skip("clang++ is not installed")
    build_preset("clang")
    run("ctest", "--preset", "clang", "--parallel", parallel_jobs())


PARTS: dict[str, Part] = {
    "build": build,
    "lint": lint.lint,
    "native": native,
    "python": python,
    "addon": addon,
    "gui": gui,
    "blenders": blenders,
    "asan": asan,
    "tsan": tsan,
    "clang": clang,
}
FAST: dict[str, Part] = {
    "build": functools.partial(build, local=True),
    "lint": lint.quick_lint,
    "native": native,
    "python": quick_python,
}
MATRIX: dict[str, Part] = {"build": functools.partial(build, windows=True), "matrix": matrix}
