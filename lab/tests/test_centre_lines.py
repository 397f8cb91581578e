# SPDX-License-Identifier: GPL-3.0-or-later
"""The races of centre lines: one program that fails, or is absent, ends its row and not the table."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.append(str(Path(__file__).resolve().parents[1] / "benchmarks"))
import neurons
import vessels


@pytest.fixture
def no_surface(monkeypatch):
    """The mesh of a tree takes a minute, and no program looks at it here."""
    shape = SimpleNamespace(points=np.zeros((4, 3)), triangles=np.zeros((0, 3), np.int32))
    for module in (neurons, vessels):
        monkeypatch.setattr(module, "volume_of", lambda tree: (None, None))
        monkeypatch.setattr(module, "mesh_of", lambda volume, first: shape)


def fail(*_):
    raise TypeError("Cannot cast")


def test_a_program_that_fails_ends_its_row_only(monkeypatch, no_surface):
    tree = vessels.botanical()
    known = neurons.Lines(tree.places, tree.edges, tree.radius)
    monkeypatch.setattr(neurons, "ours", lambda shape, detail: known)
    monkeypatch.setattr(
        neurons.importlib.util, "find_spec", lambda name: name != "skeletor" or None
    )
    monkeypatch.setattr(neurons, "kimimaro", fail)
    monkeypatch.setattr(neurons, "cgal", lambda shape: known)
    rows = list(neurons.rows_of("tree", tree))
    assert [row[2] for row in rows] == [
        "17",
        "17",
        "failed: TypeError",
        "17",
        "left out: no skeletor",
    ]
    assert rows[0][3] == "17 of 17" and {len(row) for row in rows} == {len(neurons.HEADER)}


def test_pythons_that_lack_a_program_end_their_rows_only(monkeypatch, no_surface):
    monkeypatch.setattr(vessels, "rows_of", lambda name, tree: [])
    rows = list(vessels.rows(sys.executable, sys.executable))
    assert [row[:3] for row in rows] == [
        ["tree, 4 vertices", "VMTK, told the ends", "failed: CalledProcessError"],
        ["vessels", "svv", "failed: CalledProcessError"],
    ]
    assert [row[2] for row in vessels.rows(None, None)] == ["left out: no --vmtk", ""]
