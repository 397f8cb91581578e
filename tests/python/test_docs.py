"""Every code word in the docs exists: identifiers, files and options between backticks occur in the sources."""

import re
from pathlib import Path

import pytest
from conftest import ROOT

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
# Where the docs' names are looked for, and the folders that paths in the docs may start from.
SOURCES = ("native", "blender_addon", "tests")
TOP = ("build_addon.py", "CMakeLists.txt", "CMakePresets.json", "pyproject.toml", ".ci/run")
STARTS = ("", "docs", "native", "native/medial", "blender_addon", "tests")
KINDS = {
    ".py",
    ".pyi",
    ".h",
    ".cpp",
    ".txt",
    ".cmake",
    ".toml",
    ".sh",
    ".js",
    ".yaml",
    ".json",
    ".map",
}

# Words of others, and names of files that are made or chosen by users.
FOREIGN: set[str] = set()

SPAN = re.compile(r"`([^`\n]+)`")
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
NAME = re.compile(r"(?<![\w$.~-])[A-Za-z_]\w*(?![\w-])")
FILE = re.compile(r"[\w./{}#*~-]+\.(?:py|pyi|h|cpp|txt|cmake|toml|sh|js|yaml|json|md|map|po)\b")


def prose(page):
    """A page without its fenced and indented examples."""
    text = re.sub(
        r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL
    )
    return "\n".join(line for line in text.splitlines() if not line.startswith("    "))


def spans(page):
    return SPAN.findall(prose(page))


@pytest.fixture(scope="session")
def words():
    """Every word in the sources, but for those of this file."""
    files = [ROOT / name for name in TOP]
    for folder in SOURCES:
        files += [path for path in (ROOT / folder).rglob("*") if path.suffix in KINDS]
    texts = (path.read_text(encoding="utf-8") for path in files if path != Path(__file__).resolve())
    return {word for text in texts for word in re.findall(r"\w+", text)}


def looks_like_code(word):
    """snake_case, CamelCase with a small letter before a capital, or ma_x; sentences have none of these."""
    return "_" in word.strip("_") or re.search("[a-z][A-Z]", word) is not None


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_identifiers_occur_in_the_sources(page, words):
    named = {name for span in spans(page) for name in NAME.findall(span) if looks_like_code(name)}
    assert sorted(named - words - FOREIGN) == []
