# SPDX-License-Identifier: GPL-3.0-or-later
"""Wraps the prose of the docs: lines of at most 100 characters, with the same words.

    python3 tests/wrap_docs.py [FILE ...]          default: docs/**/*.md, README.md, CONTRIBUTING.md

Code, tables, pictures, headings, and what scripts write below their mark stay as they are. Code between backticks and
short links are not torn apart.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WIDTH = 100
# Below these marks scripts write.
WRITTEN = ("<!-- Below this line stands what", "<!-- written by build_addon.py bench")
ITEM = re.compile(r"\s*(?:[-*]|\d+\.) +")
KEPT = re.compile(r"\s*\|.*\|\s*$|#|!\[|>|:::|\s*(?:<!--|</?details|</?summary)")
WHOLE = re.compile(r"(`[^`]+`|\[[^\]\[]{0,60}\]\([^)\s]*\))")
# At the beginning of a line these would be read as marks of lists, headings, quotes or tables.
MARK = re.compile(r"[-+*=|·]|#+|>|\d+[.)]|\|.*")


def words_of(text: str) -> list[str]:
    """The pieces that may move to the next line; a word that looks like a mark stays with the one before it."""
    found, word = [], ""
    for i, part in enumerate(WHOLE.split(text)):
        pieces = [part] if i % 2 else re.split(r"(\s+)", part)
        for piece in pieces:
            if piece.isspace():
                found.append(word)
                word = ""
            else:
                word += piece
    joined: list[str] = []
    for one in filter(None, [*found, word]):
        if joined and MARK.fullmatch(one):
            joined[-1] += " " + one
        else:
            joined.append(one)
    return joined


def filled(text: str, first: str, others: str) -> list[str]:
    """The lines of a paragraph; `first` and `others` are put before its first line and the others."""
    lines, line = [], first
    for i, word in enumerate(words_of(text)):
        if i and len(line) + 1 + len(word) > WIDTH:
            lines.append(line)
            line = others + word
        else:
            line += (" " if i else "") + word
    return [*lines, line]


def wrapped(paragraph: list[str]) -> list[str]:
    if not paragraph:
        return []
    item = ITEM.match(paragraph[0])
    lead = item[0] if item else re.match(r"\s*", paragraph[0])[0]
    text = " ".join([paragraph[0][len(lead) :].strip(), *map(str.strip, paragraph[1:])])
    return filled(text, lead, " " * len(lead))


def wrap(source: str) -> str:
    """A page with its prose wrapped."""
    cut = min((source.index(mark) for mark in WRITTEN if mark in source), default=len(source))
    out: list[str] = []
    paragraph: list[str] = []
    fenced = code = False
    for line in source[:cut].split("\n"):
        fence = line.lstrip().startswith("```")
        begins = not paragraph and not (out and out[-1].strip() and not out[-1].startswith(":::"))
        code = line.startswith("    ") and not paragraph and (code or begins)
        if fenced or fence or code or not line.strip() or KEPT.match(line):
            out += [*wrapped(paragraph), line]
            paragraph = []
        elif ITEM.match(line):
            out += wrapped(paragraph)
            paragraph = [line]
        else:
            paragraph.append(line)
        fenced ^= fence
    return "\n".join([*out, *wrapped(paragraph)]) + source[cut:]


def main(names: list[str]) -> None:
    pages = [*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    for page in map(Path, names) if names else pages:
        page.write_text(wrap(page.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
