# SPDX-License-Identifier: GPL-3.0-or-later
"""The house does not grow unnoticed: the budgets of docs/architecture.md hold, and so do those of each room."""

import pytest
from support.constants import ANY_CPP, is_number, of_cpp, of_python
from test_layers import ADDON, CORE, MAY_INCLUDE, MEDIAL, NATIVE, ROOT, rows

UNITS, LINES = 20, 4500  # of a room, at most
# Rooms with more units: the vocabulary of the core, and what is still to be divided.
WIDE = {"base": 35, "core/axis": 26, "core/files": 26, "core/samples": 24}


def lines_of(paths):
    return sum(path.read_text(encoding="utf-8").count("\n") for path in paths)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".py", ".pyi", ".cpp", ".h"})


def product():
    return [*sources(ADDON), *sources(NATIVE)]


def found():
    texts = [(path.suffix, path.read_text(encoding="utf-8")) for path in product()]
    python = sum(len(list(of_python(text, is_number))) for end, text in texts if end == ".py")
    cpp = sum(len(list(of_cpp(text, ANY_CPP))) for end, text in texts if end in {".cpp", ".h"})
    return {
        "lines of the product": lines_of(product()),
        "lines of tests": lines_of(sources(ROOT / "tests")),
        "named numbers of the product": python + cpp,
    }


def test_the_house_keeps_its_budgets():
    budgets = {
        what: int(most.replace(",", "")) for what, most, *_ in rows("architecture.md", "| budget |")
    }
    over = {what: (n, budgets[what]) for what, n in found().items() if n > budgets[what]}
    assert not over, "delete something, or write the reason next to the budget"


ROOMS = {
    **{room: MEDIAL / room for room in MAY_INCLUDE if room != "."},
    **{room: ADDON / room for room in sorted(CORE) if room != "core"},
}


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_is_small(room):
    files = [p for p in ROOMS[room].iterdir() if p.suffix in {".py", ".cpp", ".h"}]
    units = {path.stem for path in files if path.name != "__init__.py"}
    assert len(units) <= WIDE.get(room, UNITS)
    assert lines_of(files) <= LINES
