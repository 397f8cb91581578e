# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/packaging/manual.py: the pages in the zip are whole, and every link and picture of theirs is there."""

import re

import pytest

from tools.packaging import manual, paths

pytest.importorskip("markdown")
pytestmark = pytest.mark.docs


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("manual")
    manual.write(folder)
    return folder


@pytest.fixture(params=manual.PAGES)
def page(request, folder):
    return (folder / f"{request.param}.html").read_text(encoding="utf-8")


def test_pages_have_their_headings_and_text(page):
    assert page.count("<h1") == 1
    assert len(re.sub("<[^>]+>", "", page).split()) > 200


def test_links_and_pictures_are_there(page, folder):
    targets = [t for t in re.findall(r'(?:href|src)="([^"]+)"', page) if not t.startswith("http")]
    assert targets
    for target in targets:
        name, _, place = target.partition("#")
        assert not name or (folder / name).is_file(), target
        if place:
            text = (folder / name).read_text(encoding="utf-8") if name else page
            assert f'id="{place}"' in text, target


def test_only_the_pictures_of_the_tutorial_come_along(folder):
    pictures = [path.name for path in folder.rglob("*.png")]
    assert len(pictures) == 10 and all(name.startswith("tutorial_") for name in pictures)


def test_links_to_pages_that_do_not_come_along_become_text():
    text = "[a](algorithm.md#x) [b](tutorial.md) [c](lab/quality.md) ![d](pictures/e.png)"
    found = manual.prepared("tutorial", text, {"tutorial": "T"})
    assert found == "a [b](tutorial.html) c ![d](pictures/e.png)"


def test_places_that_the_panels_open_are_there(folder):
    sources = [paths.ADDON / "ui" / name for name in ("base/manual.py", "settings/guide.py")]
    text = "".join(path.read_text(encoding="utf-8") for path in sources)
    places = set(re.findall(r'"(\w+\.html(?:#[\w-]+)?)"', text))
    assert len(places) > 8
    for place in places:
        name, _, anchor = place.partition("#")
        text = (folder / name).read_text(encoding="utf-8")
        assert not anchor or f'id="{anchor}"' in text, place
