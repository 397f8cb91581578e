# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of `build_addon.py test`, and which of them each tier runs.

A part is a function of the Blender. It returns nothing, or a remark for the summary; it raises Failure when something
does not hold, and Skip when a tool is missing.
"""

from __future__ import annotations

import functools
import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Callable, Optional

from tools.packaging import needs, pack, paths
from tools.packaging.blender import blender_python
from tools.packaging.modules import build_modules
from tools.packaging.terminal import (
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
TIMES = paths.BUILD / "test_times.json"
SHARES = 4  # one case in so many runs by default, of oracles and of long tests

# The scenes of the window that run by default: computing and undoing, Esc, undo of a running job, and a zip
# without a module.
SCENES = ("compute_drag_undo", "cancel_with_escape", "undo_while_running", "missing_module")

# Python tests that are quick and see most faults: exact proofs and brute force on small inputs, Qhull,
# invariance under threads, order and scale, samples, files, layers, packing.
QUICK_TESTS = (
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
    "test_build_addon.py",
    "test_parts.py",
    "test_matrix.py",
)


# Python tests that send every kind of input through every stage of the compiled module.
SANITIZED_TESTS = (
    "test_delaunay.py",
    "test_narrow_facets.py",
    "test_sides.py::test_sides_equal_brute_force",
    "test_metamorphic.py::test_thread_count_changes_no_byte",
    "test_polygon_edges.py",
    "test_bad_input.py",
)


# --- running them


def choose(tier: str, only: list[str]) -> dict[str, Part]:
    """The parts of a tier to run, in order; Failure for a name that is none of them."""
    parts = TIERS[tier]
    unknown = set(only) - set(parts)
    if unknown:
        raise Failure(
            f"Expected parts out of {', '.join(parts)}, found {', '.join(sorted(unknown))}"
        )
    return {name: part for name, part in parts.items() if not only or name in only}


def needed(tier: str) -> dict[str, str]:
    """The Debian packages that the parts use; `debootstrap` makes other Debians, which only root may."""
    if tier in ("fast", "test"):
        return needs.FAST if tier == "fast" else needs.TEST
    asked = {**needs.FULL, **(needs.ROOT_ALONE if os.geteuid() == 0 else {})}
    return {**asked, **needs.WINDOWS} if tier == "matrix" else asked


def run_parts(tier: str, parts: Mapping[str, Part], blender: Path) -> None:
    """Run all, also after a failure, and report how each went; Failure when one failed."""
    started = time.monotonic()
    results = {name: run_part(name, part, blender) for name, part in parts.items()}
    total = time.monotonic() - started
    write_times(tier, results, total)
    say(f"Summary after {total:.0f} s, also in {paths.shown(TIMES)}")
    for name, (verdict, seconds) in results.items():
        print(f"{name:<10} {seconds:6.0f} s  {verdict}")
    failed = [name for name, (verdict, _) in results.items() if verdict.startswith("FAILED")]
    if failed:
        raise Failure("failed: " + ", ".join(failed))
    print("all passed")


def write_times(tier: str, results: Mapping[str, tuple[str, float]], total: float) -> None:
    """Keep the seconds and the outcome of each part, for whoever wants to know where the minutes go."""
    parts = {
        name: {"seconds": round(seconds, 1), "verdict": verdict}
        for name, (verdict, seconds) in results.items()
    }
    record = {"tier": tier, "version": paths.full_version(), "share": share()}
    record.update({"cores": parallel_jobs(), "seconds": round(total, 1), "parts": parts})
    TIMES.parent.mkdir(exist_ok=True)
    TIMES.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


def share() -> str:
    """Which cases of the oracles run, such as 3/4: the commit's hash decides, so that successive commits take turns."""
    if not succeeds("git", "rev-parse", "HEAD"):
        return f"0/{SHARES}"
    return f"{int(output_of('git', 'rev-parse', 'HEAD')[:8], 16) % SHARES}/{SHARES}"


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


def build(blender: Path, local: bool = False, systems: Iterable[str] = ()) -> None:
    build_modules(blender, local, systems, tests=True)
    pack.pack(blender, local)


def native(blender: Path) -> None:
    run("ctest", "--preset", "release", "--parallel", parallel_jobs())


def python(blender: Path) -> str:
    """Everything without Blender but the slow tests, with one case in four of the oracles and of the long tests."""
    run_pytest(blender, "--share", share(), "tests/python")
    run_pytest(blender, "lab/tests/test_mutations.py")  # its texts follow the sources
    return f"cases {share()} of oracles and of long tests"


def all_python(blender: Path) -> None:
    run_pytest(blender, "--slow", "tests/python")


def lab(blender: Path) -> None:
    """The tests of the laboratory itself."""
    run_pytest(blender, "--slow", "lab/tests")


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


def addon(blender: Path, *options: str) -> None:
    """The tests inside Blender."""
    run_shared([*inside(blender), f"--durations={LONGEST}", *options], "addon")


def run_shared(words: list[str], name: str) -> None:
    """Run a command in as many processes as there are cores: each takes the next file or scene that is left."""
    logs = [paths.BUILD / f"{name}_{i}.log" for i in range(min(parallel_jobs(), 4))]
    with tempfile.TemporaryDirectory(prefix="medial_axis_claims_") as claims:
        codes = run_together([[*words, f"--claims={claims}"]] * len(logs), logs)
    for log in logs:
        print(log.read_text(encoding="utf-8", errors="replace"), flush=True)
    if any(codes):
        raise Failure("tests inside Blender failed; their output is above")


def run_together(commands: list[list[str]], logs: list[Path]) -> list[int]:
    """Run commands at the same time, each with its output to a file; returns their exit codes."""
    running = []
    for command, log in zip(commands, logs):
        print("$ " + " ".join(command), flush=True)
        with open(log, "wb") as output:
            running.append(
                subprocess.Popen(command, cwd=paths.ROOT, stdout=output, stderr=subprocess.STDOUT)
            )
    return [process.wait() for process in running]


def gui(blender: Path, scenes: tuple[str, ...] = ()) -> None:
    """Scenes in Blender's window: those named, or all."""
    for tool in ("Xvfb", "xdotool", "import"):
        if shutil.which(tool) is None:
            raise Skip(f"{tool} is not installed")
    run_shared([*inside(blender), "--gui", f"--keep={paths.BUILD / 'gui'}", *scenes], "gui")


def inside(blender: Path) -> list[str]:
    """The command that runs the tests of the installed zip inside Blender."""
    interpreter, _ = blender_python(blender)
    archive = pack.archive_for()
    if not archive.is_file():
        raise Failure(f"Expected {paths.shown(archive)}, found none; run the part build first")
    words = (interpreter, "tests/addon/run.py", "--zip", archive, "--blender", blender)
    return [str(word) for word in words]


def blenders(blender: Path) -> None:
    """The main things in every Blender that Debian has; the rest of the matrix takes longer."""
    run_matrix(blender, "--quick")


def matrix(blender: Path) -> None:
    run_matrix(blender, "--table", paths.ROOT / "docs" / "compatibility.md")


def run_matrix(blender: Path, *options: object) -> None:
    interpreter, _ = blender_python(blender)
    options = ("--blender", blender, "--keep", paths.BUILD / "matrix", *options)
    run(interpreter, "tests/matrix/run.py", pack.archive_for(), *options)


def asan(blender: Path) -> str:
    """A native test in four, for addresses and undefined behaviour, where the last commits changed C++."""
    if not any(
        name.endswith((".cpp", ".h")) for name in lint.changed_files("native", "tests/native")
    ):
        raise Skip("the last commits changed no C++; --full runs it always")
    index, _, count = share().partition("/")
    run_sanitized("asan", "-DMEDIAL_PYTHON=OFF", tests=("-I", f"{int(index) + 1},,{count}"))
    return f"turn {share()}"


def asan_and_module(blender: Path) -> None:
    """The native tests and some Python tests, for addresses and undefined behaviour."""
    interpreter, abi = blender_python(blender)
    run_sanitized("asan", "-DMEDIAL_PYTHON=ON", f"-DPython_EXECUTABLE={interpreter}")
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
    environment["MEDIAL_AXIS_STUDY"] = str(paths.BUILD / "asan")
    tests = [f"tests/python/{name}" for name in SANITIZED_TESTS]
    run_pytest(blender, *tests, MEDIAL_AXIS_PACKAGE=str(package), **environment)


def tsan(blender: Path) -> None:
    """The native tests, for what threads do to each other."""
    run_sanitized("tsan")


def run_sanitized(preset: str, *definitions: str, tests: tuple[str, ...] = ()) -> None:
    """The native tests under a sanitizer; without address randomisation, which older ones cannot live with."""
    library_of(preset)
    build_preset(preset, *definitions)
    fixed = ["setarch", os.uname().machine, "-R"]
    words = ["ctest", "--preset", preset, "--parallel", str(parallel_jobs()), *tests]
    run(*(fixed if succeeds(*fixed, "true") else []), *words)


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


# Whatever is left out of `test` is left out by a rule: the marker slow, all but one case in four of the marker oracle
# and of the tests of support/long_tests.txt, three of four native tests under AddressSanitizer, the scenes that are
# not in SCENES, the parts that only `full` has, and what looks at C++ where none has changed.
TIERS: dict[str, dict[str, Part]] = {
    "test": {
        "build": functools.partial(build, local=True),
        "lint": lint.lint,
        "native": native,
        "python": python,
        "addon": lambda blender: addon(blender, "--share", share()),
        "gui": functools.partial(gui, scenes=SCENES),
        "asan": asan,
    },
    "full": {
        "build": build,
        "lint": lint.full_lint,
        "native": native,
        "python": all_python,
        "lab": lab,
        "addon": lambda blender: addon(blender, "--slow"),
        "gui": gui,
        "blenders": blenders,
        "asan": asan_and_module,
        "tsan": tsan,
        "clang": clang,
    },
    "fast": {
        "build": functools.partial(build, local=True),
        "lint": lint.quick_lint,
        "native": native,
        "python": quick_python,
    },
    "matrix": {"build": functools.partial(build, systems=["windows"]), "matrix": matrix},
}
