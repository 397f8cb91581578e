# SPDX-License-Identifier: GPL-3.0-or-later
"""One contract for all commands: reports, batches, frames, what is kept, limits, streams and exit codes."""

import json
import os
import subprocess
import sys
from functools import partial
from typing import NamedTuple

import medial_axis
import pytest
from medial_axis import cli
from medial_axis.core.machine.cache import CACHE
from support.meshes import torus, write_off
from support.thick_meshes import block
from test_cli import files, run_words

PLATE = block(4.0, 3.0, 0.4)
FEW = ("--sampling", "surface", "--samples", "500")
VOXELS = ("--wall", "0.15", "--voxel-size", "0.12")


class Command(NamedTuple):
    words: tuple
    options: tuple
    suffix: str
    other: tuple  # an option that changes the result
    figure: str  # in the report
    may_end: tuple = (cli.DONE,)  # where all is well: thin walls are told by an exit code


THIN = (cli.DONE, cli.THIN)
COMMANDS = {
    "axis": Command((), FEW, "ma", ("--theta", "40"), "facets"),
    "balls": Command(("balls",), (*FEW, "--count", "6"), "ma", ("--count", "5"), "covered"),
    "skeleton": Command(("skeleton",), FEW, "swc", ("--detail", "0.9"), "ends"),
    "thickness": Command(("thickness",), FEW, "csv", ("--limit", "0.3"), "minimum", THIN),
    "thicken": Command(
        ("thicken",), (*FEW, "--limit", "0.8"), "ply", ("--limit", "0.9"), "farthest_move", THIN
    ),
    "midsurface": Command(("midsurface",), FEW, "ply", ("--size", "1"), "sheets"),
    "hollow": Command(("hollow",), VOXELS, "stl", ("--wall", "0.14"), "cavities"),
    "solidify": Command(("solidify",), ("--thickness", "0.1"), "stl", ("--offset", "1"), "volume"),
}


@pytest.fixture(params=COMMANDS)
def command(request):
    """A row of the table."""
    return COMMANDS[request.param]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_off(tmp_path / "plate.off", PLATE)
    return tmp_path


@pytest.fixture
def run(command, capsys):
    """(words) -> exit code, reports, standard error."""
    return partial(run_words, capsys, *command.words, *command.options)


def times(folder):
    return {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}


def test_a_result_is_reported_kept_and_made_again(here, run, command):
    out = f"plate.{command.suffix}"
    code, (report,), said = run("plate.off", out)
    assert code in command.may_end and said.count("\n") == len(report["warnings"])
    assert report["status"] == "done" and command.figure in report
    assert json.loads((here / f"{out}.json").read_text()) == report
    before, written = (here / out).read_bytes(), times(here)
    assert run("plate.off", out)[1][0] == {**report, "status": "kept"} and times(here) == written
    code, (other,), _ = run("plate.off", out, *command.other)
    name, value = command.other[0].removeprefix("--"), command.other[1]
    assert other["status"] == "done" and other["settings"][name] == float(value)
    assert run("plate.off", out, "--force")[1][0]["status"] == "done"
    assert (here / out).read_bytes() == before


def test_one_bad_input_stops_no_other(here, run, command):
    (here / "bad.off").write_text("nonsense")
    write_off(here / "last.off", PLATE)
    inputs = "plate.off", "bad.off", "last.off"
    code, reports, said = run(*inputs, "out/", "--format", command.suffix)
    assert code == cli.INPUT and "bad.off" in said
    assert [report["status"] for report in reports] == ["done", "failed", "done"]
    names = sorted(path.name for path in (here / "out").glob(f"*.{command.suffix}"))
    assert names == [f"last.{command.suffix}", f"plate.{command.suffix}"]


def test_frames(here, run, command):
    for frame in (1, 2):
        write_off(here / f"walk_000{frame}.off", PLATE)
    out = f"walk_####.{command.suffix}"
    code, reports, _ = run("walk_####.off", f"out/{out}", "--frames", "1-2")
    assert code in command.may_end and [report["frame"] for report in reports] == [1, 2]
    first, second = sorted((here / "out").glob(f"*.{command.suffix}"))
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize("command", ["axis", "balls", "skeleton", "midsurface"], indirect=True)
def test_memory_limit(here, run, command):
    """A command that analyses samples says before it begins that they do not fit."""
    CACHE.clear()  # an analysis that an earlier test left there needs no memory
    words = "--samples", "20000", "--memory-limit", "1"
    code, _, said = run("plate.off", f"plate.{command.suffix}", *words)
    assert code == cli.FAILED and "the limit of 1 MB" in said
    assert files(here) == ["plate.off"]


def test_exit_codes(here, run, command):
    out = f"plate.{command.suffix}"
    assert run("none.off", out)[0] == cli.INPUT
    for wrong in (["plate.off", "plate.xyz"], ["plate.off", out, "--nonsense"], ["plate.off"]):
        assert run(*wrong)[0] == cli.USAGE
    assert run("plate.off", out, "--options", f"{command.other[0]} nan")[0] == cli.USAGE
    assert files(here) == ["plate.off"]


def test_closed_standard_output(here, command):
    """Nobody reads: the files are written up to there, and the exit code is that of SIGPIPE."""
    read, write = os.pipe()
    os.close(read)
    words = [*command.words, "plate.off", f"plate.{command.suffix}", *command.options]
    program = [sys.executable, os.path.dirname(medial_axis.__file__)]
    done = subprocess.run([*program, *words], stdout=write, stderr=subprocess.PIPE, text=True)
    os.close(write)
    assert done.returncode == cli.CLOSED_PIPE
    assert (here / f"plate.{command.suffix}").exists()


def test_the_file_is_the_library_s(tmp_path):
    mesh = torus(1.0, 0.4, 48, 24)
    source = write_off(tmp_path / "torus.off", mesh)
    words = ["--count", "6", "--mode", "around", "--sampling", "vertices"]
    assert cli.main(["balls", source, str(tmp_path / "a.json"), *words]) == cli.DONE
    cover = partial(medial_axis.cover_by_balls, count=6, mode="around", sampling="vertices")
    found = cover(*mesh)
    ours = medial_axis.write_balls(found, tmp_path / "b.json")
    assert (tmp_path / "a.json").read_bytes() == ours.read_bytes()
    twice = cover(2 * mesh[0], mesh[1])
    assert (twice.balls.radii == 2 * found.balls.radii).all()
