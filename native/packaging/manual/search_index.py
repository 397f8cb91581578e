# SPDX-License-Identifier: GPL-3.0-or-later
"""What the search of the manual reads: every section of every page, as a script, for pages of files fetch nothing."""

from __future__ import annotations

import json
from html.parser import HTMLParser

_HEADINGS = ("h1", "h2", "h3")


def script(pages: list) -> str:
    """`const sections = [[address, title of the page, heading, text], ...]`, in the order of the pages."""
    rows = [
        [f"{page.file.url}{section.place}", page.title, section.heading, section.text]
        for page in pages
        for section in sections(page.content)
    ]
    lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)
    return f"const sections = [\n{lines}\n];\n"


class Section:
    """A heading and what stands below it, up to the next one."""

    def __init__(self, place: str) -> None:
        self.place = place  # such as '#the-settings'
        self._heading: list[str] = []
        self._text: list[str] = []

    @property
    def heading(self) -> str:
        return " ".join("".join(self._heading).split())

    @property
    def text(self) -> str:
        return " ".join("".join(self._text).split())


def sections(content: str) -> list[Section]:
    """The sections of the HTML of a page."""
    reader = _Reader()
    reader.feed(content)
    reader.close()
    return reader.found


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[Section] = []
        self._in_heading = False

    def handle_starttag(self, tag: str, attributes: list) -> None:
        if tag in _HEADINGS:
            self.found.append(Section(f"#{dict(attributes)['id']}"))
            self._in_heading = True
        elif tag not in _INLINE:
            self._add(" ")

    def handle_endtag(self, tag: str) -> None:
        if tag in _HEADINGS:
            self._in_heading = False

    def handle_data(self, data: str) -> None:
        self._add(data)

    def _add(self, text: str) -> None:
        if self.found:
            section = self.found[-1]
            (section._heading if self._in_heading else section._text).append(text)


_INLINE = ("a", "code", "em", "strong", "kbd", "span", "sub", "sup", "i", "b")
