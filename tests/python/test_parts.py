# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/parts.py and tests/lint.py: which parts run, how they end, what is skipped."""

import json
import re
import shutil

import pytest

import build_addon
from native.packaging import needs, paths
from native.packaging.terminal import Failure
from tests import lint, parts

ROOT = paths.ROOT


@pytest.fixture
def played(monkeypatch):
    """Three parts in place of the real ones."""

    def fail(blender):
        raise Failure("broken")

    def skip(blender):
        raise parts.Skip("no tool")

    three = {"one": fail, "two": skip, "three": lambda blender: "without a tool"}
    monkeypatch.setattr(needs, "require", lambda needs: None)
    monkeypatch.setattr(build_addon, "find_blender", lambda name: name)
    monkeypatch.setattr(build_addon, "use_system_python", lambda: None)
    monkeypatch.setattr(parts, "PARTS", three)


def test_one_failing_part_fails_the_whole(played, capsys):
    assert build_addon.main(["test"]) == 1
    text = capsys.readouterr().out
    summary = text[text.index("Summary") :].splitlines()
    verdicts = [line.split(" s  ")[1] for line in summary[1:4]]
    assert verdicts == ["FAILED: broken", "skipped: no tool", "passed; without a tool"]
    assert build_addon.main(["test", "--only", "two", "three"]) == 0


def test_unknown_part_is_refused(played, capsys):
    assert build_addon.main(["test", "--only", "four"]) == 1
    assert "Expected parts out of one, two, three, found four" in capsys.readouterr().err


def test_fast_is_a_part_of_all():
    assert set(parts.FAST) < set(parts.PARTS)
    assert set(parts.needed(True, False).items()) <= set(parts.needed(False, False).items())


@pytest.mark.parametrize("name", parts.QUICK_TESTS)
def test_quick_tests_exist(name):
    file, _, function = name.partition("::")
    text = (ROOT / "tests" / "python" / file).read_text(encoding="utf-8")
    assert not function or re.search(rf"^def {function}\(", text, re.MULTILINE)


def test_linters_that_are_missing_are_named_and_the_others_run(monkeypatch):
    ran = []
    tools = {"here": lambda: ran.append("here"), "gone": lambda: pytest.fail("ran")}
    monkeypatch.setattr(lint.shutil, "which", lambda tool: tool if tool == "here" else None)
    assert lint.run_tools(tools) == "without gone, not installed" and ran == ["here"]
    with pytest.raises(lint.Skip, match="none of gone is installed"):
        lint.run_tools({"gone": tools["gone"]})


def test_one_failing_linter_fails_after_all_ran(monkeypatch):
    def fail():
        raise Failure("bad")

    ran = []
    monkeypatch.setattr(lint.shutil, "which", lambda tool: tool)
    with pytest.raises(Failure, match=r"^first \(bad\)$"):
        lint.run_tools({"first": fail, "second": lambda: ran.append("second")})
    assert ran == ["second"]


# --- files that other programs read


def test_workflows_are_valid():
    """As far as a YAML parser can tell: each job runs somewhere and has steps."""
    yaml = pytest.importorskip("yaml")
    files = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
    assert files
    for file in files:
        jobs = yaml.safe_load(file.read_text(encoding="utf-8"))["jobs"]
        assert all(job["runs-on"] and job["steps"] for job in jobs.values())


def test_every_workflow_preset_has_its_steps():
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    known = {
        kind: {preset["name"] for preset in presets[f"{kind}Presets"]}
        for kind in ("configure", "build", "test")
    }
    for workflow in presets["workflowPresets"]:
        assert [step["type"] for step in workflow["steps"]] == ["configure", "build", "test"]
        assert all(step["name"] in known[step["type"]] for step in workflow["steps"])


def test_clang_format_finds_the_sources():
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("this is no git checkout")
    assert "native/medial/analysis.cpp" in lint.cpp_files()
