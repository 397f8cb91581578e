# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the docstrings of a stub as a C++ header, for the bindings: the stub is their only home.

    python3 native/python/docstrings.py _medial.pyi docstrings.h

The docstring of a function f is docs::f, that of a member m of a class C docs::C_m, that of a module docs::about_ and
its name without the first underscore. The value of an enum has its docstring below it.
"""

import ast
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path

HEAD = """// Made by native/python/docstrings.py from {stub}; change that.
#pragma once

namespace medial::python::docs {{
"""
FOOT = "\n}  // namespace medial::python::docs\n"


def docstrings(module: str, tree: ast.Module) -> Iterator[tuple[str, str]]:
    """(name, text) of everything that has a docstring."""
    yield from _of(f"about{module}", tree)
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield from _of(node.name, node)
        elif isinstance(node, ast.ClassDef):
            yield from _of(node.name, node)
            yield from _of_members(node)


def _of(name: str, node: ast.Module | ast.ClassDef | ast.FunctionDef) -> Iterator[tuple[str, str]]:
    text = ast.get_docstring(node)
    if text:
        yield name, text


def _of_members(owner: ast.ClassDef) -> Iterator[tuple[str, str]]:
    for node, following in zip(owner.body, [*owner.body[1:], None], strict=True):
        if isinstance(node, ast.FunctionDef):
            yield from _of(f"{owner.name}_{node.name}", node)
        elif isinstance(node, ast.AnnAssign) and isinstance(following, ast.Expr):
            text = inspect.cleandoc(following.value.value)
            yield f"{owner.name}_{node.target.id}", text


def header(stub: Path) -> str:
    tree = ast.parse(stub.read_text(encoding="utf-8"))
    lines = [
        f'inline constexpr char {name}[] = R"doc({text})doc";'
        for name, text in docstrings(stub.stem, tree)
    ]
    return HEAD.format(stub=stub.name) + "\n" + "\n".join(lines) + "\n" + FOOT


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(header(Path(sys.argv[1])), encoding="utf-8")
