# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis thickness` on the command line: files, exit codes, batches."""

import json

import numpy as np
import pytest
from medial_axis import cli
from support.meshes import write_off
from support.thick_meshes import block


@pytest.fixture
def box(tmp_path):
    return write_off(tmp_path / "box.off", block(1.0, 0.7, 0.4))


def run(*words):
    return cli.main(
        ["thickness", *map(str, words), "--quiet", "--sampling", "surface", "--samples", "4000"]
    )


def test_exit_code_says_whether_something_is_thin(box, tmp_path, capsys):
    out = tmp_path / "box.json"
    assert run(box, out, "--limit", 0.4) == cli.DONE
    assert "minimum 0.4, 0 % below 0.4" in capsys.readouterr().out
    assert run(box, out, "--limit", 0.41, "--unit", "mm") == cli.THIN == 5
    assert "minimum 0.4 mm, 100 % below 0.41 mm in 1 patch" in capsys.readouterr().out
    said = json.loads(out.read_text())
    assert said["unit"] == "mm" and len(said["patches"]) == 1
    assert run(box, out, "--limit", 0.41, "--unit", "mm") == cli.THIN, "also of what is kept"
    assert ", kept" in capsys.readouterr().out


def test_options_reach_the_measurement(box, tmp_path):
    out = tmp_path / "box.csv"

    def lengths():
        return np.loadtxt(out, delimiter=",", skiprows=1)[:, 4]

    assert run(box, out, "--gap") == cli.DONE and np.isinf(lengths()).all()
    assert run(box, out, "--edges", "ball") == cli.DONE and (lengths() < 0.2).all()
    assert run(box, out) == cli.DONE
    np.testing.assert_allclose(lengths(), 0.4, rtol=0.02)


def test_many_inputs_and_one_that_cannot_be_used(box, tmp_path, capsys):
    plate = write_off(tmp_path / "plate.off", block(1.0, 0.7, 0.1))
    folder = tmp_path / "out"
    assert run(box, plate, f"{folder}/", "--limit", 0.2, "--format", "csv") == cli.THIN
    assert sorted(p.name for p in folder.glob("*.csv")) == ["box.csv", "plate.csv"]
    report = json.loads((folder / "plate.csv.json").read_text())
    assert report["share_below"] == pytest.approx(1.0, abs=0.01) and report["status"] == "done"
    assert run(tmp_path / "none.off", plate, f"{folder}/", "--limit", 0.2) == cli.INPUT
    capsys.readouterr()


@pytest.mark.parametrize("words", [("--limit", "-1"), ("--theta", "20"), ("--edges", "round")])
def test_wrong_usage(box, tmp_path, words, capsys):
    assert run(box, tmp_path / "box.json", *words) == cli.USAGE
    assert run(box, tmp_path / "box.ma") == cli.USAGE
    assert ".csv, .json or .ply" in capsys.readouterr().err
