# SPDX-License-Identifier: GPL-3.0-or-later
"""Comments and docstrings are whole sentences: none begins as a clause without its subject."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[2]
PYTHON = ("blender_addon", "native", "tools", "tests", "lab")
CPP = ("native", "tests", "lab")

RIDDLE = re.compile(
    r"(Of|That of|Those|What|Whose|Has)\b(?!-)|(Where)\b(?! there\b)[^.,:;]*\bthere\b",
)

# A string is matched before a comment, so that neither hides in the other.
CPP_TOKEN = re.compile(
    r'R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"'
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"
    r"|(?P<comment>//[^\n]*|/\*.*?\*/)",
    re.DOTALL,
)


class Comment(NamedTuple):
    line: int  # the first line, from 1
    text: str  # without the marks of the comment


class Token(NamedTuple):
    line: int  # from 1
    column: int  # from 0
    raw: str
    alone: bool  # no code on its first line before it


def cpp_comments(source: str) -> list[Comment]:
    found = []
    for token in CPP_TOKEN.finditer(source):
        if token["comment"]:
            start = source.rfind("\n", 0, token.start()) + 1
            before = source[start : token.start()]
            line = source.count("\n", 0, start) + 1
            found.append(Token(line, len(before), token["comment"], not before.strip()))
    return _blocks(found)


def python_comments(source: str) -> list[Comment]:
    found = []
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            line, column = token.start
            found.append(Token(line, column, token.string, not token.line[:column].strip()))
    return _blocks(found) + list(_docstrings(ast.parse(source)))


def _docstrings(tree: ast.Module) -> Iterator[Comment]:
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            text = ast.get_docstring(node)
            if text:
                yield Comment(node.body[0].lineno, text.strip())


def _blocks(tokens: list[Token]) -> list[Comment]:
    """Joins each comment to the one on the line above if it begins in the same column and no code is before it."""
    blocks: list[Comment] = []
    above = (-1, 0)  # the last line and the column of the comment before
    for token in tokens:
        text = " ".join(line.strip(" \t/*#!<") for line in token.raw.splitlines()).strip()
        if text.startswith("SPDX-"):
            continue
        if token.alone and above == (token.line - 1, token.column):
            blocks[-1] = Comment(blocks[-1].line, f"{blocks[-1].text} {text}".strip())
        else:
            blocks.append(Comment(token.line, text))
        above = (token.line + token.raw.count("\n"), token.column)
    return blocks


def riddle(text: str) -> str | None:
    """The words at the start of a comment that leave its subject out."""
    match = RIDDLE.match(text)
    return match and (match[1] or "Where ... there")


def comments_of_all_files() -> Iterator[tuple[Path, Comment]]:
    for folders, endings, comments in (
        (PYTHON, {".py"}, python_comments),
        (CPP, {".cpp", ".h"}, cpp_comments),
    ):
        paths = [path for folder in folders for path in (ROOT / folder).rglob("*.*")]
        for path in sorted([*paths, ROOT / "build_addon.py"]):
            if path.suffix in endings:
                for comment in comments(path.read_text(encoding="utf-8")):
                    yield path.relative_to(ROOT), comment


def riddles() -> list[tuple[Path, Comment, str]]:
    return [(path, c, start) for path, c in comments_of_all_files() if (start := riddle(c.text))]


def message(path: Path, comment: Comment, start: str) -> str:
    said = f"a comment begins with '{start}': write a sentence with its subject"
    return f"{path}:{comment.line}: {said}"


def test_no_comment_begins_without_its_subject():
    found = [message(*place) for place in riddles()]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    "text",
    [
        "Of the samples, their poles.",
        "That of the source.",
        "Those that stay.",
        "What follows is sorted.",
        "Whose vertices are given.",
        "Has the axis computed again.",
        "Where parts overlap there are none.",
    ],
)
def test_a_clause_without_a_subject_is_found_in_each_kind_of_comment(text):
    python = f'def f():\n    """{text}"""\n    x = 1  # {text}\n    # {text}\n'
    cpp = f'const char *s = "// no comment";\n// {text}\nint i; // {text}\n/** {text} */\n'
    assert [c.line for c in python_comments(python) if riddle(c.text)] == [3, 4, 2]
    assert [c.line for c in cpp_comments(cpp) if riddle(c.text)] == [2, 3, 4]


@pytest.mark.parametrize(
    "text",
    [
        "Offsets of the rows.",
        "Where there are no faces, nothing is drawn.",
        "Whatever the count.",
        "Returns the samples.\nOf these, some are poles.",
    ],
)
def test_a_sentence_is_no_riddle(text):
    assert [c for c in python_comments(f'"""{text}"""\n') if riddle(c.text)] == []


def test_consecutive_lines_are_one_comment():
    assert cpp_comments("// The first line\n// Of a sentence.\n") == [
        Comment(1, "The first line Of a sentence.")
    ]
    assert python_comments("x = 1  # behind code\n# below it\n# goes on\n\n# apart\n") == [
        Comment(1, "behind code"),
        Comment(2, "below it goes on"),
        Comment(5, "apart"),
    ]
