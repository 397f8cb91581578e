# SPDX-License-Identifier: GPL-3.0-or-later
"""The library for C++ from outside: public headers that compile alone, and a project that uses them both ways."""

import shutil
import subprocess
from pathlib import Path

import pytest
from support.package import ROOT

INCLUDE = ROOT / "native" / "include"
CONSUMER = ROOT / "tests" / "consumer"
# Headers by themselves are quick; what needs a build of the library waits for the same one.
LIBRARY = pytest.mark.xdist_group("consumer")
slow = pytest.mark.slow  # the project compiles the whole core, for more than a minute
HEADERS = sorted(path.relative_to(INCLUDE).as_posix() for path in INCLUDE.rglob("*.h"))


def finished(*words):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True)


def run(*words):
    done = finished(*words)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module", autouse=True)
def tools():
    for tool in ("cmake", "ninja", "g++"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed")


@pytest.mark.parametrize("header", HEADERS)
def test_public_header_compiles_alone(tmp_path, header):
    source = tmp_path / "alone.cpp"
    source.write_text(f"#include <{header}>\n#include <{header}>\nint main() {{}}\n")
    warnings = ("-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Wpedantic", "-Werror")
    run("g++", "-std=c++20", "-fsyntax-only", *warnings, f"-I{INCLUDE}", source)


@pytest.fixture(scope="module")
def with_sources(tmp_path_factory):
    """The build folder of the project that takes the sources as a part of itself; built once, for it compiles all."""
    folder = tmp_path_factory.mktemp("with_sources")
    configure(folder, f"-DMEDIAL_SOURCE={ROOT}", "-DMEDIAL_INSTALL=ON")
    run("cmake", "--build", folder, "--parallel", "2")
    return folder


@pytest.fixture(scope="module")
def installed(with_sources, tmp_path_factory):
    """Where the library is installed."""
    prefix = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", with_sources, "--prefix", prefix)
    return prefix


def configure(folder, *definitions):
    release = ("-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "-S", CONSUMER, "-B", folder, *release, *definitions)


@slow
@LIBRARY
def test_sources_as_a_part_of_another_project(with_sources):
    text = run(with_sources / "cube")
    assert ": 192 facets, largest ball 4\n" in text  # as in test_convergence.py
    assert text in (ROOT / "docs" / "libraries.md").read_text(encoding="utf-8")
    cache = (with_sources / "CMakeCache.txt").read_text()
    assert "MEDIAL_PYTHON:BOOL=OFF" in cache and "MEDIAL_TESTS:BOOL=OFF" in cache


@slow
@LIBRARY
def test_installed_library(with_sources, installed, tmp_path):
    """Found by its package; the same program."""
    configure(tmp_path, f"-DCMAKE_PREFIX_PATH={installed}")
    run("cmake", "--build", tmp_path)
    assert run(tmp_path / "cube") == run(with_sources / "cube")


@slow
@LIBRARY
def test_what_is_installed(installed):
    paths = [path for path in installed.rglob("*") if path.is_file()]
    files = {path.relative_to(installed).as_posix() for path in paths}
    headers = {f"include/{name}" for name in HEADERS}
    (library,) = {name for name in files if name.endswith("/libmedial.a")}
    folder = library.removesuffix("libmedial.a")
    package = {name for name in files if name.startswith(f"{folder}cmake/medial/")}
    kinds = ("config", "config-version", "targets", "targets-release")
    assert {Path(name).name for name in package} == {f"medial-{kind}.cmake" for kind in kinds}
    assert files == headers | package | {library, "share/licenses/medial/LICENSE"}
    texts = "".join((installed / name).read_text() for name in package)
    assert str(ROOT) not in texts, "nothing installed leads back to the sources"


@slow
@LIBRARY
def test_another_version_is_refused(installed, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
        "find_package(medial 99 CONFIG REQUIRED)\n"
    )
    folders = ("-S", tmp_path, "-B", tmp_path / "b", f"-DCMAKE_PREFIX_PATH={installed}")
    done = finished("cmake", *folders)
    assert done.returncode != 0 and '"99"' in done.stderr


def test_missing_headers_are_named(tmp_path):
    nowhere = ("-DCGAL_INCLUDE_DIR=CGAL_INCLUDE_DIR-NOTFOUND", "-DCMAKE_FIND_ROOT_PATH=/nowhere")
    only = ("-DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY", "-DMEDIAL_PYTHON=OFF", "-DMEDIAL_TESTS=OFF")
    done = finished("cmake", "-G", "Ninja", "-S", ROOT, "-B", tmp_path, *nowhere, *only)
    assert done.returncode != 0
    assert "Expected the headers of CGAL" in done.stderr and "libcgal-dev" in done.stderr
