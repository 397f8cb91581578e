# SPDX-License-Identifier: GPL-3.0-or-later
"""Every code word in the docs exists: identifiers, files and options between backticks occur in the sources."""

import ast
import functools
import re
from pathlib import Path

import pytest
from medial_axis.core.machine.memory_limit import LIMITS
from medial_axis.core.options import Switch
from medial_axis.core.settings import LOOKS, OPTIONS, THICKNESS_OPTIONS
from support.package import ROOT
from test_layers import SPAN, rows

from tests.wrap_docs import WRITTEN, wrap

pytestmark = pytest.mark.docs

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
# The folders in which the words of the docs are looked for, and those that a path in the docs may start from.
SOURCES = ("native", "blender_addon", "tests", "tools", "lab", "docs")
STARTS = (
    "lab/native", "", "native", "native/medial", "blender_addon", "blender_addon/core", "tests",
    "lab",
)  # fmt: skip
TEXTS = {
    ".py", ".pyi", ".h", ".cpp", ".txt", ".cmake", ".toml", ".sh", ".js", ".yaml", ".json",
    ".map",
}  # fmt: skip

# Words that do not occur in the sources, each with its origin.
FOREIGN = {
    "Parallel_tag": "CGAL",
    "suzanne_axis.py": "the user's own script",
    "template.yaml": "Open Job Description",
    "demo_output/": "made by build_addon.py demo",
    "build/": "made by cmake",
    "dist/": "made by build_addon.py build",
    "dist/medial_axis-VERSION.zip": "made by build_addon.py build",
    "OUTPUT.json": "made by the command line",
    "FOLDER/__main__.py": "FOLDER is the user's",
    "--local": "Blender's extension command",
    "--enable-autoexec": "Blender",
    "--disable-autoexec": "Blender",
}

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


@functools.cache
def files():
    tops = [path for path in ROOT.iterdir() if path.is_file() and path.name != "README.md"]
    found = [path for folder in SOURCES for path in (ROOT / folder).rglob("*") if path.is_file()]
    return [path for path in tops + found if "__pycache__" not in path.parts]


@pytest.fixture(scope="session")
def sources():
    """The text of all sources but this one, and the names of their files."""
    texts = [path for path in files() if path.suffix in TEXTS and path.name != "test_docs.py"]
    return "\n".join([*(path.read_text("utf-8") for path in texts), *(p.name for p in files())])


@pytest.fixture(scope="session")
def words(sources):
    """Every word of the sources, and those that are put together there."""
    put_together = {f"ma_{name}" for name in (*OPTIONS, *LOOKS)}
    return set(re.findall(r"\w+", sources)) | put_together


@pytest.fixture(scope="session")
def options(sources):
    """Every option of a command line in the sources, and those of the method."""
    names = ["--" + name for name in (*OPTIONS, *LIMITS, *THICKNESS_OPTIONS)]
    names += ["--no-" + name for name, option in OPTIONS.items() if isinstance(option, Switch)]
    return {name.replace("_", "-") for name in names} | set(OPTION.findall(sources))


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


# --- the table of algorithm.md


UNITS = (ROOT / "native" / "medial", ROOT / "lab" / "native")


def header_of(unit):
    """The header of a unit, in its room or among the public ones."""
    public = ROOT / "native/include/medial" / Path(unit).name
    places = (*(folder / unit for folder in UNITS), public)
    return next(path for place in places if (path := place.with_suffix(".h")).is_file())


def test_the_paper_is_found_in_the_code():
    """In each line all units exist, and all functions and fields are in their rooms or in a public header."""
    table = rows("algorithm.md", "| paper | where |")
    assert len(table) > 20
    for paper, _, where, what, *_ in table:
        folders = {header_of(unit).parent for unit in SPAN.findall(where)}
        for unit in SPAN.findall(where):
            folders |= {f for top in UNITS if (f := top / Path(unit).parent).is_dir()}
        folders.add(ROOT / "native" / "include" / "medial")
        paths = [path for folder in folders for path in folder.iterdir() if path.suffix in TEXTS]
        text = "".join(path.read_text(encoding="utf-8") for path in paths)
        for name in re.findall(r"\w+", " ".join(SPAN.findall(what))):
            assert re.search(rf"\b{name}\b", text), f"{paper}: {name}"


def test_names_of_the_library_in_the_examples_are_there():
    """Each name after `medial_axis.`, as in `medial_axis.compute(...)`, exists."""
    front = ast.parse((ROOT / "blender_addon" / "__init__.py").read_text(encoding="utf-8"))
    (offered,) = (
        ast.literal_eval(node.value)
        for node in front.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
    )
    fenced = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
    blocks = [block for page in PAGES for block in fenced.findall(page.read_text(encoding="utf-8"))]
    blocks = [block for block in blocks if "import medial_axis" in block]
    used = {name for block in blocks for name in re.findall(r"\bmedial_axis\.(\w+)", block)}
    assert len(used) > 3 and used <= set(offered)


# --- the stage pages

STAGES = (
    "stage_sampling", "stage_scan", "stage_delaunay", "stage_inside", "stage_tight_cocone",
    "stage_selection", "hierarchy", "stage_even", "stage_crisp", "stage_skeleton",
    "stage_thickness", "stage_balls", "stage_small_mesh", "stage_mid_surface",
)  # fmt: skip
HEADINGS = ["What", "Code", "Options", "Quality", "Cost", "Source"]


def stage_parts(stage):
    """The text below each heading of a stage page, by heading."""
    text = (ROOT / "docs" / f"{stage}.md").read_text(encoding="utf-8")
    _, *pieces = re.split(r"^## (.+)\n", text, flags=re.MULTILINE)
    return dict(zip(pieces[::2], pieces[1::2], strict=True))


def code_of(stage):
    """Every path between backticks below Code, as in a room, the core or the sources."""
    paths = [span for span in SPAN.findall(stage_parts(stage)["Code"]) if PATH.fullmatch(span)]
    assert paths, stage
    return paths


@pytest.mark.parametrize("stage", STAGES)
def test_stage_pages_have_the_same_skeleton(stage):
    """The same headings in the same order, none of them empty; and a drawing of what is done."""
    parts = stage_parts(stage)
    assert list(parts) == HEADINGS
    assert [heading for heading, text in parts.items() if not text.strip()] == []
    assert re.search(r"^!\[.+\]\(pictures/.+\)$", parts["What"], re.MULTILINE)


@pytest.mark.parametrize("stage", STAGES)
def test_code_of_a_stage_is_there(stage):
    """As the docs name files: from a room's folder, or below the folder that the table's head names."""
    skeleton = ROOT / "blender_addon" / "core" / "skeleton"
    away = [path for path in code_of(stage) if not (skeleton / path).is_file()]
    assert [path for path in away if not is_there(path)] == []


def test_pages_of_the_method_name_every_room_of_the_native_core():
    """The stages, and what follows an axis; the methods of others are no part of the method."""
    rooms = {path.name for path in (ROOT / "native" / "medial").iterdir() if path.is_dir()}
    named = " ".join(path for stage in STAGES for path in code_of(stage))
    assert {room for room in rooms if f"{room}/" in named} == rooms


def test_every_stage_page_is_in_the_index():
    index = (ROOT / "docs" / "algorithm.md").read_text(encoding="utf-8")
    assert [stage for stage in STAGES if f"({stage}.md)" not in index] == []
    found = {path.stem for path in (ROOT / "docs").glob("stage_*.md")}
    assert found <= set(STAGES)


def test_every_picture_has_an_alt_text(page):
    text = page.read_text(encoding="utf-8")
    assert [words for words in re.findall(r"!\[(.*?)\]\(", text) if len(words.split()) < 3] == []


def anchors(path):
    """The targets of links on a page: its headings, as code hosts name them, and places with an id."""
    text = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    made = {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}
    return made | set(re.findall(r'<a id="([^"]+)">', text))


def test_links_lead_somewhere(page):
    """To a file, and to a heading of it; addresses of the network are not asked."""
    wrong = []
    for target in re.findall(r"\]\((?!https?:|mailto:)([^)\s]+)\)", prose(page)):
        name, _, place = target.partition("#")
        path = page.parent / name if name else page
        if not path.exists() or (place and place not in anchors(path)):
            wrong.append(target)
    assert wrong == []


def test_every_page_is_once_in_the_navigation():
    """mkdocs.yml lists the pages of docs/; those of docs/lab are not part of the manual."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    listed = re.findall(r"^ +- (\S+\.md)$", text[text.index("\nnav:") :], re.MULTILINE)
    assert sorted(listed) == sorted(path.name for path in (ROOT / "docs").glob("*.md"))
    assert "\nexclude_docs: lab/\n" in text


# --- the width of lines

# Lines that cannot be broken: rows of tables, pictures, and commands, also in shell sessions.
WHOLE = re.compile(r"\|.*\|$|!\[|\s*(\$ |[A-Z_]+=\S+ )?(blender|openjd|python3|curl|sudo) ")


@pytest.mark.parametrize("path", [*PAGES, ROOT / "CONTRIBUTING.md"], ids=lambda path: path.name)
def test_lines_are_at_most_100_wide(path):
    text = path.read_text(encoding="utf-8")
    for mark in WRITTEN:
        text = text.partition(mark)[0]
    wide = [line for line in text.splitlines() if len(line) > 100 and not WHOLE.match(line)]
    assert wide == []


LONG = """\
# A heading that is kept

A paragraph whose words are moved, with `a code span that stays whole` and [a link](page.md#place) and
a number - such as 7. that is no item, and so on and on and on until the line is much too wide for it.

- An item, the second line of which is indented as the first one is, and which is a little longer than that.

    code = "is kept as it is, however long the line may be, for nobody knows where it may be broken"  # so

| a table | is kept as it is, however long the row may be, for it cannot be broken at all in any way |
"""


def test_wrapping_moves_words_and_changes_none():
    text = wrap(LONG)
    assert text.split() == LONG.split() and wrap(text) == text != LONG
    kept = [line for line in LONG.splitlines() if line.startswith(("#", "    ", "|"))]
    assert [line for line in text.splitlines() if line.startswith(("#", "    ", "|"))] == kept
    assert max(len(line) for line in text.splitlines() if line not in kept) <= 100
    assert "`a code span that stays whole`" in text
    assert not re.search(r"^(-|7\.) (such|that)", text, re.MULTILINE)


def test_the_docs_are_wrapped(page):
    """`python3 tests/wrap_docs.py` wraps them."""
    text = page.read_text(encoding="utf-8")
    assert wrap(text) == text


# --- the length of sentences

# Lists of what was done, and of what the add-on says.
LISTS = {"changelog.md", "troubleshooting.md"}
LONGEST = 40  # words


def sentences(path):
    """The sentences of paragraphs and items, not of tables, pictures, headings and generated text."""
    text = prose(path)
    for mark in WRITTEN:
        text = text.partition(mark)[0]
    text = "\n".join(line for line in text.splitlines() if not line.startswith(("|", "!", "#")))
    for paragraph in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", text):
        words = re.sub(r"\]\([^)]*\)", "]", paragraph)
        yield from re.split(r"(?<=[.!?])\*{0,2}\s+(?=[A-Z*`|(\[])", words)


def test_sentences_are_short(page):
    if page.name in LISTS:
        pytest.skip(f"{page.name} is a list")
    assert [text for text in sentences(page) if len(text.split()) > LONGEST] == []
