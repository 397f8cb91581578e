# SPDX-License-Identifier: GPL-3.0-or-later
"""An entry of an interface, read from a source, and how it is written as Markdown."""

from __future__ import annotations

import html
import re
from dataclasses import dataclass, field

_SECTION = re.compile(r"^(\w+)\n-{3,}\n", re.MULTILINE)  # of a docstring as NumPy writes them
_NAMED = re.compile(r"^ {2,3}(\w+)  +", re.MULTILINE)  # '  wall  of the balls ...' in a comment
_CODE = re.compile(r"(`+[^`]+`+|docs/\w+\.md)")  # and pages of the manual


@dataclass
class Member:
    """A value of an enumeration, or a property: its name, its type or '', and what it is."""

    name: str
    kind: str
    text: str


@dataclass
class Entry:
    """A class, a function, or what else has a name.

    `signature` is code; `text` is its docstring or comment; `members`, under their titles, have a line each; `parts`
    have a heading each.
    """

    name: str
    signature: str
    language: str
    text: str
    members: dict[str, list[Member]] = field(default_factory=dict)
    parts: list[Entry] = field(default_factory=list)


def markdown_of(entry: Entry, level: int) -> str:
    """An entry with a heading of some level, and its parts a level deeper."""
    blocks = [code(entry.signature, entry.language), docstring(entry.text)]
    if entry.language == "cpp":
        blocks.reverse()  # as it stands in the header
    blocks.insert(0, f"{'#' * level} `{entry.name}`")
    for title, members in entry.members.items():
        blocks.append(f"**{title}**\n\n" + "\n".join(map(_line, members)))
    blocks += [markdown_of(part, level + 1) for part in entry.parts]
    return "\n\n".join(blocks)


def _line(member: Member) -> str:
    kind = f" : *{words(member.kind)}*" if member.kind else ""
    return f"- `{member.name}`{kind}  \n    {words(member.text)}"


def code(text: str, language: str) -> str:
    return f"```{language}\n{text}\n```"


def words(text: str) -> str:
    """Text as one line of Markdown: what stands in backticks is code, all else is as it is written."""
    pieces = _CODE.split(" ".join(text.split()))
    return "".join(
        _link(piece) if number % 2 else _escape(piece) for number, piece in enumerate(pieces)
    )


def _escape(text: str) -> str:
    return re.sub(r"([\\*_\[\]#|])", r"\\\1", html.escape(text, quote=False))


def _link(piece: str) -> str:
    page = piece.removeprefix("docs/")
    return piece if page == piece else f"[{_escape(piece)}]({page})"


def docstring(text: str) -> str:
    """A docstring as NumPy writes them: paragraphs, then sections of named items."""
    first, *rest = _SECTION.split(text)
    blocks = [paragraphs(first)]
    for title, body in zip(rest[::2], rest[1::2]):
        listed, *more = re.split(r"\n\n(?=\S)", body)  # a paragraph at the margin ends the list
        blocks += [f"**{title}**\n\n{items(listed)}", *map(paragraphs, more)]
    return "\n\n".join(block for block in blocks if block)


def items(body: str) -> str:
    """Lines that begin at the margin are items, such as 'points : (n, 3) floats'; those below say what they are."""
    found: list[tuple[str, list[str]]] = []
    for line in filter(str.strip, body.splitlines()):
        if line.startswith(" "):
            found[-1][1].append(line)
        else:
            found.append((line, []))
    return "\n".join(_item(head, " ".join(lines)) for head, lines in found)


def _item(head: str, text: str) -> str:
    names, colon, kind = head.partition(" : ")
    listed = ", ".join(f"`{name.strip()}`" for name in names.split(","))
    kind = f" : *{words(kind)}*" if colon else ""
    return f"- {listed}{kind}" + (f"  \n    {words(text)}" if text.strip() else "")


def paragraphs(text: str) -> str:
    """Paragraphs; in them what is set in is an example, or a list of names and what they mean."""
    return "\n\n".join(_paragraph(block) for block in re.split(r"\n\s*\n", text) if block.strip())


def _paragraph(block: str) -> str:
    if all(line.startswith("    ") for line in block.splitlines()):
        return block
    head, *named = _NAMED.split(block)
    listed = [f"- `{name}`: {words(text)}" for name, text in zip(named[::2], named[1::2])]
    return "\n\n".join(filter(None, [words(head), "\n".join(listed)]))
