# SPDX-License-Identifier: GPL-3.0-or-later
"""build_addon.py repository: what it refuses; tests/matrix/updates.py installs and updates from what it makes."""

import json
import sys

import pytest

import build_addon
from tools.packaging import pack, paths, repository
from tools.packaging.terminal import Failure

# Stands in for a Blender that writes an index of some zips.
GENERATOR = """
import json, pathlib, sys
folder = pathlib.Path(sys.argv[-2].split("=")[1])
rows = [{"archive_url": path.name} for path in sorted(folder.glob("*.zip"))][:MOST]
(folder / "index.json").write_text(json.dumps({"data": rows}))
(folder / "index.html").write_text("page")
"""


@pytest.fixture
def generator(tmp_path):
    """Words that start a Blender which lists at most so many zips."""

    def words(most):
        script = tmp_path / f"generator_{most}.py"
        script.write_text(GENERATOR.replace("MOST", str(most)))
        return [sys.executable, str(script)]

    return words


@pytest.fixture
def archives(tmp_path):
    paths_of = [tmp_path / f"medial_axis-1-{system}.zip" for system in ("linux-x64", "windows-x64")]
    for path in paths_of:
        path.write_bytes(b"zip")
    return paths_of


def test_folder_is_replaced_as_a_whole(tmp_path, archives, generator):
    target = tmp_path / "repository"
    target.mkdir()
    (target / "medial_axis-0-linux-x64.zip").write_bytes(b"old")
    rows = repository.make(archives, target, generator(9))
    names = ["index.html", "index.json", *(path.name for path in archives)]
    assert sorted(path.name for path in target.iterdir()) == names
    assert json.loads((target / "index.json").read_text())["data"] == rows


def test_an_index_that_lacks_a_zip_is_refused_and_nothing_changes(tmp_path, archives, generator):
    target = tmp_path / "repository"
    repository.make(archives[:1], target, generator(9))
    before = sorted(target.iterdir())
    with pytest.raises(Failure, match="an index of 2 zips, found 1"):
        repository.make(archives, target, generator(1))
    assert sorted(target.iterdir()) == before


def test_without_zips_the_command_says_what_to_run(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(paths, "DIST", tmp_path)
    assert build_addon.main(["repository"]) == 1
    assert "run 'build_addon.py build' without --local first" in capsys.readouterr().err


def test_without_a_newer_blender_the_command_ends_with_2(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(paths, "DIST", tmp_path)
    monkeypatch.setattr(paths, "BLENDERS", tmp_path)
    pack.archive_for("linux-x64").write_bytes(b"zip")
    assert build_addon.main(["repository", "--blender", "no-such-blender"]) == 2
    assert "Expected a Blender of 4.2 or newer" in capsys.readouterr().err
