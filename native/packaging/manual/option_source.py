# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what settings.py says of every option, for the entries of settings and of their choices."""

from __future__ import annotations

import ast

from .entries import Entry, Member
from .python_source import Source, add

Options = dict[str, dict[str, ast.expr]]  # of each option what its definition says, by keyword


def options(source: Source) -> Options:
    """Each option, as "OPTIONS['theta']" -> what its definition says; of all tables whose names end in OPTIONS."""
    found = {}
    for node in source.tree.body:
        target = node.target if isinstance(node, ast.AnnAssign) else None
        if target and ast.unparse(target).endswith("OPTIONS") and isinstance(node.value, ast.Dict):
            table = ast.unparse(target)
            for key, value in zip(node.value.keys, node.value.values):
                keywords = {keyword.arg: keyword.value for keyword in value.keywords}
                found[f"{table}['{key.value}']"] = keywords
    return found


def describe_choices(entry: Entry, known: Options) -> None:
    """Gives an enumeration its members, with the words that the option for it has for them."""
    for keywords in known.values():
        for key, value in _pairs(keywords.get("items")):
            owner, _, name = ast.unparse(key).partition(".")
            if owner == entry.name:
                add(entry, "Values", Member(name, "", ast.literal_eval(value)[1] + "."))


def describe_fields(entry: Entry, node: ast.AST, known: Options) -> None:
    """Gives settings their fields, with what the options say: default, range, unit, words."""
    for item in ast.iter_child_nodes(node):
        if isinstance(item, ast.AnnAssign) and item.value is not None:
            option = ast.unparse(item.value).removesuffix(".default")
            if option in known:
                add(entry, "Fields", _field(ast.unparse(item.target), known[option]))


def with_defaults(signature: str, known: Options) -> str:
    """A signature in which defaults that are those of options are written out."""
    for option, keywords in known.items():
        signature = signature.replace(f"{option}.default", ast.unparse(keywords["default"]))
    return signature


def _field(name: str, keywords: dict[str, ast.expr]) -> Member:
    said = {key: ast.unparse(value) for key, value in keywords.items() if key != "items"}
    limits = f", `{said['minimum']}` to `{said['maximum']}`" if "minimum" in said else ""
    unit = ast.literal_eval(said.get("unit", "''"))
    kind = f"default `{said['default']}`{limits}{' ' + unit if unit else ''}"
    return Member(name, kind, ast.literal_eval(keywords["description"]) + ".")


def _pairs(node: ast.expr | None) -> list[tuple[ast.expr, ast.expr]]:
    return list(zip(node.keys, node.values)) if isinstance(node, ast.Dict) else []
