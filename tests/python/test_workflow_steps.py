# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of the workflows are run with the names of files that the jobs before them leave. What another system brings
(lipo, codesign, gh) is a stand-in that says what it was asked for.
"""

import subprocess
from pathlib import Path

import pytest
from support.package import ROOT
from test_build_addon import write

from tools.packaging import pack

MODULES = {  # by the artifact that a job of systems.yml uploads
    "modules-linux-x64": ["_medial.cpython-311-x86_64-linux-gnu.so"],
    "modules-linux-arm64": ["_medial.cpython-313-aarch64-linux-gnu.so"],
    "modules-windows-x64-3.11": ["_medial.cp311-win_amd64.pyd"],
    "modules-macos-arm64-3.11": ["_medial.cpython-311-darwin.so"],
    "modules-macos-arm64-3.13": ["_medial.cpython-313-darwin.so"],
    "modules-macos-x64-3.11": ["_medial.cpython-311-darwin.so"],
}


def commands(workflow):
    """The commands of each job."""
    yaml = pytest.importorskip("yaml")
    text = (ROOT / ".github/workflows" / f"{workflow}.yml").read_text(encoding="utf-8")
    jobs = yaml.safe_load(text)["jobs"].items()
    return {name: [x["run"] for x in job.get("steps", ()) if "run" in x] for name, job in jobs}


def step(workflow, job, words):
    """The only command of a job that has these words."""
    (found,) = [command for command in commands(workflow)[job] if words in command]
    return found


def run(command, folder, **environment):
    """As the service runs it; returns the exit code and what was said."""
    path = f"{folder / 'bin'}:/usr/bin:/bin"
    words = ["bash", "--noprofile", "--norc", "-e", "-c", command]
    output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    done = subprocess.run(words, cwd=folder, env={"PATH": path, **environment}, **output)
    return done.returncode, done.stdout


def stand_in(folder, name, script='echo "$0" "$@" >> asked'):
    write(folder, {f"bin/{name}": f"#!/bin/sh\n{script}\n"})
    (folder / "bin" / name).chmod(0o755)


HASHES = "aa  cube: solid\nbb  cube: wrap\ncc  ball\n"


@pytest.mark.parametrize(
    "other, equal",
    [
        (HASHES, True),
        (HASHES.replace("\n", "\r\n"), True),
        (HASHES.replace("bb", "00"), True),
        (HASHES.replace("cc", "00"), False),
        (HASHES.replace("cc  ball\n", ""), False),
        ("", False),
    ],
)
def test_hashes_of_systems_must_be_equal_but_for_wraps(tmp_path, other, equal):
    write(tmp_path, {"hashes-linux-x64/hashes.txt": HASHES, "hashes-windows/hashes.txt": ""})
    (tmp_path / "hashes-windows/hashes.txt").write_bytes(other.encode())
    code, said = run(step("systems", "same_bytes", "diff"), tmp_path)
    assert (code == 0) is equal, said


def test_modules_of_all_systems_are_packed(tmp_path):
    named = {**MODULES, "modules-macos": ["_medial.cpython-311-darwin.so"]}
    write(tmp_path, {f"modules/{a}/{name}": a for a, names in named.items() for name in names})
    code, said = run(step("systems", "zips", "blender_addon/lib"), tmp_path)
    assert code == 0, said
    packed = [path.name for path in (tmp_path / "blender_addon/lib").iterdir()]
    for system, ending in pack.PLATFORMS.items():
        assert any(name.endswith(ending) for name in packed), system
    mac = tmp_path / "blender_addon/lib/_medial.cpython-311-darwin.so"
    assert mac.read_text() == "modules-macos", "the one for both processors"


@pytest.fixture
def zips(tmp_path, monkeypatch):
    """The zips of all systems by the names that packing gives them, in dist/ and zips/."""
    monkeypatch.setattr(pack.paths, "DIST", Path("dist"))
    names = [pack.archive_for(platform).name for platform in ("", *pack.PLATFORMS)]
    for folder in ("dist", "zips"):
        write(tmp_path, {f"{folder}/{name}": name for name in names})
    return names


def test_a_release_has_zips_wheels_and_hashes(tmp_path, zips):
    write(tmp_path, {"wheels/a.whl": "", "wheels/b.whl": "", "hashes/hashes.txt": HASHES})
    stand_in(tmp_path, "gh", 'for word in "$@"; do echo "$word" >> asked; done')
    names = {"GITHUB_REF_NAME": "v1.2.3", "GITHUB_REPOSITORY": "a/b"}
    code, said = run(step("release", "draft", "gh release"), tmp_path, **names)
    assert code == 0, said
    asked = (tmp_path / "asked").read_text().splitlines()
    assert asked[:3] == ["release", "create", "v1.2.3"] and "--draft" in asked
    files = [word for word in asked if (tmp_path / word).is_file()]
    assert len(files) == len(zips) + 3


def test_shell_of_all_steps_is_valid():
    """Also of those that nothing here can run."""
    files = (ROOT / ".github/workflows").glob("*.yml")
    every = [one for file in files for job in commands(file.stem).values() for one in job]
    for one in every:
        done = subprocess.run(["bash", "-n", "-c", one], capture_output=True, text=True)
        assert done.returncode == 0, (one, done.stderr)
    assert len(every) > 30
