# SPDX-License-Identifier: GPL-3.0-or-later
"""Wheels that are written from the add-on's files, and the zips that hold them; test_wheel.py builds one by pip."""

import base64
import csv
import hashlib
import io
import re
import subprocess
import sys
import tomllib
import zipfile
from email import message_from_string

import pytest
from medial_axis.core.machine import native
from support.package import ROOT

from tools.packaging import pack, paths, wheels

LINUX = "lib/_medial.cpython-313-x86_64-linux-gnu.so"
PARTS = "core/axis/compute.py", "commands/convert.py"  # of the package
OTHERS = "core/notes.txt", "ui/panel.py", "manual/index.html", "LICENSE"
FILES = {name: name.encode() for name in (*wheels.FRONT, *PARTS, *OTHERS, LINUX)}
VERSION = "1.2.3+g1a2b3c4d"
INFO = f"medial_axis-{VERSION}.dist-info"
COMPUTE = """
import medial_axis, numpy
points = numpy.random.default_rng(1).normal(size=(99, 3))
print(medial_axis.compute(points, side="both").axis.facets)
"""
FILES["blender_manifest.toml"] = b'version = "1"\n\n[permissions]\n'


@pytest.fixture(autouse=True)
def version(monkeypatch):
    monkeypatch.setattr(paths, "full_version", lambda: VERSION)


@pytest.mark.parametrize(
    "platform, module, tag",
    [
        ("linux-x64", LINUX, "cp313-cp313-manylinux_2_28_x86_64"),
        ("linux-arm64", "lib/_medial.cpython-314-aarch64-linux-gnu.so", "cp314-cp314-manylinux_2_28_aarch64"),
        ("macos-arm64", "lib/_medial.cpython-311-darwin.so", "cp311-cp311-macosx_11_0_arm64"),
        ("macos-x64", "lib/_medial.cpython-311-darwin.so", "cp311-cp311-macosx_11_0_x86_64"),
        ("windows-x64", "lib/_medial.cp311-win_amd64.pyd", "cp311-cp311-win_amd64"),
    ],
)  # fmt: skip
def test_names(platform, module, tag):
    name, contents = wheels.wheel({**FILES, module: b"it"}, module, platform)
    assert name == f"medial_axis-{VERSION}-{tag}.whl"
    assert contents[f"medial_axis/{module}"] == b"it"
    assert f"Tag: {tag}\n".encode() in contents[f"{INFO}/WHEEL"]


def test_a_wheel_has_its_module_and_nothing_of_blender():
    other = "lib/_medial.cpython-311-x86_64-linux-gnu.so"
    _, contents = wheels.wheel({**FILES, other: b""}, LINUX, "linux-x64")
    package = {name for name in contents if name.startswith("medial_axis/")}
    wanted = {*wheels.FRONT, *PARTS, LINUX, "lib/_medial.pyi"}
    assert package == {f"medial_axis/{name}" for name in wanted}
    assert f"{INFO}/licenses/LICENSE" in contents


def test_the_same_files_as_the_wheel_that_cmake_installs():
    text = (ROOT / "native/python/CMakeLists.txt").read_text()
    listed = re.search(r"install\(FILES \$\{addon\}(.+?)DESTINATION medial_axis ", text, re.DOTALL)
    assert {word.rpartition("/")[2] for word in listed[1].split()} == set(wheels.FRONT)
    folders = re.search(r"install\(DIRECTORY (.+?) DESTINATION", text)[1].split()
    assert {f"{folder.rpartition('/')[2]}/" for folder in folders} == set(wheels.PARTS)


def test_metadata_is_that_of_the_project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    _, contents = wheels.wheel(FILES, LINUX, "linux-x64")
    found = message_from_string(contents[f"{INFO}/METADATA"].decode())
    assert (found["Name"], found["Version"]) == (project["name"], VERSION)
    assert (found["Summary"], found["License"]) == (project["description"], "GPL-3.0-or-later")
    assert found["Requires-Python"] == project["requires-python"]
    assert found.get_all("Requires-Dist") == project["dependencies"]
    command, start = next(iter(project["scripts"].items()))
    assert f"{command} = {start}\n" in contents[f"{INFO}/entry_points.txt"].decode()


def test_record_has_each_file_with_its_hash():
    _, contents = wheels.wheel(FILES, LINUX, "linux-x64")
    own = f"{INFO}/RECORD"
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(contents[own].decode()))}
    assert set(rows) == set(contents) and rows.pop(own) == ["", ""]
    for name, (digest, size) in rows.items():
        wanted = base64.urlsafe_b64encode(hashlib.sha256(contents[name]).digest()).decode()
        assert (digest, size) == (f"sha256={wanted.rstrip('=')}", str(len(contents[name])))


def test_zips_with_wheels_have_no_loose_module_and_nothing_old_stays(tmp_path, monkeypatch):
    monkeypatch.setattr(paths, "DIST", tmp_path)
    folder = tmp_path / "wheels"
    folder.mkdir()
    (folder / "old.whl").touch()
    arm = "lib/_medial.cpython-311-aarch64-linux-gnu.so"
    pack.write_wheels({**FILES, arm: b"arm"}, folder)
    of_x64 = f"medial_axis-{VERSION}-cp313-cp313-manylinux_2_28_x86_64.whl"
    of_arm = f"medial_axis-{VERSION}-cp311-cp311-manylinux_2_28_aarch64.whl"
    archives = [f"medial_axis-{VERSION}-linux-{name}.zip" for name in ("arm64", "x64")]
    assert sorted(path.name for path in folder.iterdir()) == sorted([of_x64, of_arm, *archives])
    with zipfile.ZipFile(folder / archives[1]) as archive:
        names = set(archive.namelist())
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        assert archive.read(f"wheels/{of_x64}") == (folder / of_x64).read_bytes()
    assert names == {*FILES, f"wheels/{of_x64}"} - {LINUX}
    assert manifest["wheels"] == [f"./wheels/{of_x64}"]
    assert manifest["platforms"] == ["linux-x64"]


def test_pip_installs_one_that_computes(medial, tmp_path):
    module = f"lib/{native.file().name}"
    sources = paths.ADDON.rglob("*.py")
    files = {path.relative_to(paths.ADDON).as_posix(): path.read_bytes() for path in sources}
    files.update({module: native.file().read_bytes(), "py.typed": b""})
    name, contents = wheels.wheel(files, module, "linux-x64")
    (tmp_path / name).write_bytes(pack.zipped(contents))
    install = ("-m", "pip", "install", "-q", "--no-deps", "--no-index", "--no-compile")
    run(*install, "--target", tmp_path / "site", tmp_path / name)
    assert int(run("-c", COMPUTE, path=tmp_path / "site")) > 0


def run(*words, path=None):
    environment = {"PYTHONPATH": str(path)} if path else None
    done = subprocess.run(
        [sys.executable, *map(str, words)], capture_output=True, text=True, env=environment
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
