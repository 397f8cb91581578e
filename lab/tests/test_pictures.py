# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts that make pictures leave a person's Blender as it is."""

import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

DEMO = Path(__file__).resolve().parents[2] / "tests" / "demo"
SOURCE = """bl_info = {"name": "Empty", "blender": (3, 4, 0), "category": "Object"}
def register(): print("registered from", __file__)
def unregister(): pass
"""
MANIFEST = """schema_version = "1.0.0"
id = "medial_axis"
version = "1.0.0"
name = "Empty"
tagline = "Empty"
maintainer = "Nobody"
type = "add-on"
blender_version_min = "4.2.0"
license = ["SPDX:GPL-3.0-or-later"]
"""


@pytest.mark.skipif(shutil.which("blender") is None, reason="needs Blender")
def test_installing_for_a_picture_leaves_the_profile_alone(tmp_path):
    archive, home = tmp_path / "medial_axis.zip", tmp_path / "home"
    with zipfile.ZipFile(archive, "w") as packed:
        packed.writestr("medial_axis/__init__.py", SOURCE)
        packed.writestr("medial_axis/blender_manifest.toml", MANIFEST)
    home.mkdir()
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("BLENDER_USER", "XDG"))}
    code = f"import sys; sys.path.insert(0, {str(DEMO)!r}); import blender_demo; "
    code += f"blender_demo.install({str(archive)!r})"
    words = ["blender", "--background", "--factory-startup", "--python-exit-code", "1"]
    environment = {**kept, "HOME": str(home), "TMPDIR": str(tmp_path)}
    told = subprocess.run(
        [*words, "--python-expr", code], env=environment, check=True, capture_output=True, text=True
    ).stdout
    assert "registered from" in told
    assert not [path for path in home.rglob("*") if "medial_axis" in path.name]
    assert not list(tmp_path.glob("medial_axis_profile_*")), "the temporary profile is removed"
