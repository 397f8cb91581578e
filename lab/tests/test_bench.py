# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark: what its figures are made of. No test looks at seconds."""

import io
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.append(str(Path(__file__).resolve().parents[1] / "benchmarks"))
import bench
import hierarchy_cost
import measuring
from support.shapes import SHAPES


@pytest.fixture(scope="module")
def turn(tmp_path_factory):
    """One measurement in a process of its own."""
    folder = tmp_path_factory.mktemp("bench")
    points = SHAPES["ellipsoid"].random_sample(20_000, 0)
    measuring.Input("", points, bench.NO_TRIANGLES).write(folder)
    return measuring.ours(folder, "TIGHT_COCONE", 1)


def test_a_measurement_has_all_stages_and_counts_memory(turn, medial):
    analysis = medial.MedialAnalysis(
        SHAPES["ellipsoid"].random_sample(20_000, 0), sides=medial.SidesFrom.TIGHT_COCONE
    )
    assert list(turn["stages"]) == list(analysis.timings)
    assert sum(turn["stages"].values()) <= turn["seconds"]["analysis"]
    assert turn["facets"] == len(analysis.extract(side=medial.Side.INNER).generators)
    sizes = turn["bytes"]
    assert 200 * 20_000 < sizes["kept"] <= sizes["analysis"] <= sizes["with extract"]


def test_ratios_are_those_of_neighbours(turn):
    turns = [
        {**turn, "bare": {"seconds": seconds, "cpu": seconds, "bytes": 1, "others": 0.0}}
        for seconds in (0.5, 1.0, 8.0)
    ]
    found = bench.summary("TIGHT_COCONE", 1, turns)
    whole = turn["seconds"]["analysis"] + turn["seconds"]["extract"]
    assert found["ratios"]["all"] == pytest.approx(whole / 1.0)
    assert found["seconds"]["own"] < found["seconds"]["all"] == pytest.approx(whole)
    assert found["bare"]["seconds"] == 1.0


def test_inputs_are_made_only_when_wanted():
    assert list(bench.ladder(1, [])) == []
    (work,) = bench.ladder(20_000, ["ellipsoid"])
    assert work.points.shape == (10_000, 3) and len(work.triangles) == 0
    assert np.isfinite(work.points).all()


def test_tables_replace_what_stood_below_the_mark(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(f"words\n{bench.MARK}\n\nold\n")
    bench.put_below_mark("new\n", page)
    assert page.read_text() == f"words\n{bench.MARK}\n\nnew\n"
    assert (
        (Path(bench.__file__).parents[2] / "docs/lab/performance.md").read_text().count(bench.MARK)
    )


def test_long_tables_are_files_next_to_the_page(tmp_path):
    page = tmp_path / "cost.md"
    page.write_text(f"words\n{bench.MARK}\n\nold\n")
    row = {
        **{"sides": "NONE", "threads": 2, "facets": 9, "others": 0.0, "speed-up": 1.7},
        **{"seconds": dict.fromkeys(("all", "own", "extract", "again"), 0.5)},
        **{"ratios": dict.fromkeys(("all", "cpu", "own", "extract", "again"), 1.5)},
        **{"bare": {"seconds": 0.25, "bytes": 500}, "bytes": {"with extract": 1000, "kept": 900}},
        **{"stages": {"samples": 0.125}},
    }
    native = [{"input": "ellipsoid", "points": 10, "rows": [row], "qhull": None}]
    machine = {**bench.machine(), "turns": 2}
    bench.publish({"machine": machine, "native": native, "blender": []}, page)
    assert "medians of 2 turns" in page.read_text() and "| ellipsoid | 10 " in page.read_text()
    stages = (tmp_path / "cost_stages.csv").read_text().splitlines()
    assert stages[1] == "ellipsoid,10,None,2,0.125,0.500,0.500"
    assert (tmp_path / "cost_bare.csv").read_text().count("\n") == 2


def test_a_window_opens_on_a_display_of_its_size(monkeypatch, tmp_path):
    pytest.importorskip("scipy")
    import blender_bench

    commands = []

    class Server:
        def __init__(self, command, **_):
            commands.append(command)
            self.stdout = io.StringIO("7\n")

        def terminate(self):
            commands.append("ended")

        def wait(self):
            pass

    monkeypatch.setattr(blender_bench.drive.subprocess, "Popen", Server)
    monkeypatch.setattr(blender_bench, "_in_blender", lambda blender, folder, *how: how)
    blender = SimpleNamespace(environment={})
    how = blender_bench._in_window(blender, tmp_path)
    size = [str(length) for length in blender_bench.drive.SIZE]
    assert list(how[-2:]) == size and blender.environment["DISPLAY"] == ":7"
    assert "x".join([*size, "24"]) in commands[0] and commands[1:] == ["ended"]


def test_costs_of_no_input_are_a_sentence_not_an_empty_table(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["hierarchy_cost.py", "--only", "no such mesh"])
    with pytest.raises(SystemExit, match="no such mesh.*found none.*MEDIAL_AXIS_TEST_DATA"):
        hierarchy_cost.main()
    assert capsys.readouterr().out == ""
