# SPDX-License-Identifier: GPL-3.0-or-later
"""Every geometric constant says where it comes from, and no more are chosen (docs/lab/constants.md)."""

import pytest
from support.constants import ANY_CPP, TAGS, geometric, is_number, of_cpp, of_python

ALL, CHOSEN = 381, 260  # at most
FOUND = geometric()


def test_each_constant_says_where_it_comes_from():
    assert [f"{c.key}: end its comment with one of {TAGS}" for c in FOUND if not c.tag] == []


def test_there_are_no_more_constants():
    assert len([c for c in FOUND if c.tag != "work"]) <= ALL, "derive one, or remove one"
    assert len([c for c in FOUND if c.tag == "chosen"]) <= CHOSEN, "derive one, or remove one"


@pytest.mark.parametrize(
    ("read", "source", "found"),
    [
        (
            of_cpp,
            "// Both. derived: a\nconstexpr double kA = 1, kB = f(2, 3);\nconstexpr int kC = 4;",
            [("kA", 2, "Both. derived: a"), ("kB", 2, "Both. derived: a")],
        ),
        (of_cpp, "  static constexpr double kA =\n      1e-3;  // lengths", [("kA", 1, "lengths")]),
        (of_cpp, "constexpr double kA = 2 * kB;\nconstexpr double kC = kA;", [("kA", 1, "")]),
        (
            of_python,
            "_A, _B = 0.5, 2  # a\n_C = math.radians(5)\n_D = 1 / 4\n_E = re.compile('1.5')",
            [("_A", 1, "a"), ("_C", 2, ""), ("_D", 3, "")],
        ),
    ],
)
def test_constants_are_found(read, source, found):
    assert list(read(source)) == found


def test_whole_numbers_are_found_for_the_budgets():
    source = "constexpr int kA = 3, kB = kC;\ninline constexpr double kD = 1.0 / 2;"
    assert [name for name, *_ in of_cpp(source, ANY_CPP)] == ["kA", "kD"]
    source = "_A, _B = 0.5, name\n_C = -math.radians(5)\n_D = 'x'\n_E = [1]\n_F = 3"
    assert [name for name, *_ in of_python(source, is_number)] == ["_A", "_C", "_F"]
