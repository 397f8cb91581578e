#!/usr/bin/env python3
"""Builds, shows and tests the Medial Axis add-on.

    python3 build_addon.py build     compile the native modules, pack dist/medial_axis-VERSION.zip
    python3 build_addon.py demo      build, then compute and render real models in a real Blender
    python3 build_addon.py test      everything that must hold: native, Python and Blender tests, sanitizers
    python3 build_addon.py bench     what it costs beside the bare Delaunay triangulation, as tables
    python3 build_addon.py clean     remove what the other commands made

Any Python 3.8 or newer can run this file; it needs nothing but the standard library. The module itself is
built for, and tested with, the Python that Blender uses. Missing Debian packages are installed when this
user may (root, or sudo without a password); otherwise the apt-get line to run is printed.

Exit codes: 0 all went well, 1 something failed, 2 a tool or package is missing.
"""

from __future__ import annotations

import argparse
import html
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent
ADDON = ROOT / "blender_addon"
LIBRARY = ADDON / "lib"
BUILD = ROOT / "build"
DIST = ROOT / "dist"
PACKAGE = "medial_axis"  # the add-on's name inside Blender and the top folder of its zip
MODULES = "lib/_medial."  # how the names of compiled modules begin
# How they end, on each system, named as extensions.blender.org does.
PLATFORMS = {"linux-x64": ".so", "windows-x64": ".pyd"}

# What is needed -> the Debian package that brings it, by command.
BUILD_NEEDS = {
    "C++ compiler": "g++",
    "CMake": "cmake",
    "Ninja": "ninja-build",
    "CGAL headers": "libcgal-dev",
    "Boost headers": "libboost-dev",
    "pybind11 headers": "pybind11-dev",
    "Python headers": "python3-dev",
    "NumPy for Blender's Python": "python3-numpy",
    "Blender": "blender",
    "GoogleTest": "libgtest-dev",
}
DEMO_NEEDS = {
    "CGAL's demo meshes": "libcgal-demo",
    "software OpenGL": "libgl1-mesa-dri",
    "EGL, to draw without a display": "libegl1",
}
TEST_NEEDS = {
    **DEMO_NEEDS,
    "SciPy, the independent triangulation": "python3-scipy",
    "pytest": "python3-pytest",
    "virtual display": "xvfb",
    "X authority for xvfb-run": "xauth",
    "mouse and keyboard for the GUI tests": "xdotool",
    "screenshots": "imagemagick",
}
BENCH_NEEDS = {
    "SciPy, whose Qhull is measured, too": "python3-scipy",
    "virtual display": "xvfb",
    "software OpenGL": "libgl1-mesa-dri",
}

WINDOWS_NEEDS = {"compiler for Windows": "g++-mingw-w64-x86-64-posix"}
MATRIX_NEEDS = {**TEST_NEEDS, "Debian in a folder, by root alone": "debootstrap"}

# The Pythons of the Blenders that the zip is for, and the suite of Debian that has their headers; 3.10 is in none.
PYTHONS = {"3.10": "installed", "3.11": "bookworm", "3.13": "trixie", "3.14": "sid"}
WINDOWS_PYTHONS = {"3.11": "bookworm", "3.13": "trixie"}
ZIPPED_SUFFIXES = {".py", ".po", ".toml", ".so", ".pyd", ".png", ".svg", ".js", ".yaml"}


class Failure(Exception):
    """A step did not succeed; the message is for the person at the terminal."""

    def __init__(self, message: str, exit_code: int = 1) -> None:
        super().__init__(message)
        self.exit_code = exit_code


# --- talking and running


def say(text: str) -> None:
    print(
        f"\n== {text}" if sys.stdout.isatty() is False else f"\n\033[1m== {text}\033[0m", flush=True
    )


def run(*command: object, **options) -> None:
    """Run a command with its output shown; raise Failure when it fails."""
    words = [str(word) for word in command]
    print("$ " + " ".join(map(shlex.quote, words)), flush=True)
    code = subprocess.run(words, cwd=options.pop("cwd", ROOT), **options).returncode
    if code != 0:
        raise Failure(
            f"'{' '.join(words[:3])} ...' ended with exit code {code}; its output is above"
        )


def output_of(*command: object, **options) -> str:
    """The standard output of a command; raise Failure when it fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, **options)
    if done.returncode != 0:
        raise Failure(
            f"'{' '.join(words[:3])} ...' ended with exit code {done.returncode}: {done.stderr.strip()}"
        )
    return done.stdout


def use_system_python() -> None:
    """Debian's Blender takes its Python library from the first python3 on PATH: let that be the system's, also
    when a pyenv or virtual environment runs this script."""
    os.environ["PATH"] = "/usr/bin:" + os.environ.get("PATH", "/bin")
    for name in ("PYTHONHOME", "PYTHONPATH", "VIRTUAL_ENV"):
        os.environ.pop(name, None)


def parallel_jobs() -> int:
    """Compilers to run at once: one unit that includes CGAL takes up to 2 GB."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(len(os.sched_getaffinity(0)), memory // (2 << 30)))


# --- Debian packages


def is_installed(package: str) -> bool:
    query = ["dpkg-query", "-W", "-f", "${db:Status-Status}", package]
    return subprocess.run(query, capture_output=True, text=True).stdout.startswith("installed")


def require(needs: dict[str, str]) -> None:
    """Install the missing packages, or say how and stop with exit code 2."""
    if shutil.which("dpkg-query") is None:
        print(
            "This is no Debian system: nothing is installed; needed are " + ", ".join(needs) + "."
        )
        return
    missing = {name: package for name, package in needs.items() if not is_installed(package)}
    if not missing:
        return
    say("Missing: " + ", ".join(f"{name} ({package})" for name, package in missing.items()))
    install = ["apt-get", "install", "-y", "--no-install-recommends", *missing.values()]
    advice = "run  sudo apt-get update && sudo " + " ".join(install) + "  and start again"
    rights = administrator_prefix()
    if rights is None:
        raise Failure(
            "Debian packages are missing and this user may not install them: " + advice, 2
        )
    try:
        run(*rights, "apt-get", "update", "-q")
        run(*rights, "env", "DEBIAN_FRONTEND=noninteractive", *install)
    except Failure as failure:
        raise Failure(f"Installing Debian packages failed ({failure}): {advice}", 2) from None


def administrator_prefix() -> list[str] | None:
    """The words before a command that only root may run; None when this user may not."""
    if os.geteuid() == 0:
        return []
    if (
        shutil.which("sudo")
        and subprocess.run(["sudo", "-n", "true"], capture_output=True).returncode == 0
    ):
        return ["sudo", "-n"]
    return None


# --- Blender and its Python


def find_blender(name: str) -> Path:
    path = shutil.which(name)
    if path is None:
        raise Failure(
            f"Expected Blender as '{name}', found none; install it or pass --blender PATH", 2
        )
    return Path(path)


class Profile:
    """A private Blender profile: the person's own settings are neither read nor written."""

    def __init__(self, folder: Path) -> None:
        self.environment = {**os.environ, "HOME": str(folder)}
        for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES", "EXTENSIONS"):
            path = folder / part.lower()
            path.mkdir(parents=True, exist_ok=True)
            self.environment[f"BLENDER_USER_{part}"] = str(path)

    def command(self, blender: Path, *arguments: object) -> list[str]:
        quiet = ["--background", "--factory-startup", "--python-exit-code", "1"]
        return [str(blender), *quiet, *map(str, arguments)]


def blender_python(blender: Path) -> tuple[Path, str]:
    """The interpreter that Blender uses, with its ABI tag, such as cpython-311-x86_64-linux-gnu."""
    tell = "import sys, sysconfig, bpy; print('ABI', bpy.app.version_string.split()[0], '%d.%d' % sys.version_info[:2]"
    tell += ", sysconfig.get_config_var('SOABI'))"
    with tempfile.TemporaryDirectory() as folder:
        profile = Profile(Path(folder))
        text = output_of(*profile.command(blender, "--python-expr", tell), env=profile.environment)
    version, python_version, abi = re.search(
        r"^ABI (\S+) (\S+) (\S+)$", text, re.MULTILINE
    ).groups()
    python = Path(f"/usr/bin/python{python_version}")
    ask = "import sysconfig; print(sysconfig.get_config_var('SOABI'))"
    found = output_of(python, "-c", ask).strip() if python.exists() else "none"
    if found != abi:
        raise Failure(
            f"Blender {version} uses Python {abi}, but {python} is {found}; install python{python_version}-dev",
            2,
        )
    print(f"Blender {version} ({blender}) uses {python}, ABI {abi}")
    return python, abi


# --- building


def build_modules(blender: Path, local: bool = False, windows: bool = False) -> None:
    """Compile the release modules into blender_addon/lib: for Blender's own Python and, unless `local`, the others."""
    say("Building the native modules")
    python, abi = blender_python(blender)
    folders = {} if local else other_headers(abi)
    build_preset("release", f"-DPython_EXECUTABLE={python}", definition_of(folders))
    abis = [abi, *(re.sub(r"\d+", version.replace(".", ""), abi, count=1) for version in folders)]
    modules = [put_into_library(BUILD / "release" / f"_medial.{abi}.so") for abi in abis]
    modules += build_windows_modules() if windows else []
    for old in set(LIBRARY.glob("_medial.*")) - set(modules):
        old.unlink()
    checker = ROOT / "native" / "python" / "check_module.py"
    run(sys.executable, checker, *modules, *(["--local"] if local else []))
    print(output_of(python, "-c", IMPORT_MODULE, modules[0]).strip())


def build_windows_modules() -> list[Path]:
    """Compile those for Windows here."""
    folders = headers_of(WINDOWS_PYTHONS, BUILD / "python" / "windows", "--windows")
    build_preset("mingw", definition_of(folders))
    names = [f"_medial.cp{version.replace('.', '')}-win_amd64.pyd" for version in folders]
    return [put_into_library(BUILD / "mingw" / name, "x86_64-w64-mingw32-strip") for name in names]


def definition_of(folders: dict[str, Path]) -> str:
    return f"-DMEDIAL_PYTHON_HEADERS={';'.join(map(str, folders.values()))}"


def other_headers(abi: str) -> dict[str, Path]:
    """Folders with the headers of the Pythons that Blender here does not use."""
    others = {
        version: suite
        for version, suite in PYTHONS.items()
        if f"cpython-{version.replace('.', '')}-" not in abi
    }
    return headers_of(others, BUILD / "python")


def headers_of(pythons: dict[str, str], parent: Path, *options: str) -> dict[str, Path]:
    """Folders with headers, by version; those not to be had are named."""
    folders = {}
    script = ROOT / "native/python/headers.py"
    for version, suite in pythons.items():
        folder = parent / version
        fetch = [sys.executable, script, version, suite, folder, *options]
        done = subprocess.run(list(map(str, fetch)), capture_output=True, text=True)
        if done.returncode == 0:
            print(f"Python {version}: {', '.join(done.stdout.splitlines())}")
            folders[version] = folder
        else:
            print(f"No module for Python {version}: {done.stderr.strip()}")
    return folders


def put_into_library(built: Path, strip: str = "strip") -> Path:
    """Strip a module into blender_addon/lib; renamed at the end: a running Blender keeps the file that it has open."""
    if not built.exists():
        raise Failure(f"Expected {built.relative_to(ROOT)}, found none; run clean first")
    LIBRARY.mkdir(exist_ok=True)
    module = LIBRARY / built.name
    fresh = module.with_suffix(".new")
    run(strip, "--strip-unneeded", "-o", fresh, built)
    os.replace(fresh, module)
    return module


IMPORT_MODULE = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location("_medial", sys.argv[1])
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
print("imports as _medial", module.__version__)
"""


def build_preset(preset: str, *definitions: str) -> None:
    run("cmake", "--preset", preset, *definitions)
    run("cmake", "--build", "--preset", preset, "--parallel", parallel_jobs())


def version() -> str:
    """The one version number, from the manifest; `bl_info` must agree."""
    manifest = (ADDON / "blender_manifest.toml").read_text(encoding="utf-8")
    stated = re.search(r'^version = "(.+)"', manifest, re.MULTILINE).group(1)
    info = re.search(
        r'"version": \((.+?)\)', (ADDON / "__init__.py").read_text(encoding="utf-8")
    ).group(1)
    if stated.split("-")[0] != ".".join(part.strip() for part in info.split(",")):
        raise Failure(
            f"blender_manifest.toml says version {stated}, bl_info says ({info}); make them equal"
        )
    return stated


def pack() -> Path:
    """The zip that installs on Blender 3.4 (add-on) and 4.2 and newer (extension), and those for the extensions
    platform, which wants one per system and the files at its top. Same files, same bytes. Returns the first."""
    say("Packing the add-on")
    DIST.mkdir(exist_ok=True)
    files = {path.relative_to(ADDON).as_posix(): path for path in packed_files()}
    files["LICENSE"] = ROOT / "LICENSE"
    files |= manual_pages(BUILD)
    contents = {name: path.read_bytes() for name, path in files.items()}
    archive = archive_for()
    write_zip(archive, {f"{PACKAGE}/{name}": content for name, content in contents.items()})
    for platform in PLATFORMS:
        archive_for(platform).unlink(missing_ok=True)
        if own := for_platform(contents, platform):
            write_zip(archive_for(platform), own)
    abis = sorted(name.split(".")[1] for name in files if name.startswith(MODULES))
    print(f"{len(files)} files; compiled for {', '.join(abis) or 'no Python'}")
    return archive


def archive_for(platform: str = "") -> Path:
    """The zip for people, or one for the extensions platform, named as Blender names such."""
    return DIST / f"{PACKAGE}-{version()}{'-' * bool(platform)}{platform}.zip"


def for_platform(contents: dict[str, bytes], platform: str) -> dict[str, bytes]:
    """The files for one system, if there is a module for it; the manifest says for which, before its first table."""
    own = {
        name: content
        for name, content in contents.items()
        if not name.startswith(MODULES) or name.endswith(PLATFORMS[platform])
    }
    if not any(name.startswith(MODULES) for name in own):
        return {}
    line = f'platforms = ["{platform}"]\n\n['.encode()
    manifest = contents["blender_manifest.toml"].replace(b"\n[", b"\n" + line, 1)
    return own | {"blender_manifest.toml": manifest}


def write_zip(target: Path, contents: dict[str, bytes]) -> None:
    fresh = target.with_suffix(".new")
    with zipfile.ZipFile(fresh, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in sorted(contents.items()):
            entry = zipfile.ZipInfo(name)  # with the same date always
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
    os.replace(fresh, target)
    print(f"{target.relative_to(ROOT)}: {target.stat().st_size / 1e6:.1f} MB")


def manual_pages(folder: Path) -> dict[str, Path]:
    """docs/ as pages for the add-on, which every browser shows without a network."""
    pages = {}
    for page in sorted((ROOT / "docs").glob("*.md")):
        name = f"manual/{page.stem}.html"
        pages[name] = folder / name
        pages[name].parent.mkdir(parents=True, exist_ok=True)
        pages[name].write_text(manual_page(page.read_text(encoding="utf-8")), encoding="utf-8")
    return pages


def manual_page(markdown: str) -> str:
    """Markdown as people write it, with headings and links between pages that lead somewhere; no pictures."""
    parts = re.split(r"^```.*\n", html.escape(markdown, quote=False), flags=re.MULTILINE)
    for number, text in enumerate(parts):
        if number % 2:  # code
            parts[number] = f"<pre>{text}</pre>"
            continue
        text = re.sub(r"^(#+) (.+)$", heading, text, flags=re.MULTILINE)
        text = re.sub(r"!\[([^]]*)\]\([^)]+\)", "", text)
        text = re.sub(r"\[([^]]+)\]\(([\w.]*)\.md(#[\w-]+)?\)", r'<a href="\2.html\3">\1</a>', text)
        parts[number] = f"<div>{text}</div>"
    return MANUAL_PAGE.format("\n".join(parts))


def heading(found: re.Match) -> str:
    level, text = len(found[1]), found[2]
    name = re.sub(r"[^\w -]", "", text.lower()).replace(" ", "-")
    return f'<h{level} id="{name}">{text}</h{level}>'


MANUAL_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Medial Axis</title>
<style>body {{ max-width: 60em; margin: 2em auto; font-family: monospace }} div {{ white-space: pre-wrap }}</style>
</head><body>
{}
</body></html>
"""


def packed_files() -> list[Path]:
    """The add-on's files without caches, hidden files and leftovers."""
    return [
        path
        for path in ADDON.rglob("*")
        if path.is_file()
        and path.suffix in ZIPPED_SUFFIXES
        and not any(part.startswith((".", "__pycache__")) for part in path.relative_to(ADDON).parts)
    ]


def build(arguments: argparse.Namespace) -> None:
    require(BUILD_NEEDS | (WINDOWS_NEEDS if arguments.windows else {}))
    build_modules(find_blender(arguments.blender), arguments.local, arguments.windows)
    print(
        f"\nInstall in Blender: Edit > Preferences > Add-ons > Install..., choose {pack().relative_to(ROOT)}"
    )


# --- demo


def demo(arguments: argparse.Namespace) -> None:
    require({**BUILD_NEEDS, **DEMO_NEEDS})
    blender = find_blender(arguments.blender)
    meshes = [Path(mesh).resolve() for mesh in arguments.meshes]
    absent = [mesh for mesh in meshes if not mesh.is_file()]
    if absent:
        raise Failure(f"Expected mesh files, found no file {absent[0]}; check the path")
    build_modules(blender)
    archive = pack()
    output = Path(arguments.output).resolve()
    output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="medial_axis_demo_") as folder:
        models = [(mesh, []) for mesh in meshes] or demo_models(Path(folder))
        reports = [show_model(blender, archive, *model, output, Path(folder)) for model in models]
    print_table(reports)


def demo_models(folder: Path) -> list[tuple[Path | str, list[str]]]:
    """Blender's Suzanne, and a machine part of CGAL's demo data (CC0), each with options of the demo script."""
    member = "data/meshes/fandisk_large.off"
    package = Path("/usr/share/doc/libcgal-dev/data.tar.gz")
    if not package.exists():
        raise Failure(
            f"Expected CGAL's demo data at {package}, found none; name mesh files: demo PATH ..."
        )
    run("tar", "xzf", package, "-C", folder, member)
    fandisk = (folder / member).rename(folder / "fandisk.off")
    return [("suzanne", ["--subdivide", "3"]), (fandisk, ["--y-up"])]


def show_model(
    blender: Path, archive: Path, model: Path | str, extra: list[str], output: Path, folder: Path
) -> dict:
    """Compute and render one model in a Blender of its own; returns what it reports."""
    say(f"Medial axis of {model if isinstance(model, str) else model.name}")
    report = folder / "report.json"
    report.unlink(missing_ok=True)
    profile = Profile(folder / "profile")
    script = ROOT / "tests" / "demo" / "blender_demo.py"
    options = ["--zip", archive, "--model", model, *extra, "--output", output, "--report", report]
    run_rendering(profile.command(blender, "--python", script, "--", *options), profile.environment)
    return json.loads(report.read_text(encoding="utf-8"))


def run_rendering(command: list[str], environment: dict[str, str]) -> None:
    """As `run`, with Blender's many lines about a rendering as one line about every tenth part of it."""
    print("$ " + " ".join(map(shlex.quote, command)), flush=True)
    with subprocess.Popen(
        command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True
    ) as blender:
        told = ""
        for line in blender.stdout:
            samples = re.search(r"Sample (\d+)/(\d+)", line)
            part = f"{10 * int(samples[1]) // int(samples[2])}0 %" if samples else told
            if not line.startswith("Fra:"):
                print(line, end="", flush=True)
            elif part != told:
                told = part
                print(f"rendering, {part}", flush=True)
    if blender.returncode != 0:
        raise Failure(f"Blender ended with exit code {blender.returncode}; its output is above")


def print_table(reports: list[dict]) -> None:
    columns = list(reports[0])
    rows = [columns, *([str(report[column]) for column in columns] for report in reports)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(columns))]
    say("Results")
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


# --- test


def test(arguments: argparse.Namespace) -> None:
    needs = {**BUILD_NEEDS, **(MATRIX_NEEDS if os.geteuid() == 0 else TEST_NEEDS)}
    require(needs | (WINDOWS_NEEDS if arguments.matrix else {}))
    blender = find_blender(arguments.blender)
    parts = MATRIX_PARTS if arguments.matrix else PARTS
    unknown = set(arguments.only) - set(parts)
    if unknown:
        raise Failure(
            f"Expected parts out of {', '.join(parts)}, found {', '.join(sorted(unknown))}"
        )
    results = {}
    started = time.monotonic()
    for name, part in parts.items():
        if arguments.only and name not in arguments.only:
            continue
        results[name] = test_part(name, part, blender)
    say(f"Summary after {time.monotonic() - started:.0f} s")
    for name, (verdict, seconds) in results.items():
        print(f"{name:<10} {seconds:6.0f} s  {verdict}")
    failed = [name for name, (verdict, _) in results.items() if verdict.startswith("FAILED")]
    if failed:
        raise Failure("failed: " + ", ".join(failed))
    print("all passed")


class Skip(Exception):
    """A part of the tests cannot run here, for lack of a tool."""


def test_part(name: str, part, blender: Path) -> tuple[str, float]:
    say(f"Testing: {name}")
    started = time.monotonic()
    try:
        part(blender)
        verdict = "passed"
    except Skip as reason:
        verdict = f"skipped: {reason}"
    except Failure as failure:
        verdict = f"FAILED: {failure}"
    print(verdict, flush=True)
    return verdict, time.monotonic() - started


def test_build(blender: Path) -> None:
    build_modules(blender)
    pack()


def test_build_for_all(blender: Path) -> None:
    build_modules(blender, windows=True)
    pack()


def test_native(blender: Path) -> None:
    run("ctest", "--preset", "release", "--output-on-failure")


def test_python(blender: Path) -> None:
    python, _ = blender_python(blender)
    run(
        python,
        "-m",
        "pytest",
        "-q",
        "--slow",
        "tests/python",
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )


def test_addon(blender: Path) -> None:
    run_inside(blender, "--slow")


def test_gui(blender: Path) -> None:
    for tool in ("Xvfb", "xdotool", "import"):
        if shutil.which(tool) is None:
            raise Skip(f"{tool} is not installed")
    run_inside(blender, "--gui", "--keep", BUILD / "gui")


def run_inside(blender: Path, *options: object) -> None:
    """The tests of the installed zip inside Blender."""
    python, _ = blender_python(blender)
    archive = archive_for()
    run(python, "tests/addon/run.py", "--zip", archive, "--blender", blender, *options)


def test_blenders(blender: Path) -> None:
    """The main things in every Blender that Debian has; the rest of the matrix takes longer."""
    run_matrix(blender, "--quick")


def test_matrix(blender: Path) -> None:
    run_matrix(blender, "--table", ROOT / "docs" / "compatibility.md")


def run_matrix(blender: Path, *options: object) -> None:
    options = ("--blender", blender, "--keep", BUILD / "matrix", *options)
    run(sys.executable, "tests/matrix/run.py", archive_for(), *options)


def test_asan(blender: Path) -> None:
    test_sanitizer("asan")


def test_tsan(blender: Path) -> None:
    test_sanitizer("tsan")


def test_sanitizer(preset: str) -> None:
    """The native tests under a sanitizer; without address randomisation, which older ones cannot live with."""
    library = output_of("g++", f"-print-file-name=lib{preset}.so").strip()
    if not Path(library).is_absolute():
        raise Skip(f"the compiler has no lib{preset}")
    build_preset(preset)
    fixed = ["setarch", os.uname().machine, "-R"]
    can_fix = (
        shutil.which("setarch")
        and subprocess.run([*fixed, "true"], capture_output=True).returncode == 0
    )
    run(*(fixed if can_fix else []), "ctest", "--preset", preset, "--output-on-failure")


PARTS = {
    "build": test_build,
    "native": test_native,
    "python": test_python,
    "addon": test_addon,
    "gui": test_gui,
    "blenders": test_blenders,
    "asan": test_asan,
    "tsan": test_tsan,
}
MATRIX_PARTS = {"build": test_build_for_all, "matrix": test_matrix}


# --- bench


def bench(arguments: argparse.Namespace) -> None:
    require({**BUILD_NEEDS, **BENCH_NEEDS})
    blender = find_blender(arguments.blender)
    python, _ = blender_python(blender)
    build_modules(blender)
    run("cmake", "--build", "--preset", "release", "--target", "bare_triangulation")
    say("Measuring; leave the machine alone meanwhile")
    options = ["--bare", BUILD / "release/tests/benchmarks/bare_triangulation"]
    options += ["--largest", min(arguments.largest, 200_000 if arguments.quick else 10**9)]
    options += ["--repeats", 1 if arguments.quick else arguments.repeats]
    options += ["--blender", blender, "--output", Path(arguments.output).resolve()]
    options += ["--table", Path(arguments.table).resolve()] if arguments.table else []
    run(python, "tests/benchmarks/bench.py", *options, "--only", *arguments.only)


# --- clean


def clean(arguments: argparse.Namespace) -> None:
    """Remove what the other commands made; the results of the demo only with --all."""
    made = [
        BUILD,
        DIST,
        LIBRARY,
        *ROOT.rglob("__pycache__"),
        ROOT / ".pytest_cache",
        ROOT / ".ruff_cache",
    ]
    if arguments.all:
        made.append(ROOT / "demo_output")
    for path in filter(Path.exists, made):
        print(f"removing {path.relative_to(ROOT)}")
        shutil.rmtree(path)


# --- command line


def parse(words: list[str]) -> argparse.Namespace:
    formatter = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=formatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def add(name: str, action, text: str, more: str = "") -> argparse.ArgumentParser:
        command = commands.add_parser(
            name, help=text, description=f"{text}.\n\n{more}", formatter_class=formatter
        )
        command.set_defaults(action=action)
        return command

    add_build = add("build", build, "compile the native module and pack the add-on", BUILD_HELP)
    add_demo = add("demo", demo, "build, then compute and render real models in Blender", DEMO_HELP)
    add_demo.add_argument(
        "meshes", nargs="*", metavar="MESH", help="a .ply, .obj, .stl or .off file"
    )
    add_demo.add_argument(
        "--output", default="demo_output", metavar="FOLDER", help="default: ./demo_output"
    )
    add_test = add("test", test, "build and run every test", TEST_HELP)
    add_test.add_argument(
        "--only", nargs="+", default=[], metavar="PART", help=f"out of: {', '.join(PARTS)}"
    )
    add_test.add_argument(
        "--matrix", action="store_true", help="instead: all tests of the add-on in every Blender"
    )
    add_build.add_argument(
        "--local", action="store_true", help="for this machine's Blender alone; no network needed"
    )
    add_build.add_argument(
        "--windows", action="store_true", help="the modules for Windows, too, by mingw-w64"
    )
    add_bench = add("bench", bench, "measure beside the bare Delaunay triangulation", BENCH_HELP)
    add_bench.add_argument(
        "--quick", action="store_true", help="inputs of at most 200,000 points, once each"
    )
    add_bench.add_argument(
        "--largest", type=int, default=5_000_000, metavar="N", help="leave larger inputs out"
    )
    add_bench.add_argument(
        "--repeats", type=int, default=3, metavar="K", help="turns of each; default: 3"
    )
    add_bench.add_argument(
        "--only",
        nargs="+",
        default=[],
        metavar="WORD",
        help="inputs with such a word in their name",
    )
    add_bench.add_argument(
        "--output", default=BUILD / "bench", metavar="FOLDER", help="default: ./build/bench"
    )
    add_bench.add_argument(
        "--table", metavar="PAGE", help="put the tables into docs/performance.md, for instance"
    )
    for command in (add_build, add_demo, add_test, add_bench):
        command.add_argument(
            "--blender", default="blender", metavar="PATH", help="the Blender to build for"
        )
    add_clean = add("clean", clean, "remove what the other commands made")
    add_clean.add_argument("--all", action="store_true", help="the results of the demo as well")
    return parser.parse_args(words)


BUILD_HELP = f"""Compiles with the CMake preset `release` for the Python that Blender uses and, with headers from
Debian's packages, for {", ".join(PYTHONS)}; what cannot be had is left out by name. Debian has no Python 3.10: its
headers are those of a python3.10 of this machine.
Puts the modules into blender_addon/lib/,
checks that they need no library that Blender brings too and no newer system than others have, and packs
dist/medial_axis-VERSION.zip, which installs on Blender 3.4 and on 4.2 and newer, and
for the extensions platform one like it per system, such as dist/medial_axis-VERSION-linux-x64.zip. With --windows the
modules for Windows x64 and Python {" and ".join(WINDOWS_PYTHONS)} are compiled, too, by mingw-w64."""

DEMO_HELP = """Installs the zip into a private Blender profile, computes the medial axis of Blender's Suzanne and of a
mesh of Debian's libcgal-demo (or of the files you name), and leaves a .blend, .ply, .ma and a rendered
.png of each. Works without a display."""

TEST_HELP = f"""Parts, in order: {", ".join(PARTS)}. One failing part fails the whole; a part that cannot run for
lack of a tool is skipped by name. The parts after `build` use what `build` made.

--matrix builds for Windows, too, installs the zip into Blender 3.4, 4.3 and 5.2 of Debian 12, 13 and sid and into the
official bpy modules, runs the add-on's tests, windows and renderings in each, without Blender the Python tests in
Python 3.10, and writes docs/compatibility.md. Debian 13 and sid are made in build/blenders (or $MEDIAL_AXIS_BLENDERS),
which needs root; bpy for Windows needs wine, and mvn (Debian's maven) to get a Python for Windows. What cannot be had
is skipped by name."""

BENCH_HELP = """Builds, then measures CGAL's triangulation alone and the medial axis in turns, each in a process of
its own, on one thread and on all: random points on an ellipsoid (up to 5 million) and a torus, a noisy scan, and
meshes of the folder that MEDIAL_AXIS_TEST_DATA names. Beside them SciPy's Qhull and the published figure. Then the
operator in Blender, and what a change of a threshold costs there. Prints and writes bench.md and bench.json. About
half an hour; --quick takes some minutes."""


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
