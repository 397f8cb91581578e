# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis balls` on the command line: files, frames, batches, reports, memory, streams."""

import json
import os
import subprocess
import sys

import medial_axis
import pytest
from medial_axis import cli
from medial_axis.core.machine.cache import CACHE
from support import meshes
from support.meshes import write_off

TORUS = meshes.torus(1.0, 0.4, 48, 24)
WORDS = ("--count", "6", "--mode", "around", "--sampling", "vertices")


@pytest.fixture
def source(tmp_path):
    return write_off(tmp_path / "torus.off", TORUS)


def run(*words):
    return cli.main(["balls", *map(str, words), *WORDS])


def test_the_file_is_the_library_s(source, tmp_path, capsys):
    out = tmp_path / "torus.json"
    assert run(source, out) == cli.DONE
    assert "6 balls, 100.0 % of the volume" in capsys.readouterr().out
    found = medial_axis.cover_by_balls(*TORUS, count=6, mode="around", sampling="vertices")
    assert out.read_bytes() == medial_axis.write_balls(found, tmp_path / "b.json").read_bytes()
    assert run(source, out) == cli.DONE and ", kept" in capsys.readouterr().out


def test_a_batch_reports_in_json_and_one_bad_input_stops_no_other(source, tmp_path, capsys):
    bad = tmp_path / "bad.off"
    bad.write_text("nonsense")
    code = run(source, bad, write_off(tmp_path / "b.off", TORUS), f"{tmp_path}/out/", "--format", "ma",
               "--json")  # fmt: skip
    reports = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert code == cli.INPUT
    assert [report["status"] for report in reports] == ["done", "failed", "done"]
    assert reports[0]["count"] == 6 and reports[0]["covered"] == 1.0
    assert reports[0]["settings"]["count"] == 6 and reports[0]["settings"]["mode"] == "around"
    assert sorted(path.name for path in (tmp_path / "out").glob("*.ma")) == ["b.ma", "torus.ma"]


def test_frames(tmp_path):
    for frame in (1, 2):
        write_off(tmp_path / f"walk_000{frame}.off", (TORUS[0] * frame, TORUS[1]))
    paths = tmp_path / "walk_####.off", tmp_path / "balls_####.json"
    assert run(*paths, "--frames", "1-2") == cli.DONE
    radii = [
        json.loads((tmp_path / f"balls_000{frame}.json").read_text())["balls"][0]["radius"]
        for frame in (1, 2)
    ]
    assert radii[1] == 2 * radii[0], "the second torus is exactly twice as large"


def test_other_settings_are_computed_again(source, tmp_path, capsys):
    out = tmp_path / "torus.json"
    assert run(source, out) == cli.DONE
    assert run(source, out, "--options", "--count 5") == cli.DONE
    assert ", done in" in capsys.readouterr().out.splitlines()[-1]
    assert len(json.loads(out.read_text())["balls"]) == 5


def test_memory_limit(source, tmp_path, capsys):
    CACHE.clear()  # an analysis that an earlier test left there needs no memory
    assert run(source, tmp_path / "torus.json", "--memory-limit", "1") == cli.FAILED
    assert "the limit of 1 MB" in capsys.readouterr().err
    assert not (tmp_path / "torus.json").exists()


def test_closed_standard_output(source, tmp_path):
    """Nobody reads: the files are written up to there, and the exit code is that of SIGPIPE."""
    read, write = os.pipe()
    os.close(read)
    words = ["balls", source, str(tmp_path / "torus.json"), *WORDS]
    program = [sys.executable, os.path.dirname(medial_axis.__file__)]
    done = subprocess.run([*program, *words], stdout=write, stderr=subprocess.PIPE, text=True)
    os.close(write)
    assert done.returncode == cli.CLOSED_PIPE and done.stderr == ""
    assert (tmp_path / "torus.json").exists()


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full")
def test_standard_output_is_full(source, tmp_path):
    words = ["balls", source, str(tmp_path / "torus.json"), *WORDS]
    program = [sys.executable, os.path.dirname(medial_axis.__file__)]
    with open("/dev/full", "wb") as full:
        done = subprocess.run([*program, *words], stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == cli.FAILED and (tmp_path / "torus.json").exists()
    assert done.stderr.count("\n") == 1 and "No space left" in done.stderr


@pytest.mark.parametrize(
    "words", [("x.ply",), ("x.json", "--theta", "30"), ("x.json", "--options", "--count 0")]
)
def test_wrong_usage(source, tmp_path, words, capsys):
    assert run(source, tmp_path / words[0], *words[1:]) == cli.USAGE
    capsys.readouterr()


def test_missing_input(tmp_path, capsys):
    assert run(tmp_path / "none.off", tmp_path / "x.json") == cli.INPUT
    capsys.readouterr()
