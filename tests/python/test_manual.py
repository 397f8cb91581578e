# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed manual: every page, every picture, every link."""

import re
from pathlib import Path

import pytest

pytest.importorskip("markdown", reason="python3-markdown is not installed")
from native.packaging import manual

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The manual of docs/."""
    folder = tmp_path_factory.mktemp("manual")
    manual.make_manual(DOCS, folder)
    return folder


@pytest.fixture
def page(tmp_path):
    """Makes a manual of one page beside a picture; returns the page's text."""

    def make(text):
        docs = tmp_path / "docs"
        docs.mkdir()
        (docs / "q.png").write_bytes(b"a picture")
        (docs / "page.md").write_text(text, encoding="utf-8")
        manual.make_manual(docs, tmp_path / "made")
        return (tmp_path / "made" / "page.html").read_text(encoding="utf-8")

    return make


def pages(folder):
    return {path: path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.html"))}


def test_manual_pages_are_whole(installed):
    """Every page of docs/ is there, and every link between pages leads to a page and a heading."""
    texts = pages(installed)
    wanted = sorted(path.relative_to(DOCS).with_suffix(".html") for path in DOCS.rglob("*.md"))
    assert sorted(path.relative_to(installed) for path in texts) == wanted
    for path, text in texts.items():
        for name, place in re.findall(r'href="(?!https?:)([^"#]*)(?:#([^"]+))?"', text):
            target = (path.parent / name).resolve() if name else path
            assert target.is_file(), (path.name, name)
            assert not place or f'id="{place}"' in target.read_text(), (path.name, name, place)


def test_pictures_are_there_and_no_others(installed):
    shown = {
        (path.parent / name).resolve()
        for path, text in pages(installed).items()
        for name in re.findall(r'<img [^>]*src="([^"]+)"', text)
    }
    suffixes = (".png", ".svg")
    assert shown == {p.resolve() for p in installed.rglob("*") if p.suffix in suffixes}


def test_no_markdown_is_left(installed):
    """Rows of tables, lists, headings and stars that were not understood, outside code."""
    for path, text in pages(installed).items():
        prose = re.sub(r"<(pre|code)[ >].*?</\1>", "", text, flags=re.DOTALL)
        left = re.findall(r"^(?:\|.*\|$|[-*] |#+ |```).*|\*\*.*\*\*", prose, re.MULTILINE)
        assert not left, (path.name, left[:3])


def test_page_shows_tables_code_and_words(page):
    text = page(
        "# Big & *small*\n\na < b **c** `d`\n\n| x | y |\n|---|---|\n| 1 | 2 |\n\n```python\n# no heading\n```\n"
    )
    assert '<h1 id="big--small">Big &amp; <em>small</em></h1>' in text
    assert "a &lt; b <strong>c</strong> <code>d</code>" in text
    assert "<td>1</td>" in text and "# no heading\n</code></pre>" in text
    assert "<title>Big & *small*".replace("&", "&amp;") in text


def test_links_lead_to_pages_and_others_remain_words(page):
    text = page(
        "# A\n\n[x](page.md#a) [y](https://z.org/b.md) [w](../README.md) [v](#a)\n\n![p](q.png)\n"
    )
    assert '<a href="page.html#a">x</a> <a href="https://z.org/b.md">y</a>' in text
    assert '<span>w</span> <a href="#a">v</a>' in text and 'src="q.png"' in text


def test_folded_parts_are_understood(page):
    text = page("# A\n\n<details><summary>More</summary>\n\n- **b**\n\n</details>\n")
    assert "<details><summary>More</summary>" in text.replace("\n", "")
    assert "<li><strong>b</strong></li>" in text


def test_picture_that_is_missing_is_an_error(page):
    with pytest.raises(SystemExit, match=r"page\.md: expected a picture of docs/, found 'no\.png'"):
        page("# A\n\n![p](no.png)\n")
