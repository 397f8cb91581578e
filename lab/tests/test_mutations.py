# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of mutations in lab/mutations: each still fits the sources. What notices them: docs/lab/mutations.csv."""

import csv
import importlib.util
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def load(name):
    """A module of lab/mutations under its own name, as sweep.py imports it."""
    path = ROOT / "lab/mutations" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


mutations, sweep = load("mutations"), load("sweep")
python_mutations, sweep_python = load("python_mutations"), load("sweep_python")
ALL = mutations.MUTATIONS + python_mutations.MUTATIONS


@pytest.mark.parametrize("mutation", ALL, ids=lambda m: f"{m.file}: {m.breaks}")
def test_each_text_occurs_once_and_is_changed(mutation):
    text = (ROOT / mutation.path).read_text()
    assert mutation.applied(text) != text


def test_the_list_is_sound():
    assert sweep.problems() == []
    assert sweep_python.problems() == []


def test_a_text_that_moved_on_is_told():
    gone = mutations.Mutation("analysis.cpp", "no such text", "", "nothing")
    with pytest.raises(ValueError, match="found 0"):
        gone.applied((ROOT / gone.path).read_text())


def test_the_python_tests_that_are_named_exist():
    named = {file for mutation in ALL for file in mutation.python}
    assert named
    assert all((ROOT / "tests/python" / file).is_file() for file in named)


@pytest.mark.parametrize(("module", "made"), [(mutations, sweep), (python_mutations, sweep_python)])
def test_every_mutation_is_in_the_table(module, made):
    with made.TABLE.open(newline="", encoding="utf-8") as file:
        rows = {(row["file"], row["fault"]): row["noticed by"] for row in csv.DictReader(file)}
    assert [m.breaks for m in module.MUTATIONS if (m.file, m.breaks) not in rows] == []
    assert not {"not run", sweep.SURVIVED} & set(rows.values())
