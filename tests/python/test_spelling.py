# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of the docs are spelt as in British English, or are listed in words_of_the_docs.txt.

By hunspell with its British dictionary; where these are absent, the tests are skipped by name. The list holds terms of
the field, and names of people, programs and meshes, in any case.
"""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from support.package import ROOT
from test_docs import PAGES, prose

pytestmark = pytest.mark.docs

PAGES = [*PAGES, ROOT / "CONTRIBUTING.md"]
LIST = Path(__file__).with_name("words_of_the_docs.txt")
KNOWN = {word.lower() for word in LIST.read_text(encoding="utf-8").split()}
WORD = re.compile(r"[^\W\d_]+(?:'[^\W\d_]+)?")


def words(page):
    """The words of a page without code, addresses and HTML tags."""
    text = re.sub(r"`[^`\n]+`|\]\([^)]*\)|<[^>]+>|https?://\S+", " ", prose(page))
    return set(WORD.findall(text))


def unknown_to_hunspell(found):
    done = subprocess.run(
        ["hunspell", "-d", "en_GB", "-i", "utf-8", "-l"],
        input="\n".join(sorted(found)),
        capture_output=True,
        text=True,
    )
    if done.returncode:
        pytest.skip("hunspell has no dictionary en_GB: apt-get install hunspell-en-gb")
    return set(done.stdout.split())


@pytest.fixture(scope="module")
def unknown():
    """The list holds exactly the words of all pages that the dictionary lacks."""
    if shutil.which("hunspell") is None:
        pytest.skip("no hunspell: apt-get install hunspell hunspell-en-gb")
    assert unknown_to_hunspell({"colur", "color", "colour"}) == {"colur", "color"}
    return unknown_to_hunspell(set().union(*map(words, PAGES)))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_words_are_spelt_right(page, unknown):
    wrong = words(page) & unknown
    assert sorted(word for word in wrong if word.lower().removesuffix("'s") not in KNOWN) == []


def test_list_is_sorted():
    listed = LIST.read_text(encoding="utf-8").split()
    assert listed == sorted(set(listed), key=str.lower)
