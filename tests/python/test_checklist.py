# SPDX-License-Identifier: GPL-3.0-or-later
"""Every test and scene that docs/lab/checklist.md names is there."""

import re
from pathlib import Path

import pytest

pytestmark = pytest.mark.docs

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "lab" / "checklist.md").read_text(encoding="utf-8")
TESTS = sorted(set(re.findall(r"`(test_\w+)::(test_\w+)`", TEXT)))


@pytest.mark.parametrize(("file", "test"), TESTS)
def test_named_tests_are_there(file, test):
    rooms = ("tests/addon", "tests/python", "lab/tests")
    paths = [ROOT / room / f"{file}.py" for room in rooms]
    sources = "".join(path.read_text(encoding="utf-8") for path in paths if path.is_file())
    assert f"\ndef {test}(" in sources


def test_named_scenes_are_there():
    named = {
        name
        for words in re.findall(r"scenes? ((?:`\w+`(?:, )?)+)", TEXT)
        for name in re.findall(r"\w+", words)
    }
    driver = (ROOT / "tests" / "addon" / "gui" / "drive.py").read_text(encoding="utf-8")
    assert named <= set(re.findall(r'^    "(\w+)": ', driver, re.MULTILINE)) and len(named) > 5


def test_every_line_has_a_proof():
    rows = re.findall(r"^\| (✓|part) \| .+ \| (.+) \|$", TEXT, re.MULTILINE)
    assert len(rows) > 25 and len(rows) == TEXT.count("\n| ✓") + TEXT.count("\n| part")
