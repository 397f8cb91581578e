# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the manual that is installed with the add-on: docs/ as web pages that need no network.

    python3 native/packaging/manual.py docs FOLDER

Needs the module markdown (python3-markdown). Links between pages lead to the page and the heading, pictures are
copied beside the pages, and of a link to a file that is not installed the words remain.
"""

from __future__ import annotations

import html
import os
import re
import shutil
import sys
from pathlib import Path
from urllib.parse import urlsplit
from xml.etree.ElementTree import Element

import markdown
from markdown.treeprocessors import Treeprocessor

STYLE = Path(__file__).with_name("manual.css")
FIRST = (
    "tutorial",
    "user_guide",
    "command_line",
    "troubleshooting",
    "formats",
)  # in the list of pages

# Markdown inside a part that is folded is read only when it is asked for.
_FOLDED = re.compile(r"<details><summary>(.*?)</summary>")
_UNDERSTOOD = r'<details markdown="1">\n<summary markdown="span">\1</summary>\n'

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title} - Medial Axis</title>
<link rel="stylesheet" href="{top}style.css">
</head>
<body>
<nav>{pages}</nav>
<main>
{body}
</main>
</body>
</html>
"""


def make_manual(docs: Path, folder: Path) -> None:
    """Every page of `docs` as a page in `folder`, and the pictures that they show."""
    texts = {path: path.read_text(encoding="utf-8") for path in sorted(docs.rglob("*.md"))}
    titles = {path.relative_to(docs): title_of(text) for path, text in texts.items()}
    for path, text in texts.items():
        body, pictures = render(text, path, docs)
        write_page(folder, path.relative_to(docs), titles, body)
        for picture in pictures:
            target = folder / picture.relative_to(docs)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(picture, target)
    shutil.copyfile(STYLE, folder / "style.css")


def title_of(text: str) -> str:
    """The words of the first heading."""
    return re.search(r"^# (.+)$", text, re.MULTILINE)[1].replace("`", "")


def render(text: str, page: Path, docs: Path) -> tuple[str, list[Path]]:
    """The HTML of a page, and the pictures of `docs` that it shows."""
    links = _Links(page, docs)
    toc = {"slugify": anchor, "permalink": False}
    converter = markdown.Markdown(
        extensions=["tables", "fenced_code", "sane_lists", "toc", "md_in_html"],
        extension_configs={"toc": toc},
        output_format="html",
    )
    converter.treeprocessors.register(links, "links", 0)  # the last, when all elements are there
    return converter.convert(_FOLDED.sub(_UNDERSTOOD, text)), links.pictures


def anchor(heading: str, _separator: str = "-") -> str:
    """The name of a heading in links, as code hosts make it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


class _Links(Treeprocessor):
    """Makes links and pictures of one page lead somewhere in the installed manual."""

    def __init__(self, page: Path, docs: Path) -> None:
        super().__init__()
        self.page, self.docs = page, docs.resolve()
        self.pictures: list[Path] = []

    def run(self, root: Element) -> None:
        for element in root.iter():
            if element.tag == "a":
                self._mend_link(element)
            elif element.tag == "img":
                self.pictures.append(self._file(element.get("src", "")))

    def _mend_link(self, link: Element) -> None:
        parts = urlsplit(link.get("href", ""))
        if parts.scheme or not parts.path:
            return  # to the network, or within the page
        target = self._path(parts.path)
        if target.suffix == ".md" and self.docs in target.parents:
            link.set("href", parts._replace(path=re.sub(r"md$", "html", parts.path)).geturl())
        else:
            link.tag = "span"
            link.attrib.clear()

    def _path(self, reference: str) -> Path:
        return Path(os.path.normpath(self.page.resolve().parent / reference))

    def _file(self, reference: str) -> Path:
        path = self._path(reference)
        if not path.is_file() or self.docs not in path.parents:
            raise SystemExit(f"{self.page}: expected a picture of docs/, found '{reference}'")
        return self.docs.joinpath(path.relative_to(self.docs))


def write_page(folder: Path, page: Path, titles: dict[Path, str], body: str) -> None:
    top = "../" * (len(page.parts) - 1)
    target = (folder / page).with_suffix(".html")
    target.parent.mkdir(parents=True, exist_ok=True)
    pages = "\n".join(
        f'<a href="{top}{other.with_suffix(".html").as_posix()}"'
        f"{' class=here' if other == page else ''}>{html.escape(titles[other])}</a>"
        for other in sorted(titles, key=rank)
    )
    text = PAGE.format(title=html.escape(titles[page]), top=top, pages=pages, body=body)
    target.write_text(text, encoding="utf-8")


def rank(page: Path) -> tuple:
    """Pages for artists come first, then those at the top, then those in folders."""
    name = page.with_suffix("").as_posix()
    return (FIRST.index(name) if name in FIRST else len(FIRST), len(page.parts), name)


if __name__ == "__main__":
    make_manual(Path(sys.argv[1]).resolve(), Path(sys.argv[2]))
