# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs of render farms: they are valid, and their command lines are run for real."""

import json
import os
import re
import shutil
from pathlib import Path

import pytest
from installed import MODULE, addon, program, succeeded
from test_cli import in_blender, made_files, walking

FARM = Path(addon().__file__).resolve().parent / "farm"
TEMPLATE = FARM / "medial_axis_sequence.openjd.yaml"


@pytest.fixture
def job_here(here):
    """A folder with a file to compute, in which commands run."""
    walking()
    return here


def expected_files(here):
    """The files that one run of the command line writes for frames 1 to 5."""
    done = in_blender("whole/", "--frames=1-5", "--format=npz", "--object=Body", "--rho=9",
                      file=["walk.blend"])  # fmt: skip
    assert done.returncode == 0, done.stderr
    return made_files(here / "whole")


# --- Open Job Description


@pytest.fixture
def template():
    yaml = pytest.importorskip("yaml", reason="no yaml: it is Debian's package python3-yaml")
    return yaml.safe_load(TEMPLATE.read_text(encoding="utf-8"))


def chosen(folder):
    """The parameters of a job with the file and the results in a folder."""
    places = {"BlendFile": folder / "walk.blend", "OutputFolder": folder / "axes"}
    return places | {"Object": "Body", "Options": "--rho 9", "Blender": program(), "Addon": MODULE}


def test_openjd_commands_do_the_work(job_here, template):
    usual = {p["name"]: str(p.get("default", "")) for p in template["parameterDefinitions"]}
    values = {f"Param.{name}": str(value) for name, value in (usual | chosen(job_here)).items()}
    (step,) = template["steps"]
    action = step["script"]["actions"]["onRun"]
    for chunk in ("1-2", "3-5:2,4"):
        values["Task.Param.Frames"] = chunk
        words = [
            re.sub(r"{{\s*([\w.]+)\s*}}", lambda name: values[name[1]], word)
            for word in (action["command"], *action["args"])
        ]
        succeeded(words)  # a worker's Blender has this profile, where the add-on is enabled
    assert made_files(job_here / "axes") == expected_files(job_here)


def test_openjd_parameters_are_used(template):
    text = json.dumps(template["steps"])
    for parameter in template["parameterDefinitions"]:
        assert f"{{{{Param.{parameter['name']}}}}}" in text, parameter["name"]
    formats = next(p for p in template["parameterDefinitions"] if p["name"] == "Format")
    known = set(addon("core.files.write").FORMATS)
    assert {f".{name}" for name in formats["allowedValues"]} == known


def openjd():
    """The tool of Open Job Description: on PATH, or where MEDIAL_AXIS_OPENJD says."""
    program = os.environ.get("MEDIAL_AXIS_OPENJD") or shutil.which("openjd")
    if program is None:
        pytest.skip("no openjd: pip install openjd-cli, or name it in MEDIAL_AXIS_OPENJD")
    return program


def test_openjd_template_is_valid():
    succeeded([openjd(), "check", TEMPLATE])


def test_openjd_runs_the_job(job_here):
    values = {**chosen(job_here), "Frames": "1-5", "ChunkSize": 2}
    words = [word for name, value in values.items() for word in ("-p", f"{name}={value}")]
    succeeded([openjd(), "run", TEMPLATE, "--step", "MedialAxis", *words])
    assert made_files(job_here / "axes") == expected_files(job_here)
