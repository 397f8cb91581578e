# SPDX-License-Identifier: GPL-3.0-or-later
"""The house does not grow unnoticed: the budgets of docs/architecture.md hold, and so do those of each room."""

import ast
import re

import pytest
from test_docs import rows
from test_layers import ADDON, CORE, MAY_INCLUDE, MEDIAL, NATIVE, ROOT

UNITS, LINES = 20, 4500  # of a room, at most
# Rooms with more units: the vocabulary of the core, and what is still to be divided.
WIDE = {"base": 35, "core/axis": 26, "core/files": 26, "core/samples": 24}
NUMBER = re.compile(r"\b(k[A-Z]\w*)\s*=\s*[^,;]*\d")
DECLARED = re.compile(r"^\s*(?:inline |static )*constexpr\s+[\w:<>]+\s+(k[A-Z].*)", re.MULTILINE)


def lines_of(paths):
    return sum(path.read_text(encoding="utf-8").count("\n") for path in paths)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".py", ".pyi", ".cpp", ".h"})


def is_number(value):
    """Whether an expression is a number that somebody wrote: 0.5, -1, 1 / 256, math.radians(5)."""
    if isinstance(value, ast.Constant):
        return type(value.value) in (int, float)
    if isinstance(value, ast.UnaryOp):
        return is_number(value.operand)
    if isinstance(value, ast.BinOp):
        return is_number(value.left) and is_number(value.right)
    return isinstance(value, ast.Call) and any(map(is_number, value.args))


def constants_of_python(source):
    """Names of numbers at the top of a module."""
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target, value = node.targets[0], node.value
            pairs = [(target, value)]
            if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
                pairs = list(zip(target.elts, value.elts, strict=True))
            yield from (t.id for t, v in pairs if isinstance(t, ast.Name) and is_number(v))


def constants_of_cpp(source):
    """Names of numbers that are declared constexpr, also several in one declaration."""
    return [name for rest in DECLARED.findall(source) for name in NUMBER.findall(rest)]


def product():
    return [*sources(ADDON), *sources(NATIVE)]


def found():
    texts = [(path.suffix, path.read_text(encoding="utf-8")) for path in product()]
    python = sum(len(list(constants_of_python(text))) for end, text in texts if end == ".py")
    cpp = sum(len(constants_of_cpp(text)) for end, text in texts if end in {".cpp", ".h"})
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


def test_numbers_are_found():
    assert constants_of_cpp(
        "constexpr int kA = 3, kB = kC;\ninline constexpr double kD = 1.0 / 2;"
    ) == [
        *("kA", "kD"),
    ]
    python = "_A, _B = 0.5, name\n_C = -math.radians(5)\n_D = 'x'\n_E = [1]\ndef f():\n    g = 3"
    assert list(constants_of_python(python)) == ["_A", "_C"]
