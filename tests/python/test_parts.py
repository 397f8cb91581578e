# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/parts.py and tests/lint.py: which parts run, how they end, what is skipped."""

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.tiers import LONG

import build_addon
from tests import lint, parts
from tests.addon.gui import drive
from tools.packaging import needs, paths
from tools.packaging.terminal import Failure

ROOT = paths.ROOT


@pytest.fixture
def played(monkeypatch, tmp_path):
    """Three parts in place of the real ones."""

    def fail(blender):
        raise Failure("broken")

    def skip(blender):
        raise parts.Skip("no tool")

    three = {"one": fail, "two": skip, "three": lambda blender: "without a tool"}
    monkeypatch.setattr(needs, "require", lambda needs: None)
    monkeypatch.setattr(build_addon, "find_blender", lambda name: name)
    monkeypatch.setattr(build_addon, "use_system_python", lambda: None)
    monkeypatch.setitem(parts.TIERS, "test", three)
    monkeypatch.setattr(parts, "TIMES", tmp_path / "test_times.json")


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


def test_times_are_kept_with_what_ran(played):
    build_addon.main(["test"])
    times = json.loads(parts.TIMES.read_text())
    assert times["tier"] == "test" and times["share"] == parts.share()
    assert list(times["parts"]) == ["one", "two", "three"]
    assert times["parts"]["one"]["verdict"] == "FAILED: broken"
    assert all(part["seconds"] >= 0 for part in times["parts"].values())


def test_each_tier_is_a_part_of_the_next():
    fast, test, full = (list(parts.TIERS[name]) for name in ("fast", "test", "full"))
    assert set(fast) < set(test) < set(full)
    needed = [set(parts.needed(name).items()) for name in ("fast", "test", "full")]
    assert needed[0] <= needed[1] <= needed[2]


def test_the_scenes_of_the_default_are_scenes():
    assert set(parts.SCENES) < set(drive.SCENES)


def test_processes_share_scenes_and_leave_none_out(monkeypatch, tmp_path):
    run = []

    def run_scene(blender, name, folder):
        run.append(name)
        return "broken" if name == "draft" else ""

    monkeypatch.setattr(drive, "run_scene", run_scene)
    monkeypatch.setattr(drive, "display", lambda size: contextlib.nullcontext(":0"))
    monkeypatch.setattr(drive, "module_hidden", lambda blender: contextlib.nullcontext())
    blender = SimpleNamespace(environment={})
    (tmp_path / "tutorial").touch()  # another process has it
    assert drive.run_all(blender, tmp_path, [], tmp_path) == 1
    assert run == [name for name in drive.SCENES if name != "tutorial"]
    assert drive.run_all(blender, tmp_path, [], tmp_path) == 0 and len(set(run)) == len(run)
    assert drive.run_all(blender, tmp_path, ["draft"]) == 1 and run[-1] == "draft"


@pytest.mark.parametrize(
    "line",
    [
        "Traceback (most recent call last):",
        "rna_uiItemR: property not found: Scene.medial",  # Blender 3.4's words, and those of 5.2
        "prop: property not found: Scene.medial",
        "rna_uiItemO: operator missing srna 'object.medial'",
        "uiItemM: menu 'VIEW3D_MT_medial' not found",
    ],
)
def test_a_scene_fails_when_a_panel_could_not_be_drawn(line, tmp_path):
    answer = tmp_path / "scene.json"
    assert drive.problem_of(1, answer, "") == "no answer, exit code 1"
    answer.write_text('{"problem": ""}')
    assert drive.problem_of(1, answer, "Blender quit") == ""
    assert drive.problem_of(11, answer, "Blender quit") == "exit code 11"
    found = drive.problem_of(0, answer, f"Info: done\n{line}\nBlender quit")
    assert found == f"it printed an error: {line}"


ORACLES = """
import pytest
@pytest.mark.oracle
@pytest.mark.parametrize("case", range(8))
def test_many(case): pass
@pytest.mark.oracle
@pytest.mark.parametrize("case", range(3))
def test_few(case): pass
@pytest.mark.parametrize("case", range(8))
def test_no_oracle(case): pass
def test_first(): pass
@pytest.mark.parametrize("case", range(3))
def test_later(case): pass
@pytest.mark.parametrize("case", range(8))
def test_long(case): pass
"""
LISTED = "test_first", "test_later", "test_long"


@pytest.fixture
def rules(tmp_path):
    """A folder whose tests follow the rules of tests/support/tiers.py, and the words that run them."""
    (tmp_path / "conftest.py").write_text(
        f"import sys\nsys.path.insert(0, {str(ROOT / 'tests')!r})\nfrom support import tiers\n"
        f"from support.tiers import *\n"
        f"tiers.LONG = {{'{tmp_path.name}/test_a.py::' + name for name in {LISTED!r}}}\n"
    )
    return tmp_path, [sys.executable, "-m", "pytest", "-p", "no:cacheprovider"]


def said_by(words, folder, **options):
    output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    return subprocess.run(words, cwd=folder, **output, **options).stdout


def test_shares_of_the_oracles_see_every_case_and_nothing_else_is_left_out(rules):
    """Four shares in processes: two of eight cases and one of the few long ones each, and every other test in each."""
    folder, words = rules
    (folder / "test_a.py").write_text(ORACLES)
    words += ["-q", "--collect-only", "."]
    runs = [said_by([*words, "--share", f"{i}/4"], folder) for i in range(4)]
    names = [{line for line in run.splitlines() if "::" in line} for run in runs]
    for many in ("test_many", "test_long"):
        assert [sum(many in name for name in found) for found in names] == [2] * 4
    assert [sum("first" in name or "later" in name for name in found) for found in names] == [1] * 4
    assert len(set.union(*names)) == 31 and len(set.intersection(*names)) == 11
    assert [len(found) for found in names] == [16] * 4


def test_tests_inside_blender_take_a_share_and_claims_together(rules):
    """Blender's module is a stand-in that enables nothing; the words are those of the gate."""
    folder, _ = rules
    shutil.copy(ROOT / "tests/addon/inside.py", folder)
    (folder / "test_a.py").write_text("def test_one(): pass\n")
    (folder / "bpy.py").write_text("from unittest.mock import MagicMock\nops = MagicMock()\n")
    (folder / "claims").mkdir()
    words = [sys.executable, str(folder / "inside.py"), "--", "--durations=3", "--share", "1/4"]
    words.append(f"--claims={folder / 'claims'}")
    said = said_by(words, ROOT, env={**os.environ, "MEDIAL_AXIS_MODULE": "medial_axis"})
    assert "1 passed" in said, said


def test_processes_share_files_and_leave_none_out(rules, tmp_path_factory):
    """A file belongs to the process that comes first, whole; the longest file goes first."""
    folder, words = rules
    claims = tmp_path_factory.mktemp("claims")
    for name, lines in (("a", 1), ("b", 30), ("c", 2)):
        tests = "".join(f"def test_{i}(): assert {i} != 1\n" for i in range(lines))
        (folder / f"test_{name}.py").write_text(tests)
    (claims / "test_c.py").touch()  # another process has it
    words += ["-v", f"--claims={claims}", "."]
    runs = [said_by(words, folder) for _ in range(2)]
    outcomes = [re.findall(r"test_(\w)\.py::test_(\d+) (\w+)", run) for run in runs]
    expected = [("b", str(i), "FAILED" if i == 1 else "PASSED") for i in range(30)]
    assert outcomes == [[*expected, ("a", "0", "PASSED")], []]
    assert "1 failed, 30 passed" in runs[0]


@pytest.mark.parametrize("name", parts.QUICK_TESTS)
def test_quick_tests_exist(name):
    file, _, function = name.partition("::")
    text = (ROOT / "tests" / "python" / file).read_text(encoding="utf-8")
    assert not function or re.search(rf"^def {function}\(", text, re.MULTILINE)


def test_long_tests_exist_and_notice_no_planted_fault():
    """A test that notices one runs each time."""
    tables = [ROOT / "docs/lab" / f"mutations{end}.csv" for end in ("", "_python")]
    noticed = " ".join(table.read_text(encoding="utf-8") for table in tables)
    for name in LONG:
        file, _, function = name.partition("::")
        text = (ROOT / "tests" / file).read_text(encoding="utf-8")
        assert re.search(rf"^def {function}\(", text, re.MULTILINE), name
        assert not re.search(rf"{Path(file).name}::{function}\b", noticed), name


@pytest.mark.parametrize(
    "name, runs", [("native/CMakeLists.txt", False), ("tests/native/a.cpp", True)]
)
def test_the_sanitizer_runs_where_cpp_has_changed(monkeypatch, name, runs):
    begun = []
    monkeypatch.setattr(lint, "changed_files", lambda *folders: [name])
    monkeypatch.setattr(parts, "run_sanitized", lambda *words, **_: begun.append(words))
    with contextlib.suppress(lint.Skip):
        parts.asan(Path("blender"))
    assert bool(begun) == runs


# --- files that other programs read


def workflows():
    """The workflows for hosted runners: name of the file -> its jobs."""
    yaml = pytest.importorskip("yaml")
    files = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
    assert files
    return {file.name: yaml.safe_load(file.read_text(encoding="utf-8"))["jobs"] for file in files}


def test_workflows_are_valid():
    """Each job runs somewhere and has steps, or is another workflow; actionlint judges the rest where it is there."""
    for jobs in workflows().values():
        for job in jobs.values():
            other = job.get("uses", "")
            assert (ROOT / other).is_file() if other else job["runs-on"] and job["steps"]
    if shutil.which("actionlint"):
        subprocess.run(["actionlint"], cwd=ROOT, check=True)


def steps_of_workflows():
    every = [job for jobs in workflows().values() for job in jobs.values()]
    return [step for job in every for step in job.get("steps", ())]


def test_what_a_job_downloads_another_has_uploaded():
    """A name that nobody uploads would stop a release at its end."""
    names = {"upload": [], "download": []}
    for step in steps_of_workflows():
        if kind := re.match(r"actions/(upload|download)-artifact@", step.get("uses", "")):
            given = step["with"]
            names[kind[1]].append(given.get("name") or given["pattern"])
    made = [re.sub(r"\$\{\{.*?\}\}", ".+", name) for name in names["upload"]]
    assert len(names["download"]) > 8
    for name in names["download"]:
        assert any(re.fullmatch(some, name.replace("*", "x")) for some in made), name


def test_commands_of_workflows_exist():
    commands = [line for step in steps_of_workflows() for line in step.get("run", "").splitlines()]
    words = [re.split(r"[\s;\"()]+", command) for command in commands]
    scripts = {word for row in words for word in row if word.endswith(".py")}
    assert scripts > {"build_addon.py", "tests/addon/run.py", "tests/matrix/updates.py"}
    assert all((ROOT / script).is_file() for script in scripts)
    for row in words:
        if "build_addon.py" in row:
            build_addon.parse(row[row.index("build_addon.py") + 1 :])


def test_every_workflow_preset_has_its_steps():
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    for workflow in presets["workflowPresets"]:
        assert [step["type"] for step in workflow["steps"]] == ["configure", "build", "test"]
        for step in workflow["steps"]:
            assert step["name"] in [preset["name"] for preset in presets[f"{step['type']}Presets"]]
