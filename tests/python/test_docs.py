# SPDX-License-Identifier: GPL-3.0-or-later
"""Every code word in the docs exists: identifiers, files and options between backticks occur in the sources."""

import ast
import re
from pathlib import Path

import pytest
from conftest import ROOT
from medial_axis.core.settings import (
    LIMITS,
    LOOKS,
    OPTIONS,
    RIVAL_OPTIONS,
    THICKNESS_OPTIONS,
    Switch,
)
from test_layers import CORE, MAY_IMPORT, MAY_INCLUDE

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
# The folders in which the words of the docs are looked for, and those that a path in the docs may start from.
SOURCES = ("native", "blender_addon", "tests", "docs")
STARTS = ("", "native", "native/medial", "blender_addon", "tests")
TEXTS = {
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

# Words that do not stand in the sources, each with whose it is.
FOREIGN = {
    "Parallel_tag": "CGAL",
    "suzanne_axis.py": "the user's own script",
    "template.yaml": "Open Job Description",
    "demo_output/": "made by build_addon.py demo",
    "dist/medial_axis-0.1.0.zip": "made by build_addon.py build",
    "OUTPUT.json": "made by the command line",
    "FOLDER/__main__.py": "FOLDER is the user's",
    "--local": "Blender's extension command",
    "--enable-autoexec": "Blender",
    "--disable-autoexec": "Blender",
}

SPAN = re.compile(r"`([^`\n]+)`")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
NAME = re.compile(r"(?<![\w$~-])[A-Za-z_]\w*(?![\w-])")
PATH = re.compile(
    r"[\w.-]+(?:/[\w.-]+)+/?|[\w-]+/|[\w-]+\.(?:py|pyi|h|cpp|js|yaml|json|toml|md|map)"
)


def prose(page):
    """A page without its fenced and indented examples."""
    text = page.read_text(encoding="utf-8")
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return "\n".join(line for line in text.splitlines() if not line.startswith("    "))


def spans(page):
    return [span for span in SPAN.findall(prose(page)) if span not in FOREIGN]


def files():
    tops = [path for path in ROOT.iterdir() if path.is_file() and path.name != "README.md"]
    found = [path for folder in SOURCES for path in (ROOT / folder).rglob("*") if path.is_file()]
    return [path for path in tops + found if "__pycache__" not in path.parts]


@pytest.fixture(scope="session")
def sources():
    """The text of all sources but this one, and the names of their files."""
    texts = [path for path in files() if path.suffix in TEXTS and path.name != "test_docs.py"]
    return "\n".join(
        [path.read_text(encoding="utf-8") for path in texts] + [p.name for p in files()]
    )


@pytest.fixture(scope="session")
def words(sources):
    """Every word of the sources, and those that are put together there."""
    put_together = {f"ma_{name}" for name in (*OPTIONS, *LOOKS)}
    return set(re.findall(r"\w+", sources)) | put_together


@pytest.fixture(scope="session")
def options(sources):
    """Every option of a command line in the sources, and those of the method."""
    names = (*OPTIONS, *RIVAL_OPTIONS, *LIMITS, *THICKNESS_OPTIONS)
    made = {"--" + name.replace("_", "-") for name in names}
    switches = [name for name, option in OPTIONS.items() if isinstance(option, Switch)]
    made |= {"--no-" + name.replace("_", "-") for name in switches}
    return made | set(OPTION.findall(sources))


def looks_like_code(word):
    """snake_case, or CamelCase with a small letter before a capital; no word of a sentence does."""
    return "_" in word.strip("_") or re.search("[a-z][A-Z]", word) is not None


def is_there(path):
    """A path from one of the starts, perhaps without extension; a bare name is looked for everywhere."""
    folders = [ROOT / start for start in STARTS]
    if any((folder / path).exists() or list(folder.glob(f"{path}.*")) for folder in folders):
        return True
    return "/" not in path and any(file.name == path for file in files())


@pytest.fixture(params=PAGES, ids=lambda page: page.name)
def page(request):
    return request.param


def test_identifiers_occur_in_the_sources(page, words):
    named = {n for span in spans(page) for n in NAME.findall(span) if looks_like_code(n)}
    assert sorted(named - words - set(FOREIGN)) == []


def test_members_of_classes_occur_in_the_sources(page, words):
    members = {m for span in spans(page) for m in re.findall(r"\b[A-Z]\w+(?:::|\.)(\w+)", span)}
    assert sorted(members - words) == []


def test_files_are_there(page):
    paths = {span for span in spans(page) if PATH.fullmatch(span)}
    assert sorted(path for path in paths if not is_there(path)) == []


def test_options_are_there(page, options):
    named = {option for span in spans(page) for option in OPTION.findall(span)}
    assert sorted(named - options - set(FOREIGN)) == []


def test_foreign_words_are_still_needed():
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert [word for word in FOREIGN if word not in text] == []


# --- tables of algorithm.md and architecture.md


def rows(page, head):
    """The cells of a table, by how its first line begins."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    table = text[text.index(head) :].partition("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table]


def header_of(unit):
    """The header of a unit, in its room or among the public ones."""
    places = (ROOT / "native" / "medial" / unit, ROOT / "native/include/medial" / Path(unit).name)
    return next(path for place in places if (path := place.with_suffix(".h")).is_file())


def test_the_paper_is_found_in_the_code():
    """Of each line all units exist, and all functions and fields stand in their rooms or in a public header."""
    table = rows("algorithm.md", "| paper | where |")
    assert len(table) > 20
    for paper, _, where, what, *_ in table:
        folders = {header_of(unit).parent for unit in SPAN.findall(where)}
        folders |= {ROOT / "native" / "medial" / Path(unit).parent for unit in SPAN.findall(where)}
        folders.add(ROOT / "native" / "include" / "medial")
        paths = [path for folder in folders for path in folder.iterdir() if path.suffix in TEXTS]
        text = "".join(path.read_text(encoding="utf-8") for path in paths)
        for name in re.findall(r"\w+", " ".join(SPAN.findall(what))):
            assert re.search(rf"\b{name}\b", text), f"{paper}: {name}"


def test_rooms_of_the_core_see_what_the_table_says():
    table = {
        SPAN.findall(room)[0]: set(SPAN.findall(sees))
        for room, _, sees in rows("architecture.md", "| room of the core |")
        if "`" in room
    }
    assert table == {room: seen for room, seen in MAY_INCLUDE.items() if room != "."}


def test_rooms_of_python_see_what_the_table_says():
    """Settings and errors, which all rooms see, are left out; so are the package and the compiled module."""
    for room, _, sees in rows("architecture.md", "| room of Python |"):
        (name,), seen = SPAN.findall(room), set(SPAN.findall(sees))
        if "all of `core`" in sees:
            seen |= CORE
        assert seen | {"core"} == MAY_IMPORT[name] - {"", "lib"} | {"core"}, name
    named = {SPAN.findall(room)[0] for room, *_ in rows("architecture.md", "| room of Python |")}
    assert named == set(MAY_IMPORT)


def test_names_of_the_library_in_the_examples_are_there():
    """Of `medial_axis.compute(...)` and the like."""
    front = ast.parse((ROOT / "blender_addon" / "__init__.py").read_text(encoding="utf-8"))
    (offered,) = (
        ast.literal_eval(node.value)
        for node in front.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
    )
    blocks = [
        block
        for page in PAGES
        for block in re.findall(
            r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
        )
        if "import medial_axis" in block
    ]
    used = {name for block in blocks for name in re.findall(r"\bmedial_axis\.(\w+)", block)}
    assert len(used) > 3 and used <= set(offered)
