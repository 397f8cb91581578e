# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the interfaces: all that is public stands there with its words, by other readers of the sources."""

import ast
import enum
import html
import inspect
import math
import re
from pathlib import Path

import pytest

pytest.importorskip("markdown", reason="Debian's mkdocs is not installed")
import markdown
import medial_axis
from medial_axis.core import settings

from native.packaging.manual import api_pages, cpp_source, python_source
from native.packaging.manual.entries import Entry, docstring, markdown_of, words

ROOT = Path(__file__).resolve().parents[2]
HEADERS = sorted((ROOT / "native" / "include" / "medial").glob("*.h"))
STUB = ast.parse((ROOT / "native" / "python" / "_medial.pyi").read_text())


def read(text):
    """What a person reads of a page of Markdown, in one line."""
    made = markdown.markdown(text, extensions=["tables", "fenced_code", "sane_lists"])
    return plain(html.unescape(re.sub(r"<[^>]+>", "", made)))


def plain(text):
    """Text without backticks, in one line."""
    return " ".join(text.replace("`", "").split())


MADE = api_pages.pages()
HEADINGS = {name: re.findall(r"^#{2,3} `(.+)`$", text, re.MULTILINE) for name, text in MADE.items()}


def section(page, name):
    """What stands under a heading, parts included."""
    text = MADE[page]
    found = re.search(rf"^(#+) `{re.escape(name)}`\n(.*?)(?=^#{{2}} |\Z)", text, re.M | re.S)
    return read(found[2])


def assert_said(text, where):
    """Every line of a docstring is there, but for the lines under the titles of its sections."""
    for line in filter(None, map(plain, text.splitlines())):
        assert set(line) == {"-"} or line in where, line


# --- _medial

DEFINED = [node for node in STUB.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))]


@pytest.mark.parametrize("node", DEFINED, ids=lambda node: node.name)
def test_module_page_has_all_of_the_stub(node):
    where = section("api_python_module.md", node.name)
    assert_said(ast.get_docstring(node), where)
    for item in node.body if isinstance(node, ast.ClassDef) else [node]:
        if isinstance(item, ast.AnnAssign):
            assert item.target.id in where.split()
        elif isinstance(item, ast.FunctionDef):
            given = item.args.args + item.args.kwonlyargs
            assert all(f"{arg.arg}:" in where for arg in given if arg.arg != "self")
            if item.name != "__init__":
                assert f"{item.name} :" in where or f"def {item.name}(" in where
                assert_said(ast.get_docstring(item), where)


def test_module_page_has_values_and_no_others():
    assert HEADINGS["api_python_module.md"].count("__version__") == 1
    top = [name for name in HEADINGS["api_python_module.md"] if "." not in name]
    assert top == [*(node.name for node in DEFINED), "__version__"]


def test_values_of_the_stub_have_their_comments():
    where = section("api_python_module.md", "SidesFrom")
    assert (
        "POLES 5: labels that go from pole to pole, and a vote of the samples by those of their own; "
        "needs the points only, and keeps cavities" in where
    )


# --- medial_axis


@pytest.mark.parametrize("name", medial_axis.__all__)
def test_package_page_has_all_that_is_public(name):
    """By the objects themselves, as Python has them."""
    thing = getattr(medial_axis, name)
    where = section("api_medial_axis.md", name)
    assert_said(inspect.getdoc(thing), where)
    if inspect.isfunction(thing):
        assert all(parameter in where for parameter in inspect.signature(thing).parameters)
    elif issubclass(thing, enum.Enum):
        assert [member for member in thing.__members__ if f"{member} " not in where] == []
    else:
        for key, value in vars(thing).items():
            text = inspect.getdoc(value) if not key.startswith("_") else None
            if isinstance(value, property) or inspect.isfunction(value):
                assert key.startswith("_") or text, f"{name}.{key} has no docstring"
                assert_said(text or "", where)


def test_package_page_has_no_others():
    top = [name for name in HEADINGS["api_medial_axis.md"] if "." not in name]
    assert sorted(top) == sorted(medial_axis.__all__)
    assert top[0] == "compute" and top[-1] == "ReadError", "functions first, errors last"


@pytest.mark.parametrize("name", settings.OPTIONS)
def test_fields_of_settings_say_their_defaults_ranges_and_units(name):
    option = settings.OPTIONS[name]
    text = MADE["api_medial_axis.md"]
    fields = text[text.index("**Fields**") :]
    found = re.search(
        rf"^- `{name}` : \*default `(.+?)`(?:, `(.+?)` to `(.+?)`)?(.*)\*  \n", fields, re.M
    )
    names = {**vars(settings), "math": math}
    assert eval(found[1], names) == option.default
    if found[2]:
        assert eval(found[2], names) == option.minimum and eval(found[3], names) == option.maximum
    assert found[4].strip() == getattr(option, "unit", "")
    assert plain(option.description) in read(fields)


def test_defaults_of_options_are_written_out():
    assert "count: int = 64" in section("api_medial_axis.md", "cover_by_balls")
    assert "OPTIONS" not in MADE["api_medial_axis.md"]


# --- medial::


@pytest.mark.parametrize("path", HEADERS, ids=lambda path: path.stem)
def test_cpp_page_has_all_of_a_header(path):
    """Types, functions and every comment that is not about what is private."""
    text = path.read_text()
    where = section("api_cpp.md", f"<medial/{path.name}>")
    names = re.findall(r"^(?:enum class|struct|class|using) (\w+)", text, re.MULTILINE)
    names += re.findall(r"^(?!using|struct|class)\w[\w:<>, ]* (\w+)\(", text, re.MULTILINE)
    assert names and set(names) <= set(HEADINGS["api_cpp.md"])
    public = re.sub(r"^ private:\n.*?(?=^};)", "", text, flags=re.MULTILINE | re.DOTALL)
    for comment in re.findall(r"^ *// (.+)$|;  // (.+)$", public, re.MULTILINE):
        line = re.sub(r"^ +(\w+)  +", r"\1: ", comment[0] or comment[1])
        assert line.startswith("SPDX") or plain(line) in where, line


def test_cpp_page_shows_no_bodies_and_nothing_private():
    page = MADE["api_cpp.md"]
    assert "return " not in page and "private:" not in page and "fraction_" not in page
    assert "void begin_stage(const char* name, double from, double to);" in page
    assert "Cancelled();" in page


@pytest.mark.parametrize("page", MADE)
def test_no_entry_is_empty(page):
    """Each has words beside its signature; a header has them before its first declaration."""
    parts = re.split(r"^#{2,3} `(.+)`$", MADE[page], flags=re.MULTILINE)[1:]
    for name, text in zip(parts[::2], parts[1::2]):
        prose = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
        assert len(prose.split()) > 1, name
    assert "\n    \n" not in MADE[page], "a value or property without words"


# --- how entries are written


def test_words_are_escaped_but_for_code_and_pages():
    given = "a_b_c *d* [e] p < q & `x_*_y`, see docs/formats.md | #"
    assert read(words(given)) == "a_b_c *d* [e] p < q & x_*_y, see docs/formats.md | #"
    assert "`x_*_y`" in words(given) and "(formats.md)" in words(given)


def test_sections_of_docstrings_are_lists():
    text = (
        "One.\n\n    an = example\n\nParameters\n----------\na, b : int\n    Two\n    lines.\n**c\n\n"
        "After them.\n\nRaises\n------\nE\n"
    )
    assert docstring(text) == (
        "One.\n\n    an = example\n\n**Parameters**\n\n- `a`, `b` : *int*  \n    Two lines.\n- `**c`\n\n"
        "After them.\n\n**Raises**\n\n- `E`"
    )


def test_declarations_of_a_header(tmp_path):
    (tmp_path / "a.h").write_text(
        "// SPDX\n// About\n// it.\n#pragma once\n\nnamespace medial {\n\n"
        "// Of both.\nusing A = int;\nusing B = long;\n\n"
        "template <typename T>\nstruct C : D<T> {  // begins\n  C() : D(1) {}\n  int f() const { return 1; }\n"
        "  // Kept.\n  int g(std::span<int> a = {}, int b = 0);\n\n private:\n  int x_ = 1;\n};\n\n"
        "inline int h(\n    int i) {\n  if (i) {\n    return 2;\n  }\n  return 3;\n}\n"
        "inline constexpr double kPi = 3;  // nearly\n\n}  // namespace medial\n"
    )
    about, entries = cpp_source.read_header(tmp_path / "a.h")
    assert about == "About\nit."
    assert [(entry.name, entry.text) for entry in entries] == [
        ("A", "Of both."),
        ("B", "Of both."),
        ("C", ""),
        ("h", ""),
        ("kPi", "nearly"),
    ]
    assert entries[2].signature == (
        "template <typename T>\nstruct C : D<T> {  // begins\n  C();\n  int f() const;\n"
        "  // Kept.\n  int g(std::span<int> a = {}, int b = 0);\n};"
    )
    assert entries[3].signature == "inline int h(\n    int i);"


def test_signatures_are_broken_where_they_are_long():
    def of(text):
        node = ast.parse(f"def {text}: ...").body[0]
        return python_source.signature(f"def {node.name}", node.args, " -> int")

    assert of("f(self, a: int = 1, *b, c=2, **d)") == "def f(a: int = 1, *b, c=2, **d) -> int"
    assert of("f(a, b, *, c: float = ...)") == "def f(a, b, *, c: float = ...) -> int"
    long = ", ".join(f"parameter_{number}: int = 0" for number in range(5))
    assert of(f"f({long})").splitlines()[1] == "    parameter_0: int = 0,"


def test_what_is_not_there_is_an_error(tmp_path):
    (tmp_path / "a.py").write_text("x = 1\n")
    source = python_source.Source(tmp_path / "a.py")
    with pytest.raises(SystemExit, match="expected __all__"):
        source.names()
    with pytest.raises(SystemExit, match="expected a definition of y"):
        source.origin("y")
    with pytest.raises(SystemExit, match="Expected a declaration, found 'int x;'"):
        cpp_source.name_of("int x;")


def test_entry_with_parts():
    part = Entry("A.f", "def f()", "python", "Does.")
    made = markdown_of(Entry("A", "class A", "python", "Is.", {}, [part]), 2)
    assert made == (
        "## `A`\n\n```python\nclass A\n```\n\nIs.\n\n### `A.f`\n\n```python\ndef f()\n```\n\nDoes."
    )
