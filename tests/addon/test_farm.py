# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs of render farms: they compile as the engines document it, and their command lines are run for real."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import bpy
import pytest
from scene import MODULE, addon, program
from test_cli import in_blender, reports_of, walking

FARM = Path(addon().__file__).resolve().parent / "farm"
JOB_TYPE = FARM / "medial_axis_sequence.js"
TEMPLATE = FARM / "medial_axis_sequence.openjd.yaml"
STAND_IN = Path(__file__).resolve().parents[1] / "flamenco" / "stand_in.js"


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PWD", str(tmp_path))
    walking()
    return tmp_path


def run(*words):
    """A worker's Blender: with this profile, where the add-on is enabled."""
    return subprocess.run([str(word) for word in words], capture_output=True, text=True)


def expected_files(here):
    """What one run of the command line makes of frames 1 to 5."""
    done = in_blender("whole/", "--frames=1-5", "--format=npz", "--object=Body", "--rho=9",
                      file=["walk.blend"])  # fmt: skip
    assert done.returncode == 0, done.stderr
    return {path.name: path.read_bytes() for path in (here / "whole").glob("*.npz")}


def made_files(folder):
    return {path.name: path.read_bytes() for path in folder.glob("*.npz")}


# --- Flamenco


def compile_job(here, **settings):
    """Job type and tasks, or the error of the engine."""
    node = shutil.which("node") or shutil.which("nodejs")
    if node is None:
        pytest.skip("no node: it is Debian's package nodejs")
    (here / "settings.json").write_text(json.dumps(settings))
    done = run(node, STAND_IN, JOB_TYPE, here / "settings.json")
    return json.loads(done.stdout) if done.returncode == 0 else done.stderr


def job_settings(here, **others):
    usual = {"frames": "1-5", "chunk_size": 2, "object_name": "Body", "options": "--rho 9"}
    usual |= {"blendfile": str(here / "walk.blend"), "addon": MODULE}
    return {**usual, "output_folder": str(here / "axes"), **others}


def command_line(command):
    """What a worker starts: {exe} {exeArgs} {argsBefore} {blendfile} {args}."""
    words = command["parameters"]
    assert command["name"] == "blender-render"
    assert (words["exe"], words["exeArgs"]) == ("{blender}", "{blenderArgs}")
    return [
        program(),
        "-b",
        "-y",
        *words["argsBefore"],
        words["blendfile"],
        *words["args"],
    ]


def test_flamenco_job_is_split_into_chunks(here):
    tasks = compile_job(here, **job_settings(here, frames="1-10, 20", chunk_size=4))["tasks"]
    assert [task["name"] for task in tasks] == [
        "medial-axis-1-4", "medial-axis-5-8", "medial-axis-9,10,20"
    ]  # fmt: skip
    assert all(task["type"] == "blender" and len(task["commands"]) == 1 for task in tasks)
    assert not any(task["dependencies"] for task in tasks)


def test_flamenco_commands_do_the_work(here):
    tasks = compile_job(here, **job_settings(here))["tasks"]
    assert len(tasks) == 3
    for task in tasks:
        (command,) = task["commands"]
        done = run(*command_line(command))
        assert done.returncode == 0, done.stdout + done.stderr
        assert {r["status"] for r in reports_of(done.stdout)} == {"done"}
    assert made_files(here / "axes") == expected_files(here)
    done = run(*command_line(tasks[1]["commands"][0]))
    assert [r["status"] for r in reports_of(done.stdout)] == ["kept"] * 2


def test_flamenco_task_fails_when_a_frame_fails(here):
    settings = job_settings(here, object_name="Nobody")
    (command,) = compile_job(here, **settings)["tasks"][0]["commands"]
    assert run(*command_line(command)).returncode != 0


def test_flamenco_refuses(here):
    assert "add-on Medial Axis is not enabled" in compile_job(here, **job_settings(here, addon=""))
    assert "invalid range" in compile_job(here, **job_settings(here, frames="x"))
    evil = job_settings(here, addon="os; import sys")
    assert "not enabled" in compile_job(here, **evil)


def test_flamenco_expressions_work_in_blender(here):
    """Those of `eval`, with the names that Flamenco documents."""
    job_type = compile_job(here, **job_settings(here))["jobType"]
    names = {"bpy": bpy, "C": bpy.context, "Path": Path, "jobname": "test"}
    found = {s["key"]: eval(s["eval"], names) for s in job_type["settings"] if "eval" in s}
    assert found == {"frames": "1-5", "object_name": bpy.context.object.name, "addon": MODULE}
    formats = next(s["choices"] for s in job_type["settings"] if s["key"] == "format")
    assert {f".{name}" for name in formats} == set(addon("core.files.write").FORMATS)


# --- Open Job Description


@pytest.fixture
def template():
    yaml = pytest.importorskip("yaml", reason="no yaml: it is Debian's package python3-yaml")
    return yaml.safe_load(TEMPLATE.read_text(encoding="utf-8"))


def parameters(template, **others):
    usual = {p["name"]: str(p.get("default", "")) for p in template["parameterDefinitions"]}
    return {f"Param.{name}": value for name, value in {**usual, **others}.items()}


def test_openjd_commands_do_the_work(here, template):
    values = parameters(
        template, BlendFile=str(here / "walk.blend"), OutputFolder=str(here / "axes"),
        Object="Body", Options="--rho 9", Blender=program(), Addon=MODULE,
    )  # fmt: skip
    (step,) = template["steps"]
    action = step["script"]["actions"]["onRun"]
    for chunk in ("1-2", "3-5:2,4"):
        values["Task.Param.Frames"] = chunk
        words = [
            re.sub(r"{{\s*([\w.]+)\s*}}", lambda name: values[name[1]], word)
            for word in (action["command"], *action["args"])
        ]
        done = run(*words)
        assert done.returncode == 0, done.stdout + done.stderr
    assert made_files(here / "axes") == expected_files(here)


def test_openjd_parameters_are_used(template):
    text = json.dumps(template["steps"])
    for parameter in template["parameterDefinitions"]:
        assert f"{{{{Param.{parameter['name']}}}}}" in text, parameter["name"]
    formats = next(p for p in template["parameterDefinitions"] if p["name"] == "Format")
    assert {f".{name}" for name in formats["allowedValues"]} == set(
        addon("core.files.write").FORMATS
    )


def openjd():
    """The tool of Open Job Description: on PATH, or where MEDIAL_AXIS_OPENJD says."""
    program = os.environ.get("MEDIAL_AXIS_OPENJD") or shutil.which("openjd")
    if program is None:
        pytest.skip("no openjd: pip install openjd-cli, or name it in MEDIAL_AXIS_OPENJD")
    return program


def test_openjd_template_is_valid():
    done = run(openjd(), "check", TEMPLATE)
    assert done.returncode == 0, done.stdout + done.stderr


def test_openjd_runs_the_job(here):
    values = {"BlendFile": here / "walk.blend", "OutputFolder": here / "axes", "Frames": "1-5"}
    values |= {"ChunkSize": 2, "Object": "Body", "Options": "--rho 9", "Addon": MODULE}
    values["Blender"] = program()
    words = [word for name, value in values.items() for word in ("-p", f"{name}={value}")]
    done = run(openjd(), "run", TEMPLATE, "--step", "MedialAxis", *words)
    assert done.returncode == 0, done.stdout + done.stderr
    assert made_files(here / "axes") == expected_files(here)
