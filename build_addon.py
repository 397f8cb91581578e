#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds, shows and tests the Medial Axis add-on.

    python3 build_addon.py build     compile the native modules, pack dist/medial_axis-VERSION.zip
    python3 build_addon.py pack      the same without compiling: the modules that lie in blender_addon/lib
    python3 build_addon.py repository    the built zips as a folder from which Blender installs and updates by URL
    python3 build_addon.py demo      build, then compute and render real models in a real Blender
    python3 build_addon.py test      what must hold before a change is taken, in about twenty minutes
    python3 build_addon.py test --full    everything, in about an hour and a half; --fast: the main things
    python3 build_addon.py bench     the cost compared with the bare Delaunay triangulation, as tables
    python3 build_addon.py race      how close it and others come to medial axes that are known exactly
    python3 build_addon.py clean     remove what the other commands made

Any Python 3.8 or newer can run this file; it needs nothing but the standard library. The module itself is
built for, and tested with, the Python that Blender uses. Missing Debian packages are installed when this
user may (root, or sudo without a password); otherwise the apt-get line to run is printed.

Exit codes: 0 all went well, 1 something failed, 2 a tool or package is missing.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # also when a test imports this file

from tests import parts
from tests.demo import show
from tools.packaging import modules, needs, other_systems, pack, paths
from tools.packaging import repository as repo
from tools.packaging.blender import blender_python, find_blender
from tools.packaging.terminal import Failure, run, say, use_system_python

# --- the commands


def build(arguments: argparse.Namespace) -> None:
    systems = [name for name in other_systems.BUILDERS if getattr(arguments, name)]
    needs.require(dict(needs.BUILD, **needs.of_systems(systems)))
    blender = find_blender(arguments.blender)
    modules.build_modules(blender, arguments.local, systems)
    archive = paths.shown(pack.pack(blender, arguments.local))
    print(f"\nInstall in Blender: Edit > Preferences > Add-ons > Install..., choose {archive}")


def pack_modules(arguments: argparse.Namespace) -> None:
    needs.require(needs.PACK)
    pack.pack(find_blender(arguments.blender), with_wheels=arguments.wheels)


def repository(arguments: argparse.Namespace) -> None:
    archives = repo.built()
    target = Path(arguments.output).resolve()
    rows = repo.make(archives, target, repo.newer_blender(arguments.blender))
    for row in rows:
        print(f"{row['platforms'][0]:14} {row['archive_size'] / 1e6:5.1f} MB   {row['version']}")
    print(
        f"\nPut {paths.shown(target)} on a web server. In Blender's preferences, under Get Extensions,"
    )
    print("people add a remote repository with the address of its index.json.")


def demo(arguments: argparse.Namespace) -> None:
    meshes = show.existing(arguments.meshes)
    needs.require_rights(needs.DEMO)
    needs.require(needs.CORE)
    with needs.required_meanwhile(needs.DEMO):  # Blender is large
        modules.build_core()
    blender = find_blender(arguments.blender)
    modules.build_modules(blender, local=True)
    archive = pack.pack(blender, local=True)
    show.show_models(blender, archive, meshes, Path(arguments.output).resolve())


def test(arguments: argparse.Namespace) -> None:
    tier = arguments.tier or "test"
    chosen = parts.choose(tier, arguments.only)
    needs.require(parts.needed(tier))
    parts.run_parts(tier, chosen, find_blender(arguments.blender))


def bench(arguments: argparse.Namespace) -> None:
    needs.require(needs.BENCH)
    blender = find_blender(arguments.blender)
    python, _ = blender_python(blender)
    modules.build_modules(blender, beside=["bare_triangulation"])
    say("Measuring; leave the machine alone meanwhile")
    options = ["--bare", paths.BUILD / "release/lab/benchmarks/bare_triangulation"]
    options += ["--largest", min(arguments.largest, 200_000 if arguments.quick else 10**9)]
    options += ["--repeats", 1 if arguments.quick else arguments.repeats]
    options += ["--blender", blender, "--output", Path(arguments.output).resolve()]
    options += ["--table", Path(arguments.table).resolve()] if arguments.table else []
    run(python, "lab/benchmarks/bench.py", *options, "--only", *arguments.only)


def race(arguments: argparse.Namespace) -> None:
    needs.require(needs.RACE)
    blender = find_blender(arguments.blender)
    python, _ = blender_python(blender)
    modules.build_modules(blender, beside=["_medial_study"])
    page = Path(arguments.page).resolve()
    run(python, "-m", "lab.race", "--sizes", *arguments.sizes, "--page", page)


def clean(arguments: argparse.Namespace) -> None:
    """Remove what the other commands made; the results of the demo only with --all."""
    made = [paths.BUILD, paths.DIST, paths.LIBRARY, *paths.ROOT.rglob("__pycache__")]
    made += [paths.ROOT / f".{tool}_cache" for tool in ("pytest", "ruff", "mypy")]
    made += [paths.ROOT / "demo_output"] if arguments.all else []
    for path in filter(Path.exists, made):
        print(f"removing {paths.shown(path)}")
        shutil.rmtree(path)


# --- the command line

BUILD_HELP = f"""Compiles with the CMake preset `release` for the Python that Blender uses and, with headers from
Debian's packages, for {", ".join(modules.PYTHONS)}; what cannot be had is left out by name. Puts the modules into
blender_addon/lib/, checks that they need no library that Blender brings too and no newer system than others have, and
packs dist/medial_axis-VERSION.zip, which installs on Blender 3.4 and on 4.2 and newer, and for the extensions platform
one like it per system, such as dist/medial_axis-VERSION-linux-x64.zip. With --windows the modules for Windows x64 and
Python {" and ".join(other_systems.WINDOWS_PYTHONS)} are compiled, too, by mingw-w64; with --macos those for Macs,
and with --linux-arm64 those for Linux on arm64, both by zig, which comes from Python's package index into build/zig. A
build of a commit that is not the tag of a release carries the commit in its version: VERSION+g1a2b3c4d."""

PACK_HELP = """Makes the zips of `build` from the modules that lie in blender_addon/lib, which may come from other
machines: one zip for all systems, and for the extensions platform one for each system that has a module. With --wheels
dist/wheels gets the library for Python as a wheel per module, and zips for Blender 4.2 and newer with wheels inside."""

REPOSITORY_HELP = """Copies the zips for the extensions platform, which `build` made, into a folder, and lets a Blender
of 4.2 or newer write index.json and index.html beside them. The folder is for any web server. Without such a Blender
on this machine, one in build/blenders (or $MEDIAL_AXIS_BLENDERS) is used."""

DEMO_HELP = """Compiles for this machine's Blender, while missing packages are installed; installs the zip into a
private Blender profile, computes the medial axis of Blender's Suzanne and of a bracket with sharp edges (or of the
files you name), and leaves a .blend, .ply, .ma and a rendered .png of each. Works without a display."""

TEST_HELP = f"""Parts, in order: {", ".join(parts.TIERS["test"])}. One failing part fails the whole; a part that cannot
run for lack of a tool is skipped by name. The parts after `build` use what `build` made. Of the oracles, which compare
results with independent ones over many seeds, one case in four runs: which, the commit's hash says. The time of each
part goes to build/test_times.json.

--full runs everything, in these parts: {", ".join(parts.TIERS["full"])}.

--fast is for while one works: {", ".join(parts.TIERS["fast"])}, without the long inputs.

--matrix builds for Windows, too, installs the zip into Blender 3.4, 4.3 and 5.2 of Debian 12, 13 and sid and into the
official bpy modules, runs the add-on's tests, windows and renderings in each, and writes docs/compatibility.md.
Debian 13 and sid are made in build/blenders (or $MEDIAL_AXIS_BLENDERS), which needs root; bpy for Windows needs wine,
and mvn (Debian's maven) to get a Python for Windows. What cannot be had is skipped by name."""

BENCH_HELP = """Builds, then measures CGAL's triangulation alone and the medial axis in turns, each in a process of
its own, on one thread and on all: random points on an ellipsoid (up to 5 million) and a torus, a noisy scan, and
meshes of the folder that MEDIAL_AXIS_TEST_DATA names. Beside them SciPy's Qhull and the published figure. Then the
operator in Blender, and what a change of a threshold costs there. Prints and writes bench.md and bench.json. About
half an hour; --quick takes some minutes."""


RACE_HELP = """Builds, then runs every program of lab/race/recipes.toml that is on this machine on samples
of solids whose medial axes are known exactly, and writes the tables and plots of docs/lab/benchmark.md."""


def parse(words: list[str]) -> argparse.Namespace:
    formatter = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=formatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def add(action, text: str, more: str = "", name: str = "") -> argparse.ArgumentParser:
        description = f"{text}.\n\n{more}"
        name = name or action.__name__
        command = commands.add_parser(
            name, help=text, description=description, formatter_class=formatter
        )
        command.set_defaults(action=action)
        return command

    add_build_options(add(build, "compile the native modules and pack the add-on", BUILD_HELP))
    packing = add(pack_modules, "pack the modules that lie in blender_addon/lib", PACK_HELP, "pack")
    packing.add_argument("--wheels", action="store_true", help="wheels and zips of them, too")
    publishing = add(repository, "the built zips for a web server", REPOSITORY_HELP)
    output = {"default": paths.DIST / "repository", "metavar": "FOLDER"}
    publishing.add_argument("--output", **output, help="default: ./dist/repository")
    add_demo_options(add(demo, "build, then compute and render real models in Blender", DEMO_HELP))
    add_test_options(add(test, "build and run every test", TEST_HELP))
    add_bench_options(
        add(bench, "measure the cost against the bare Delaunay triangulation", BENCH_HELP)
    )
    racing = add(race, "run against others on exact axes", RACE_HELP)
    sizes = {"type": int, "nargs": "+", "default": [2000, 8000, 20_000], "metavar": "N"}
    racing.add_argument("--sizes", **sizes, help="samples; default: 2000 8000 20000")
    page = {"default": paths.ROOT / "docs" / "lab" / "benchmark.md"}
    racing.add_argument("--page", **page, help="default: docs/lab/benchmark.md")
    cleaning = add(clean, "remove what the other commands made")
    cleaning.add_argument("--all", action="store_true", help="the results of the demo as well")
    for name in ("build", "pack", "repository", "demo", "test", "bench", "race"):
        commands.choices[name].add_argument(
            "--blender", default="blender", metavar="PATH", help="the Blender to build for"
        )
    return parser.parse_args(words)


def add_build_options(command: argparse.ArgumentParser) -> None:
    flag = {"action": "store_true"}
    command.add_argument("--local", **flag, help="for this machine's Blender; needs no network")
    command.add_argument("--windows", **flag, help="modules for Windows, too, by mingw-w64")
    command.add_argument("--macos", **flag, help="modules for Macs, too, by zig; never run on one")
    command.add_argument("--linux-arm64", **flag, help="modules for Linux on arm64, too, by zig")


def add_demo_options(command: argparse.ArgumentParser) -> None:
    meshes = {"nargs": "*", "metavar": "MESH"}
    command.add_argument("meshes", **meshes, help="a .ply, .obj, .stl or .off file")
    output = {"default": "demo_output", "metavar": "FOLDER"}
    command.add_argument("--output", **output, help="default: ./demo_output")


def add_test_options(command: argparse.ArgumentParser) -> None:
    only = {"nargs": "+", "default": [], "metavar": "PART"}
    command.add_argument("--only", **only, help="some of the parts")
    kind = command.add_mutually_exclusive_group()
    for tier, text in (
        ("fast", "the main things: six minutes the first time, then two"),
        ("full", "everything, all cases and sanitizers: an hour and a half"),
        ("matrix", "instead: the zip in every Blender"),
    ):
        kind.add_argument(f"--{tier}", dest="tier", action="store_const", const=tier, help=text)


def add_bench_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--quick", action="store_true", help="up to 200,000 points, once each")
    number = {"type": int}
    largest = {**number, "default": 5_000_000, "metavar": "N"}
    command.add_argument("--largest", **largest, help="leave larger inputs out")
    repeats = {**number, "default": 3, "metavar": "K"}
    command.add_argument("--repeats", **repeats, help="turns of each; default: 3")
    only = {"nargs": "+", "default": [], "metavar": "WORD"}
    command.add_argument("--only", **only, help="inputs with such a word in their name")
    output = {"default": paths.BUILD / "bench", "metavar": "FOLDER"}
    command.add_argument("--output", **output, help="default: ./build/bench")
    command.add_argument("--table", metavar="PAGE", help="the page that gets the tables")


def main(words: list[str]) -> int:
    arguments = parse(words)
    use_system_python()
    try:
        arguments.action(arguments)
    except Failure as failure:
        print(f"\nbuild_addon.py {arguments.command}: {failure}", file=sys.stderr, flush=True)
        return failure.exit_code
    except KeyboardInterrupt:
        print("\ninterrupted", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
