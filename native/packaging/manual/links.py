# SPDX-License-Identifier: GPL-3.0-or-later
"""Headings, links and pictures of a page: their names, and where they lead."""

from __future__ import annotations

import posixpath
import re
from urllib.parse import urlsplit
from xml.etree.ElementTree import Element

from markdown import Markdown
from markdown.extensions import Extension
from markdown.treeprocessors import Treeprocessor

_PICTURE = re.compile(r'<img [^>]*?src="([^"]+)"')


def anchor(heading: str, _separator: str = "-") -> str:
    """The name of a heading in links, as code hosts make it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def title_of(text: str) -> str:
    """The words of the first heading."""
    return re.search(r"^# (.+)$", text, re.MULTILINE)[1].replace("`", "")


def pictures(content: str, page: str) -> list[str]:
    """The pictures that the HTML of a page shows, by their paths below docs/."""
    folder = posixpath.dirname(page)
    return [posixpath.normpath(posixpath.join(folder, name)) for name in _PICTURE.findall(content)]


class LinksExtension(Extension):
    """Of links to files that are not installed, because they lie outside docs/, the words remain."""

    page = ""  # the one that is converted, by its path below docs/

    def extendMarkdown(self, md: Markdown) -> None:  # noqa: N802 - as Markdown calls it
        # After links are elements (20), and before mkdocs looks where they lead (0).
        md.treeprocessors.register(_Words(self), "words", 1)


class _Words(Treeprocessor):
    def __init__(self, extension: LinksExtension) -> None:
        super().__init__()
        self.extension = extension

    def run(self, root: Element) -> None:
        for link in root.iter("a"):
            parts = urlsplit(link.get("href", ""))
            path = posixpath.join(posixpath.dirname(self.extension.page), parts.path)
            if not parts.scheme and posixpath.normpath(path).startswith("../"):
                link.tag = "span"
                link.attrib.clear()
