# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what a C++ header of ours offers: declarations, each with the comment that stands before it.

It knows the layout that clang-format gives these headers, and no more of C++ than that.
"""

from __future__ import annotations

import re
from pathlib import Path

from .entries import Entry

_NAMES = (
    r"^(?:template <.*>\s+)?(?:enum class|struct|class|using) (\w+)",
    r"constexpr [\w:<>]+ (\w+) =",
    r"(\w+)\(",
)
_BODY = re.compile(r"(\)(?: const| noexcept)*)(?:\s*: [\w:]+\([^{}]*\))? \{(?:[^{}]|\{[^{}]*\})*\}")


def read_header(path: Path) -> tuple[str, list[Entry]]:
    """The comment of the file, and its entries."""
    text = path.read_text(encoding="utf-8")
    head, _, rest = text.partition("namespace medial {\n")
    inside = rest.rpartition("}  // namespace medial")[0]
    about = [line[3:] for line in head.splitlines()[1:] if line.startswith("// ")]
    return "\n".join(about), [_entry(*found) for found in declarations(inside)]


def declarations(text: str) -> list[tuple[str, str]]:
    """(comment, code) of each declaration at the top of a namespace; a comment is for all up to an empty line."""
    found, comment, code = [], [], []
    for line in text.splitlines():
        if line.startswith("//") and not code:
            comment.append(line[3:])
        elif line or code:
            code.append(line)
            if is_whole("\n".join(code)):
                found.append(("\n".join(comment) or after(code[-1]), "\n".join(code)))
                code = []
        else:
            comment = []
    return found


def after(line: str) -> str:
    """The comment at the end of a line."""
    return line.partition("  // ")[2]


def is_whole(code: str) -> bool:
    """Whether lines are all of a declaration: it ends with a semicolon, or with the body of a function."""
    bare = re.sub(r"//.*|\"[^\"]*\"", "", code).rstrip()
    return bare.endswith((";", "}")) and bare.count("{") == bare.count("}")


def _entry(comment: str, code: str) -> Entry:
    return Entry(name_of(code), public(code), "cpp", comment)


def name_of(code: str) -> str:
    for pattern in _NAMES:
        if found := re.search(pattern, code):
            return found[1]
    raise SystemExit(f"Expected a declaration, found '{code.splitlines()[0]}'")


def public(code: str) -> str:
    """A declaration without private members and without the bodies of functions."""
    open_to_all = re.sub(r"\n+ private:\n.*(?=\n\};)", "", code, flags=re.DOTALL)
    return _BODY.sub(r"\1;", open_to_all)
