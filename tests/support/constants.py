# SPDX-License-Identifier: GPL-3.0-or-later
"""The geometric constants of the product: its named numbers that are floating, in the core and its rooms of geometry.

Whole numbers are counts, sizes of work and values of enumerations. The comment of a constant is on its line, or above.
"""

import ast
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ["shape", "samples", "curves", "axis", "thickness", "mid_surface", "hollow", "cover"]
ROOMS += ["rebuild", "skeleton", "rig"]
_CPP = r"^(?P<indent> *)(?:inline |static )*constexpr (?P<type>%s)\s+(?P<rest>k[^;]*);(?P<tail>.*)"
CPP = re.compile(_CPP % "double|float", re.M)
ANY_CPP = re.compile(_CPP % r"[\w:<>]+", re.M)
DECLARED = re.compile(r"(k[A-Z]\w*)\s*=\s*((?:[^,(]|\([^)]*\))*)")
TAGS = ("derived", "measured", "chosen", "work")  # work: time, memory, or what is shown; no result
TAG = re.compile(rf"\b({'|'.join(TAGS)}): ")


@dataclass(frozen=True)
class Constant:
    file: str  # from the root
    name: str
    line: int
    comment: str

    @property
    def key(self):
        return f"{self.file}:{self.name}"

    @property
    def tag(self):
        """The last tag of the comment, or nothing."""
        return (TAG.findall(self.comment) or [""])[-1]


def _comment(lines, first, last, mark):
    """The comment on the lines first to last, or else the whole one above them."""
    beside = " ".join(line.partition(mark)[2].strip() for line in lines[first:last] if mark in line)
    above = []
    while not beside and first > 0 and lines[first - 1].lstrip().startswith(mark):
        first -= 1
        above.insert(0, lines[first].lstrip()[len(mark) :].strip())
    return beside or " ".join(above)


def of_cpp(source, declared=CPP):
    """(name, line, comment) of each."""
    lines = source.split("\n")
    for found in declared.finditer(source):
        first, last = (source.count("\n", 0, at) for at in (found.start(), found.end()))
        for name, value in DECLARED.findall(found["rest"]):
            if re.search(r"\d", value):
                yield name, first + 1, _comment(lines, first, last + 1, "//")


def is_number(value):
    """Whether an expression is a number that somebody wrote: 0.5, -1, 1 / 256, math.radians(5)."""
    parts = [n for n in ast.walk(value) if isinstance(n, ast.expr)]
    numbers = [n.value for n in parts if isinstance(n, ast.Constant)]
    kinds = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.Call, ast.Attribute, ast.Name)
    are_numbers = bool(numbers) and all(type(n) in (int, float) for n in numbers)
    return are_numbers and all(isinstance(n, kinds) for n in parts)


def is_floating(value):
    """Whether it is one and not a whole one."""
    if not is_number(value):
        return False
    parts = list(ast.walk(value))
    has_float = any(isinstance(n, ast.Constant) and type(n.value) is float for n in parts)
    return has_float or any(isinstance(n, (ast.Call, ast.Div)) for n in parts)


def of_python(source, counts=is_floating):
    """(name, line, comment) of each."""
    lines = source.split("\n")
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target, value = node.targets[0], node.value
            pairs = [(target, value)]
            if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
                pairs = list(zip(target.elts, value.elts, strict=True))
            for t, v in pairs:
                if isinstance(t, ast.Name) and counts(v):
                    yield t.id, node.lineno, _comment(lines, node.lineno - 1, node.end_lineno, "#")


def geometric():
    """All of them, in the order of files and lines."""
    native, core = ROOT / "native" / "medial", ROOT / "blender_addon" / "core"
    files = [*sorted(native.rglob("*.h")), *sorted(native.rglob("*.cpp"))]
    files += [path for room in ROOMS for path in sorted((core / room).glob("*.py"))]
    found = []
    for path in files:
        read = of_python if path.suffix == ".py" else of_cpp
        name = path.relative_to(ROOT).as_posix()
        found += [Constant(name, *rest) for rest in read(path.read_text(encoding="utf-8"))]
    return found
