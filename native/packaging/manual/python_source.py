# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what Python sources offer: classes, functions and values with their signatures and docstrings.

Nothing is imported: what a source needs, such as the compiled module, need not be there.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

from .entries import Entry, Member

_WIDE = 88  # characters of a signature in one line


class Source:
    """A file of Python."""

    def __init__(self, path: Path) -> None:
        text = path.read_text(encoding="utf-8")
        self.path = path
        self.lines = text.splitlines()
        self.tree = ast.parse(text)
        self.docstring = ast.get_docstring(self.tree) or ""

    def definitions(self) -> dict[str, ast.AST]:
        """name -> class or function, in order."""
        kinds = (ast.ClassDef, ast.FunctionDef)
        return {node.name: node for node in self.tree.body if isinstance(node, kinds)}

    def values(self) -> list[Entry]:
        """The names at the top that have a type and no value."""
        nodes = [node for node in self.tree.body if isinstance(node, ast.AnnAssign)]
        return [
            Entry(ast.unparse(node.target), ast.unparse(node), "python", self.comment(node))
            for node in nodes
            if node.value is None
        ]

    def names(self) -> list[str]:
        """Those of `__all__`."""
        for node in self.tree.body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
                return ast.literal_eval(node.value)
        raise SystemExit(f"{self.path}: expected __all__, found none")

    def origin(self, name: str) -> Source:
        """The source that defines a name, which is this one or one that this one imports it from."""
        if name in self.definitions():
            return self
        for node in self.tree.body:
            if isinstance(node, ast.ImportFrom) and name in [alias.name for alias in node.names]:
                folder = self.path.parents[node.level - 1]
                return Source(folder.joinpath(*node.module.split(".")).with_suffix(".py")).origin(
                    name
                )
        raise SystemExit(f"{self.path}: expected a definition of {name}, found none")

    def entry(self, name: str) -> Entry:
        """The entry of a name that this source defines."""
        node = self.definitions()[name]
        return self._class(node) if isinstance(node, ast.ClassDef) else self._function(node)

    def _function(self, node: ast.FunctionDef, owner: str = "") -> Entry:
        name = f"{owner}.{node.name}" if owner else node.name
        result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        text = ast.get_docstring(node) or ""
        return Entry(name, signature(f"def {node.name}", node.args, result), "python", text)

    def _class(self, node: ast.ClassDef) -> Entry:
        entry = Entry(node.name, "", "python", ast.get_docstring(node) or "")
        bases = f"({', '.join(map(ast.unparse, node.bases))})" if node.bases else ""
        entry.signature = f"class {node.name}{bases}"
        for item in node.body:
            if isinstance(item, ast.FunctionDef):
                self._member(entry, node, item)
            elif isinstance(item, (ast.AnnAssign, ast.Assign)) and (text := self.comment(item)):
                name = ast.unparse(
                    item.target if isinstance(item, ast.AnnAssign) else item.targets[0]
                )
                add(entry, "Values", Member(name, "", text))
        return entry

    def _member(self, entry: Entry, owner: ast.ClassDef, node: ast.FunctionDef) -> None:
        decorators = [ast.unparse(decorator) for decorator in node.decorator_list]
        if node.name == "__init__":
            if len(node.args.args) + len(node.args.kwonlyargs) > 1:
                entry.signature = signature(f"class {owner.name}", node.args, "")
        elif node.name.startswith("_"):
            return
        elif {"property", "cached_property"} & set(decorators):
            text = ast.get_docstring(node) or ""
            add(entry, "Properties", Member(node.name, ast.unparse(node.returns), text))
        else:
            entry.parts.append(self._function(node, owner.name))

    def comment(self, node: ast.stmt) -> str:
        """The comment at the end of a statement, and the lines of it that follow."""
        found = []
        first = self.lines[node.end_lineno - 1][node.end_col_offset :]
        for line in [first, *self.lines[node.end_lineno :]]:
            text = re.match(r"\s*# (.*)", line)
            if not text:
                break
            found.append(text[1])
        return " ".join(found)


def add(entry: Entry, title: str, member: Member) -> None:
    entry.members.setdefault(title, []).append(member)


def signature(head: str, arguments: ast.arguments, result: str) -> str:
    """A signature without `self`: in one line where it fits, or with a line for each parameter."""
    if arguments.args and arguments.args[0].arg in ("self", "cls"):
        arguments.args = arguments.args[1:]
    pieces = _parameters(arguments)
    line = f"{head}({', '.join(pieces)}){result}"
    if len(line) <= _WIDE:
        return line
    rows = "".join(f"    {piece},\n" for piece in pieces)
    return f"{head}(\n{rows}){result}"


def _parameters(arguments: ast.arguments) -> list[str]:
    plain = len(arguments.args) - len(arguments.defaults)
    pieces = [
        _parameter(argument, arguments.defaults[number - plain] if number >= plain else None)
        for number, argument in enumerate(arguments.args)
    ]
    if arguments.vararg or arguments.kwonlyargs:
        pieces.append(f"*{ast.unparse(arguments.vararg) if arguments.vararg else ''}")
    pieces += map(_parameter, arguments.kwonlyargs, arguments.kw_defaults)
    return pieces + ([f"**{ast.unparse(arguments.kwarg)}"] if arguments.kwarg else [])


def _parameter(argument: ast.arg, default: ast.expr | None) -> str:
    text = ast.unparse(argument)
    equals = " = " if argument.annotation else "="
    return text if default is None else f"{text}{equals}{ast.unparse(default)}"
