# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed manual: every page, every picture, every link, what the search reads; and how a page is made."""

import ast
import html
import json
import os
import re
import subprocess
from pathlib import Path
from shutil import which

import pytest

pytest.importorskip("mkdocs", reason="Debian's mkdocs is not installed")
from support.manual import make_manual, one_page_config

from native.packaging import pack, paths

DOCS = paths.ROOT / "docs"
API = ("api_medial_axis", "api_python_module", "api_cpp")


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The manual as it is packed."""
    folder = tmp_path_factory.mktemp("manual")
    pack.make_manual(folder)
    return folder


@pytest.fixture
def page(tmp_path):
    """Makes a manual of one page beside a picture; returns the page's text."""

    def make(text):
        docs = tmp_path / "docs"
        docs.mkdir()
        (docs / "q.png").write_bytes(b"a picture")
        (docs / "page.md").write_text(text, encoding="utf-8")
        make_manual(one_page_config(tmp_path, "page.md"), tmp_path / "made")
        return (tmp_path / "made" / "page.html").read_text(encoding="utf-8")

    return make


def pages(folder):
    return {path: path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.html"))}


def article(text):
    return text[text.index("<article>") : text.index("<footer>")]


def sections(folder):
    """The rows that the search reads: address, title of the page, heading, text."""
    script = (folder / "search_index.js").read_text(encoding="utf-8")
    return json.loads(script.removeprefix("const sections = ").rstrip().removesuffix(";"))


# --- the whole


def test_pages_are_those_of_docs_and_of_the_interfaces(installed):
    wanted = [path.relative_to(DOCS).with_suffix(".html") for path in DOCS.rglob("*.md")]
    wanted += [Path(f"{name}.html") for name in API]
    assert sorted(path.relative_to(installed) for path in pages(installed)) == sorted(wanted)


def test_manual_pages_are_whole(installed):
    texts = pages(installed)
    for path, text in texts.items():
        for name, place in re.findall(r'href="(?!https?:)([^"#]*)(?:#([^"]+))?"', text):
            target = (path.parent / name).resolve() if name else path
            assert target.is_file(), (path.name, name)
            assert not place or f'id="{place}"' in target.read_text(), (path.name, name, place)


def test_every_page_is_in_the_list_of_pages(installed):
    texts = pages(installed)
    for path, text in texts.items():
        listed = text[text.index("<nav") : text.index("</nav>")]
        links = set(re.findall(r'href="([^"#]+)"', listed))
        assert links == {other.name for other in texts}, path.name
        assert listed.count('aria-current="page"') == 1


def test_pages_of_artists_come_first(installed):
    text = (installed / "user_guide.html").read_text()
    listed = text[text.index("<nav") : text.index("</nav>")]
    groups = re.findall(r"<h2>(.*?)</h2>", listed)
    assert groups == ["Use it", "How it works", "Quality and cost", "For programmers"]
    assert re.findall(r'href="([^"#]+)"', listed)[:2] == ["tutorial.html", "user_guide.html"]


def test_places_that_blender_opens_are_there(installed):
    """Those of ui/manual.py, read without Blender."""
    tree = ast.parse((paths.ADDON / "ui" / "manual.py").read_text())
    values = {
        node.targets[0].id: ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and node.targets[0].id in ("_PAGES", "_PLACES")
    }
    places = [*values["_PAGES"], *(place for _, place in values["_PLACES"])]
    assert len(places) > 15
    for name, _, place in (where.partition("#") for where in places):
        assert f'id="{place}"' in (installed / name).read_text() or not place, (name, place)


def test_pictures_are_there_and_no_others(installed):
    shown = {
        (path.parent / name).resolve()
        for path, text in pages(installed).items()
        for name in re.findall(r'<img [^>]*src="([^"]+)"', text)
    }
    suffixes = (".png", ".svg")
    assert shown == {p.resolve() for p in installed.rglob("*") if p.suffix in suffixes}


def test_every_picture_says_what_it_shows(installed):
    for path, text in pages(installed).items():
        for picture in re.findall(r"<img [^>]*>", text):
            said = re.search(r'alt="([^"]*)"', picture)
            assert said and len(said[1].split()) > 1, (path.name, picture)


def test_no_markdown_is_left(installed):
    """Rows of tables, lists, headings and stars that were not understood, outside code."""
    for path, text in pages(installed).items():
        prose = re.sub(r"<(pre|code)[ >].*?</\1>", "", text, flags=re.DOTALL)
        left = re.findall(r"^(?:\|.*\|$|[-*] |#+ |```).*|\*\*.*\*\*", prose, re.MULTILINE)
        assert not left, (path.name, left[:3])


def test_nothing_comes_from_the_network_or_from_others(installed):
    suffixes = {path.suffix for path in installed.rglob("*") if path.is_file()}
    assert suffixes == {".html", ".css", ".js", ".png", ".svg"}
    for text in pages(installed).values():
        assert not re.findall(r'(?:src="|<link [^>]*href=")(?:https?:)?//', text)
    own = {path.name: path.read_text() for path in installed.glob("*.[cj]s*")}
    assert sorted(own) == ["search.js", "search_index.js", "style.css"]
    assert "url(" not in own["style.css"] and "@import" not in own["style.css"]
    assert "fetch(" not in own["search.js"] and "import" not in own["search.js"]


def test_same_sources_same_bytes(installed, tmp_path, monkeypatch):
    """Also on another day: mkdocs takes its date from there."""
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000000000")
    pack.make_manual(tmp_path)
    names = sorted(path.relative_to(installed) for path in installed.rglob("*") if path.is_file())
    assert names == sorted(p.relative_to(tmp_path) for p in tmp_path.rglob("*") if p.is_file())
    for name in names:
        assert (installed / name).read_bytes() == (tmp_path / name).read_bytes(), name


# --- the search


def test_search_reads_every_heading(installed):
    """Each section of each page once, by its address, with its own words."""
    rows = sections(installed)
    wanted = {
        f"{path.name}#{place}": words(heading)
        for path, text in pages(installed).items()
        for place, heading in re.findall(r'<h[1-3] id="([^"]+)">(.*?)</h[1-3]>', article(text))
    }
    assert {address: heading for address, _, heading, _ in rows} == wanted
    assert len(rows) == len(wanted) > 300


def test_search_reads_every_word(installed):
    for path, text in pages(installed).items():
        read = " ".join(
            f"{heading} {body}"
            for address, _, heading, body in sections(installed)
            if address.startswith(f"{path.name}#")
        )
        assert sorted(read.split()) == sorted(words(article(text)).split()), path.name


def words(text):
    """What a person reads of some HTML."""
    inline = r"</?(?:a|b|code|em|i|kbd|span|strong|sub|sup)\b[^>]*>"
    return " ".join(html.unescape(re.sub(r"<[^>]+>", " ", re.sub(inline, "", text))).split())


# --- one page


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
    assert re.search(r'<a href="(page.html)?#a">x</a> <a href="https://z.org/b.md">y</a>', text)
    assert '<span>w</span> <a href="#a">v</a>' in text and 'src="q.png"' in text


def test_folded_parts_are_understood(page):
    text = page("# A\n\n<details><summary>More</summary>\n\n- **b**\n\n</details>\n")
    assert "<details><summary>More</summary>" in text.replace("\n", "")
    assert "<li><strong>b</strong></li>" in text


@pytest.mark.parametrize("link", ["![p](no.png)", "[p](no.md)", "[p](no.md#a)"])
def test_what_is_missing_is_an_error(page, link):
    with pytest.raises(AssertionError, match=r"page\.md.* contains a link .*no\.(png|md)"):
        page(f"# A\n\n{link}\n")


@pytest.mark.parametrize(
    ("listed", "said"),
    [
        ("page.md, no.md", "no.md"),
        ("", "expected page.md once in the list of pages, found it 0 times"),
        ("page.md, page.md", "expected page.md once in the list of pages, found it 2 times"),
    ],
)
def test_pages_must_be_listed_once(tmp_path, listed, said):
    (tmp_path / "docs").mkdir()
    for name in ("page.md", "other.md"):
        (tmp_path / "docs" / name).write_text("# A\n")
    with pytest.raises(AssertionError, match=said):
        make_manual(one_page_config(tmp_path, f"other.md, {listed}"), tmp_path / "made")


# --- in a browser


@pytest.mark.slow
def test_pages_fit_narrow_and_wide_windows_and_the_search_finds(installed, tmp_path, browser):
    """Nothing is wider than the window, so that wide tables scroll by themselves; all from files, without a server."""
    names = sorted(path.name for path in installed.glob("*.html"))
    frames = "".join(
        f'<iframe width="{width}" height="600" src="{installed.as_uri()}/{name}" onload="tell(this)"></iframe>'
        for name in names
        for width in (400, 1280)
    )
    tell = """<script>
function tell(frame) {
  const root = frame.contentDocument.documentElement;
  const row = document.createElement("i");
  row.textContent = [frame.src, root.scrollWidth - root.clientWidth].join(" ");
  document.body.append(row);
}
</script>"""
    (tmp_path / "all.html").write_text(f"<!DOCTYPE html><body>{tell}{frames}</body>")
    told = re.findall(r"<i>\S+/(\S+) (-?\d+)</i>", browser((tmp_path / "all.html").as_uri()))
    assert sorted(told) == sorted((name, "0") for name in names for _ in (400, 1280))

    found = browser(f"{installed.as_uri()}/user_guide.html?search=report+sampling")
    first = re.search(r'<h3><a href="([^"]+)">', found)[1]
    assert first.endswith("user_guide.html#report-sampling")
    assert '<article hidden="">' in found and "<mark>sampling</mark>" in found
    nothing = browser(f"{installed.as_uri()}/tutorial.html?search=no%3Csuch%3E%5Bword%5C")
    assert "<h1>0 places</h1>" in nothing


@pytest.fixture
def browser(tmp_path):
    """The page that an address shows, as HTML, when all scripts have run."""
    program = next((name for name in ("chromium", "chromium-browser") if which(name)), None)
    if program is None:
        pytest.skip("chromium is not installed")
    options = ["--headless=new", "--disable-gpu", "--allow-file-access-from-files", "--no-sandbox"]
    options += [f"--user-data-dir={tmp_path / 'profile'}", "--virtual-time-budget=60000"]

    def show(address):
        done = subprocess.run(
            [program, *options, "--dump-dom", address],
            capture_output=True,
            text=True,
            env={**os.environ, "HOME": str(tmp_path)},
            timeout=300,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return show
