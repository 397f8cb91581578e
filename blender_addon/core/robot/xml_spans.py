# SPDX-License-Identifier: GPL-3.0-or-later
"""The elements of an XML file with their places in its bytes, so that some are replaced and the others stay."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from xml.parsers import expat

from ..errors import ReadError

# This stands before an element on its line, with the end of the line before.
_LEAD = re.compile(rb"(\r?\n)?[ \t]*\Z")
_QUOTED_OR_END = re.compile(rb"\"[^\"]*\"|'[^']*'|>")


@dataclass
class Element:
    """An element."""

    tag: str
    attributes: dict[str, str]
    # Its first byte, and the one behind its last
    start: int
    end: int = 0
    children: list[Element] = field(default_factory=list)

    def all(self, tag: str) -> list[Element]:
        """Return the children of a tag."""
        return [child for child in self.children if child.tag == tag]

    def first(self, tag: str) -> Element | None:
        """Return the first child of a tag, or None."""
        return next(iter(self.all(tag)), None)

    def walk(self) -> Iterator[Element]:
        """Yield the element and everything in it."""
        yield self
        for child in self.children:
            yield from child.walk()


def elements_of(data: bytes) -> Element:
    """Return the root element of a file.

    Raises
    ------
    ReadError
        It is no XML in bytes that hold ASCII, or it declares entities, whose text has no place in the file.
    """
    top = Element("", {}, 0)
    inside, parser = [top], expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, parser.CurrentByteIndex)
        inside[-1].children.append(element)
        inside.append(element)

    def end(_tag: str) -> None:
        element = inside.pop()
        element.end = _end_of_tag(data, element.start)
        if data[element.end - 2 : element.end - 1] != b"/":  # it has a tag of its own for its end
            element.end = _end_of_tag(data, parser.CurrentByteIndex)

    def entity(*_given: object) -> None:
        raise ReadError("Expected no entities in the file, found a declaration; write them out")

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.EntityDeclHandler = entity
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ReadError(f"Expected XML, found '{error}'; check the file") from error
    if b"\0" in data:
        raise ReadError("Expected text in UTF-8, found UTF-16; save it as UTF-8")
    return top.children[0]


def replaced(
    data: bytes, edits: Iterable[tuple[Sequence[tuple[int, int]], Sequence[str]]]
) -> bytes:
    """Return a file in which groups of elements have become others.

    Parameters
    ----------
    data : bytes
    edits : iterable of (spans of elements, lines)
        The lines replace the first of the elements, in ASCII or else as references, and stand where it stood; the
        others go with their lines.
    """
    pieces: list[tuple[int, int, bytes]] = []
    for spans, lines in edits:
        for number, (start, end) in enumerate(spans):
            lead = _LEAD.search(data, max(0, start - 1000), start)
            before = b"" if lead is None else lead[0]
            new = before.join(line.encode("ascii", "xmlcharrefreplace") for line in lines)
            pieces.append((start - len(before), end, b"") if number else (start, end, new))
    done, at = [], 0
    for begin, end, new in sorted(pieces):
        done += [data[at:begin], new]
        at = end
    return b"".join([*done, data[at:]])


def _end_of_tag(data: bytes, start: int) -> int:
    """Return the place behind the tag that starts at a place; > may stand in quotes."""
    return next(found.end() for found in _QUOTED_OR_END.finditer(data, start) if found[0] == b">")
