# SPDX-License-Identifier: GPL-3.0-or-later
"""The user pages of docs/ as plain web pages, for readers without a network; Python-Markdown converts them.

    python3 tools/packaging/manual.py FOLDER

Only the pictures of the tutorial come along. Other pictures, and pages that are not in PAGES, lead nowhere offline, so
a picture is left out and a link to another page becomes its text. mkdocs.yml describes the complete manual.
"""

from __future__ import annotations

import html
import re
import shutil
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGES = (
    "tutorial",
    "user_guide",
    "thickness",
    "skeleton",
    "balls",
    "mid_surface",
    "hollow",
    "solidify",
    "small_mesh",
    "parts",
    "command_line",
    "formats",
    "limits",
    "troubleshooting",
)
ILLUSTRATED = "tutorial"
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body {{ max-width: 50em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 sans-serif; }}
table {{ border-collapse: collapse; }} td, th {{ border: 1px solid #ccc; padding: 0.2em 0.6em; }}
pre {{ background: #f4f4f4; padding: 0.6em; overflow-x: auto; }} img {{ max-width: 100%; }}
</style></head><body><p>{menu}</p>
{body}
</body></html>
"""


def write(folder: Path, docs: Path = DOCS) -> None:
    """Write a page for each of PAGES that is there, and the pictures that they show."""
    import markdown  # only the Python that runs this as a script needs it

    texts = {name: docs / f"{name}.md" for name in PAGES if (docs / f"{name}.md").is_file()}
    texts = {name: path.read_text(encoding="utf-8") for name, path in texts.items()}
    titles = {name: re.search(r"^# (.+)$", text, re.MULTILINE)[1] for name, text in texts.items()}
    menu = " · ".join(f'<a href="{name}.html">{title}</a>' for name, title in titles.items())
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        body = markdown.markdown(
            prepared(name, text, titles),
            extensions=["tables", "fenced_code", "sane_lists", "toc", "md_in_html"],
        )
        page = PAGE.format(title=html.escape(titles[name]), menu=menu, body=body)
        (folder / f"{name}.html").write_text(page, encoding="utf-8")
    copy_pictures(texts.get(ILLUSTRATED, ""), docs, folder)


def prepared(name: str, text: str, titles: dict[str, str]) -> str:
    """The page with links that hold offline."""
    if name != ILLUSTRATED:
        text = re.sub(r"^!\[[^\]]*\]\([^)]*\)\n", "", text, flags=re.MULTILINE)

    def link(found: re.Match[str]) -> str:
        label, page, place = found.groups()
        return f"[{label}]({page}.html{place or ''})" if page in titles else label

    text = re.sub(r"(?<!!)\[([^\]]*)\]\(([\w/]+)\.md(#[^)]*)?\)", link, text)
    return re.sub(r"(?<!!)\[([^\]]*)\]\(\.\./[^)]*\)", r"\1", text)  # files of the checkout


def copy_pictures(text: str, docs: Path, folder: Path) -> None:
    for picture in re.findall(r"!\[[^\]]*\]\((pictures/[^)]+)\)", text):
        (folder / picture).parent.mkdir(exist_ok=True)
        shutil.copyfile(docs / picture, folder / picture)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
