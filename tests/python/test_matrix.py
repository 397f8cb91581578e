# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/matrix/run.py: what is skipped, what fails, what the table says; no Blender is started."""

import importlib.util
import json
import sys
import zipfile
from types import SimpleNamespace

import pytest
from support.package import ROOT

FACTS = {"blender": "5.2.2", "python": "3.14.1", "numpy": "2.4", "installed": "extension"}


@pytest.fixture
def matrix(monkeypatch):
    program = ROOT / "tests" / "matrix" / "run.py"
    spec = importlib.util.spec_from_file_location("matrix_run", program)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "matrix_run", module)
    spec.loader.exec_module(module)
    return module


class Fake:
    """A Blender that gives the same answer always."""

    source, words, engines, module = "Nowhere 1", [], ("Cycles",), ""
    platform = "linux-x64"
    quick, quick_tests = True, True

    def prepare(self, log):
        return []


@pytest.fixture
def played(matrix, monkeypatch, tmp_path, capsys):
    """Run the matrix with some fakes in place of all Blenders; returns (exit code, output, table)."""

    def play(*blenders, code=0, colours=500, export=None):
        answers = iter(export or "a" * 99)

        def run_tests(options, log):
            if "--script" in options:
                answer = options[options.index("--script") + 2]
                facts = {**FACTS, "colours": {"Cycles": colours}, "command": "c" * 64}
                facts["export"] = next(answers) * 64
                answer.write_text(json.dumps(facts))
                return 0, ""
            return code, "....\n3 passed, 1 skipped, 2 deselected, 5 warnings in 1.25s (0:00:01)\n"

        table = tmp_path / "table.md"
        table.write_text(f"By hand.\n\n{matrix.MARK}\nold\n")
        monkeypatch.setattr(matrix, "run_tests", run_tests)
        first, *others = [*blenders, *[Unavailable()] * 7][:7]
        monkeypatch.setattr(matrix, "Installed", lambda program: first)
        left = iter(others)
        for kind in ("Chroot", "Bpy"):
            monkeypatch.setattr(matrix, kind, lambda *names: next(left))
        monkeypatch.setattr(matrix, "Wine", lambda *names: Unavailable())
        words = ["run.py", "a.zip", "--keep", str(tmp_path), "--table", str(table)]
        monkeypatch.setattr(sys, "argv", words)
        Unavailable.error = matrix.UnavailableError
        return matrix.main(), capsys.readouterr().out, table.read_text()

    return play


class Unavailable(Fake):
    source = "Elsewhere"

    def prepare(self, log):
        raise self.error("no network")


def test_blender_that_runs_is_in_the_table_and_others_are_skipped_by_name(played):
    code, out, table = played(Fake())
    assert code == 0 and "FAILED" not in out
    assert table.startswith("By hand.\n") and "old" not in table
    row = "| 5.2.2 | Nowhere 1 | 3.14.1 | 2.4 | extension | 3 passed, 1 skipped | none | Cycles |"
    assert f"{row} {'a' * 16} | {'c' * 16} |" in table
    assert table.count("| Elsewhere |") == 9 and "not tested: no network |" in table


@pytest.mark.parametrize(
    "count, wrong, told",
    [
        (1, {"code": 1}, "Nowhere 1: tests: 3 passed, 1 skipped"),
        (1, {"colours": 1}, "Nowhere 1: empty pictures: Cycles"),
        (1, {"export": "ab"}, "Nowhere 1: the two zips give different exports"),
        (2, {"export": "aabb"}, "the same mesh gives different .ma files"),
    ],
)
def test_failure_in_blenders_that_run_is_a_failure(played, count, wrong, told):
    code, out, _ = played(*(Fake() for _ in range(count)), **wrong)
    assert code == 1 and f"FAILED {told}" in out


def test_command_that_fails_is_told_with_its_last_line(matrix, tmp_path):
    places = importlib.import_module("places")  # it lies beside
    with pytest.raises(places.UnavailableError, match=r"sh failed: no such suite \(see "):
        places.run_logged(["sh", "-c", "echo first; echo no such suite; exit 3"], tmp_path / "log")


def test_what_the_zip_has_no_module_for_is_skipped_by_name(matrix, tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("medial_axis/lib/_medial.cpython-311-x86_64-linux-gnu.so", "")

    class NotThere(Fake):
        module = "cpython-313"

    arguments = SimpleNamespace(zip=tmp_path / "a.zip", keep=tmp_path)
    row = matrix.examine(NotThere(), arguments)
    assert row.skipped == "no module cpython-313 in the zip" and not row.failures
