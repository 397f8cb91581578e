"""build_addon.py: what it asks for, what it packs, what it refuses."""

import importlib.util
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def module_of(path):
    """A script of this repository as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def script(monkeypatch):
    """build_addon.py, with an environment that it may change."""
    monkeypatch.setenv("PATH", os.environ["PATH"])
    return module_of(ROOT / "build_addon.py")


@pytest.fixture
def sources(script, tmp_path, monkeypatch):
    """A tiny add-on in place of the real one."""
    addon = tmp_path / "blender_addon"
    for name in (
        "__init__.py",
        "core/a.py",
        "lib/_medial.cpython-311-x86_64-linux-gnu.so",
        "blender_manifest.toml",
    ):
        (addon / name).parent.mkdir(parents=True, exist_ok=True)
        (addon / name).write_text(f"content of {name}", encoding="utf-8")
    (addon / "__init__.py").write_text('bl_info = {"version": (1, 2, 3)}\n', encoding="utf-8")
    manifest = 'version = "1.2.3"\n\n[permissions]\n'
    (addon / "blender_manifest.toml").write_text(manifest, encoding="utf-8")
    (tmp_path / "LICENSE").write_text("licence", encoding="utf-8")
    for name, path in {"ROOT": tmp_path, "ADDON": addon, "DIST": tmp_path / "dist"}.items():
        monkeypatch.setattr(script, name, path)
    return addon


@pytest.mark.parametrize("command", ["", "build", "demo", "test", "bench", "clean"])
def test_help_is_there(command):
    words = [sys.executable, str(ROOT / "build_addon.py"), *command.split(), "--help"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith("usage:") and "--help" in done.stdout


def test_missing_packages_without_rights_name_the_command_and_exit_2(script, monkeypatch, capsys):
    monkeypatch.setattr(script.shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(
        script, "is_installed", lambda package: package not in ("cmake", "libcgal-dev")
    )
    monkeypatch.setattr(script, "administrator_prefix", lambda: None)
    assert script.main(["build"]) == 2
    advice = (
        "sudo apt-get update && sudo apt-get install -y --no-install-recommends cmake libcgal-dev"
    )
    assert advice in capsys.readouterr().err


def test_missing_packages_with_rights_are_installed(script, monkeypatch):
    commands = []
    monkeypatch.setattr(script.shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(script, "is_installed", lambda package: package != "xvfb")
    monkeypatch.setattr(script, "administrator_prefix", lambda: ["sudo", "-n"])
    monkeypatch.setattr(script, "run", lambda *words: commands.append(" ".join(words)))
    script.require(script.TEST_NEEDS)
    assert commands == [
        "sudo -n apt-get update -q",
        "sudo -n env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends xvfb",
    ]


def test_nothing_missing_runs_nothing(script, monkeypatch):
    monkeypatch.setattr(script, "is_installed", lambda package: True)
    monkeypatch.setattr(script, "run", lambda *words: pytest.fail("ran " + " ".join(words)))
    script.require(script.BUILD_NEEDS)


def test_missing_blender_exits_2(script, monkeypatch):
    monkeypatch.setattr(script, "require", lambda needs: None)
    assert script.main(["build", "--blender", "no-such-blender"]) == 2


def test_zip_holds_what_is_needed_and_nothing_else(script, sources):
    for extra in (
        "core/__pycache__/a.cpython-311.pyc",
        ".hidden/b.py",
        "core/.c.py",
        "core/notes.txt",
        "lib/_medial.new",
    ):
        (sources / extra).parent.mkdir(parents=True, exist_ok=True)
        (sources / extra).write_text("not wanted", encoding="utf-8")
    target = script.pack()
    assert target.name == "medial_axis-1.2.3.zip"
    assert sorted(zipfile.ZipFile(target).namelist()) == [
        "medial_axis/LICENSE",
        "medial_axis/__init__.py",
        "medial_axis/blender_manifest.toml",
        "medial_axis/core/a.py",
        "medial_axis/lib/_medial.cpython-311-x86_64-linux-gnu.so",
    ]


def test_zip_for_the_platform_has_no_folder_and_says_what_it_is_for(script, sources):
    first = script.pack()
    target = first.with_name("medial_axis-1.2.3-linux-x64.zip")
    with zipfile.ZipFile(first) as ours, zipfile.ZipFile(target) as platform:
        names = platform.namelist()
        assert [f"medial_axis/{name}" for name in names] == ours.namelist()
        manifest = platform.read("blender_manifest.toml").decode()
        assert manifest == 'version = "1.2.3"\n\nplatforms = ["linux-x64"]\n\n[permissions]\n'
        for name in set(names) - {"blender_manifest.toml"}:
            assert platform.read(name) == ours.read(f"medial_axis/{name}")


def test_modules_for_windows_are_in_the_zip_for_people_and_have_one_of_their_own(script, sources):
    (sources / "lib" / "_medial.cp311-win_amd64.pyd").write_text("for Windows")
    first = script.pack()
    modules = {
        system: [
            name.rpartition("/")[2]
            for name in zipfile.ZipFile(
                first.with_name(f"medial_axis-1.2.3{system}.zip")
            ).namelist()
            if "_medial" in name
        ]
        for system in ("", "-linux-x64", "-windows-x64")
    }
    linux, windows = "_medial.cpython-311-x86_64-linux-gnu.so", "_medial.cp311-win_amd64.pyd"
    assert modules == {"": [windows, linux], "-linux-x64": [linux], "-windows-x64": [windows]}
    (sources / "lib" / windows).unlink()
    script.pack()
    assert not first.with_name("medial_axis-1.2.3-windows-x64.zip").exists(), "nothing old is left"


def test_same_sources_same_zip(script, sources):
    first = script.pack().read_bytes()
    for path in sources.rglob("*.py"):
        os.utime(path, (0, 0))
    assert script.pack().read_bytes() == first


def test_versions_must_agree(script, sources):
    (sources / "blender_manifest.toml").write_text('version = "1.2.4"\n', encoding="utf-8")
    with pytest.raises(script.Failure, match=r"1\.2\.4.*1, 2, 3"):
        script.pack()


def test_real_versions_agree(script):
    """Manifest and bl_info by the script itself; the newest heading of the changelog; the compiled modules."""
    version = script.version()
    assert version.count(".") == 2
    changelog = (ROOT / "docs" / "changelog.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\S+)", changelog, re.MULTILINE)[0] == version
    modules = sorted(script.LIBRARY.glob("_medial.*.so"))
    assert modules and all(version.encode() in module.read_bytes() for module in modules)


def test_python_whose_headers_cannot_be_had_is_named(script, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(script, "BUILD", tmp_path)
    monkeypatch.setattr(script, "PYTHONS", {"3.11": "bookworm", "3.99": "no-such-suite"})
    monkeypatch.setenv("PATH", str(tmp_path))  # no apt-get
    assert script.other_headers("cpython-311-x86_64-linux-gnu") == {}
    out = capsys.readouterr().out
    assert out == "No module for Python 3.99: expected apt-get, found none\n"


def test_headers_that_are_there_are_used_without_a_network(script, tmp_path, monkeypatch, capsys):
    folder = tmp_path / "python" / "3.13"
    folder.mkdir(parents=True)
    (folder / "packages.txt").write_text("libpython3.13-dev 1\npybind11-dev 2\n")
    monkeypatch.setattr(script, "BUILD", tmp_path)
    monkeypatch.setattr(script, "PYTHONS", {"3.13": "trixie"})
    monkeypatch.setenv("PATH", str(tmp_path))
    assert script.other_headers("cpython-311-x86_64-linux-gnu") == {"3.13": folder}
    assert capsys.readouterr().out == "Python 3.13: libpython3.13-dev 1, pybind11-dev 2\n"


@pytest.mark.parametrize("there", [True, False])
def test_headers_of_a_python_that_no_debian_has_are_of_this_machine(
    script, tmp_path, monkeypatch, capsys, there
):
    """A stand-in for Python 9.9, which has one header and its configuration apart, as Debian's Pythons have."""
    include, config = tmp_path / "include", tmp_path / "apart" / "pyconfig.h"
    for path in (include / "Python.h", config):
        path.parent.mkdir()
        path.write_text(path.name)
    if there:
        (tmp_path / "python9.9").write_text(f"#!/bin/sh\necho {include} {config} 9.9.1\n")
        (tmp_path / "python9.9").chmod(0o755)
    monkeypatch.setattr(script, "BUILD", tmp_path)
    monkeypatch.setattr(script, "PYTHONS", {"9.9": "installed"})
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    folder = tmp_path / "python" / "9.9"
    assert script.other_headers("cpython-311-x86_64-linux-gnu") == (
        {"9.9": folder} if there else {}
    )
    out = capsys.readouterr().out
    if there:
        assert out == f"Python 9.9: that of {tmp_path}, 9.9.1\n"
        found = sorted(path.name for path in (folder / "python9.9").iterdir())
        assert found == ["Python.h", "pyconfig.h"]
    else:
        assert out.startswith("No module for Python 9.9: expected a python9.9 with its headers")
        assert not folder.exists()


def compile_library(folder, source, *options):
    """A shared library of one C++ source."""
    target = folder / "_medial.so"
    (folder / "a.cpp").write_text(source, encoding="utf-8")
    subprocess.run(
        ["g++", "-shared", "-fPIC", "-o", target, folder / "a.cpp", *options], check=True
    )
    return target


GOOD = 'extern "C" __attribute__((visibility("default"))) int PyInit__medial() { return 0; }\n'


@pytest.fixture
def checker():
    return module_of(ROOT / "native" / "python" / "check_module.py")


def test_module_that_exports_one_symbol_passes(checker, tmp_path):
    (_, text) = checker.check(compile_library(tmp_path, GOOD))
    assert "exports PyInit__medial only" in text


def test_module_that_exports_more_is_refused(checker, tmp_path):
    module = compile_library(tmp_path, GOOD + 'extern "C" int other() { return 1; }\n')
    with pytest.raises(SystemExit, match="PyInit__medial only, found 2"):
        checker.check(module)


WINDOWS_MODULE = """
\tDLL Name: python311.dll
\tDLL Name: KERNEL32.dll

[Ordinal/Name Pointer] Table
\t[   0] PyInit__medial

The Function Table
"""


@pytest.mark.parametrize(
    "change, told",
    [
        (("", ""), None),
        (("python311", "python313"), "must need python311.dll and what every Windows has"),
        (("KERNEL32.dll", "libstdc++-6.dll"), "must need python311.dll and what every Windows has"),
        (("PyInit__medial", "main"), "must export PyInit__medial only, found 1: .'main'"),
        (("medial\n\n", "medial\n\t[   1] other\n\n"), "must export PyInit__medial only, found 2"),
    ],
)
def test_module_for_windows_needs_python_and_windows_alone(
    checker, tmp_path, monkeypatch, change, told
):
    module = tmp_path / "_medial.cp311-win_amd64.pyd"
    module.write_bytes(b"123")
    monkeypatch.setattr(checker, "output", lambda *words: WINDOWS_MODULE.replace(*change))
    if told is None:
        assert checker.check(module)[0].endswith("needs python311.dll, KERNEL32.dll")
    else:
        with pytest.raises(SystemExit, match=told):
            checker.check(module)


@pytest.fixture
def for_windows(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "native" / "python"))
    return module_of(ROOT / "native" / "python" / "headers_for_windows.py")


def test_headers_for_windows_have_its_configuration(for_windows, tmp_path):
    names = (
        "Include/Python.h",
        "Include/cpython/a.h",
        "PC/pyconfig.h.in",
        "Modules/b.h",
        "pyconfig.h",
    )
    with tarfile.open(tmp_path / "source.tar", "w") as archive:
        for name in names:
            (tmp_path / "file").write_text(name)
            archive.add(tmp_path / "file", f"Python-3.13.5/{name}")
    for_windows.unpack_headers(tmp_path / "source.tar", tmp_path / "headers")
    found = sorted(
        str(path.relative_to(tmp_path / "headers"))
        for path in (tmp_path / "headers").rglob("*")
        if path.is_file()
    )
    assert found == ["Python.h", "cpython/a.h", "pyconfig.h"]
    assert (tmp_path / "headers/pyconfig.h").read_text() == "PC/pyconfig.h.in"


def test_import_library_has_the_names_of_python_and_knows_data(for_windows, tmp_path, monkeypatch):
    source = 'extern "C" { int PyInit(){return 0;} int _PyOther(){return 0;} int PyExc_A = 1; int other; }'
    monkeypatch.setattr(for_windows, "DLLTOOL", "true")  # it may not be installed
    for_windows.make_import_library(compile_library(tmp_path, source), "python399", tmp_path)
    text = (tmp_path / "python399.def").read_text().splitlines()
    assert text[:2] == ["LIBRARY python399.dll", "EXPORTS"]
    assert sorted(text[2:]) == ["PyExc_A DATA", "PyInit", "_PyOther"]


@pytest.mark.parametrize(
    "name", ["libtbb.so.12", "libgmp.so.10", "libmpfr.so.6", "libpython3.11.so.1.0"]
)
def test_module_that_needs_blenders_libraries_is_refused(checker, tmp_path, name):
    needed = tmp_path / name
    subprocess.run(
        ["g++", "-shared", "-fPIC", "-o", needed, f"-Wl,-soname,{name}", "-x", "c++", "/dev/null"],
        check=True,
    )
    with pytest.raises(SystemExit, match=f"must not need {name}"):
        checker.check(compile_library(tmp_path, GOOD, "-Wl,--no-as-needed", needed))


def test_module_for_newer_systems_is_refused_unless_it_is_for_this_one(
    checker, tmp_path, monkeypatch
):
    source = '#include <cstdio>\nextern "C" __attribute__((visibility("default"))) '
    module = compile_library(tmp_path, source + 'int PyInit__medial() { return std::puts(""); }\n')
    checker.check(module)
    monkeypatch.setitem(checker.NEWEST, "GLIBC", "2.2")
    with pytest.raises(SystemExit, match=r"needs GLIBC_2\.\d+.*, newer than 2\.2; .*--local"):
        checker.check(module)
    assert checker.check(module, local=True)


def test_newest_version_counts_in_numbers(checker):
    assert checker.newest("GLIBC", "GLIBC_2.9 GLIBC_2.34 GLIBC_2.4 GLIBCXX_3.4.29") == "2.34"
    assert checker.newest("CXXABI", "GLIBC_2.9") == ""


def test_one_failing_part_fails_the_whole(script, monkeypatch, capsys):
    def fail(blender):
        raise script.Failure("broken")

    def skip(blender):
        raise script.Skip("no tool")

    monkeypatch.setattr(script, "require", lambda needs: None)
    monkeypatch.setattr(script, "find_blender", lambda name: name)
    monkeypatch.setattr(script, "PARTS", {"one": fail, "two": skip, "three": lambda blender: None})
    assert script.main(["test"]) == 1
    text = capsys.readouterr().out
    summary = text[text.index("Summary") :].splitlines()
    verdicts = [line.split(" s  ")[1] for line in summary[1:4]]
    assert verdicts == ["FAILED: broken", "skipped: no tool", "passed"]
    assert script.main(["test", "--only", "two", "three"]) == 0
    assert script.main(["test", "--only", "four"]) == 1


def test_clean_removes_what_was_made(script, tmp_path, monkeypatch):
    for name in (
        "build/release/x",
        "dist/a.zip",
        "blender_addon/lib/m.so",
        "core/__pycache__/a.pyc",
        "demo_output/a.png",
        "keep.py",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("x", encoding="utf-8")
    for name, path in {
        "ROOT": "",
        "BUILD": "build",
        "DIST": "dist",
        "LIBRARY": "blender_addon/lib",
    }.items():
        monkeypatch.setattr(script, name, tmp_path / path)
    assert script.main(["clean"]) == 0
    assert sorted(p.name for p in tmp_path.rglob("*") if p.is_file()) == ["a.png", "keep.py"]
    assert script.main(["clean", "--all"]) == 0
    assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == ["keep.py"]


def test_manual_pages_are_whole(script, tmp_path):
    """Every page of docs/ is there, and every link between pages leads to a page and a heading."""
    pages = {name: path.read_text() for name, path in script.manual_pages(tmp_path).items()}
    documents = sorted((ROOT / "docs").glob("*.md"))
    assert list(pages) == [f"manual/{path.stem}.html" for path in documents]
    for page, document in zip(pages.values(), documents, strict=True):
        assert page.count("<pre>") == document.read_text().count("\n```") // 2
        for name, place in re.findall(r'<a href="([\w.]+)(?:#([\w-]+))?">', page):
            target = pages[f"manual/{name}"]
            assert not place or f'id="{place}"' in target


def test_manual_page_shows_markdown_as_it_is(script):
    page = script.manual_page(
        "# Big & *small*\n\na < b [x](other.md#y-z) ![p](q.png)\n```python\n# no heading\n```\nend\n"
    )
    assert '<h1 id="big-amp-small">Big &amp; *small*</h1>' in page
    assert 'a &lt; b <a href="other.html#y-z">x</a> \n' in page
    assert "<pre># no heading\n</pre>" in page and "q.png" not in page
