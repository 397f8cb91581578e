# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command in the docs is run by a test, or is listed below with the reason why none runs it.

Commands are in blocks of code and between backticks. Those of the command line that need no Blender are run here,
those of build_addon.py are read by its parser, and of scripts the names and the options are looked for.
"""

import re
import shlex

import pytest
from medial_axis import cli
from medial_axis.core.files.write_triangles import write_stl
from support.package import ROOT
from support.shape_meshes import of_ellipsoid
from support.shapes import SHAPES
from test_cli import documented, write_egg, write_input
from test_docs import PAGES

import build_addon

pytestmark = pytest.mark.docs

ROBOT = """<robot name="a"><link name="b"><collision><geometry><box size="4 1 1"/></geometry></collision></link>
</robot>"""
MODEL = """<mujoco><worldbody><body><geom type="box" size="2 1 1"/></body></worldbody></mujoco>"""

PAGES = [*PAGES, ROOT / "CONTRIBUTING.md"]
PROGRAMS = (
    "python3", "medial_axis", "medial-axis", "blender", "cmake", "pip", "openjd",
    "build_addon.py",
)  # fmt: skip
SPAN = re.compile(r"`([^`\n]+)`")

# How commands begin -> the tests that run them, as file::function.
RUN_BY = {
    "python3 -m medial_axis": "python/test_cli.py::test_documented_commands",
    "blender --command": "addon/test_cli.py::test_documented_commands",
    "blender --background walk.blend": "addon/test_cli.py::test_documented_commands",
    "blender --background FILE.blend --python-expr": "addon/test_cli.py::test_module_path_of_an_enabled_addon",
    "blender --background FILE.blend --python FOLDER": "addon/test_cli.py::in_blender",
    "blender FILE.blend --command": "addon/test_cli.py::test_documented_commands",
    "blender --background --python-exit-code 1 --python": "addon/test_documented_scripts.py::test_script",
    "python3 FOLDER INPUT OUTPUT": "python/test_cli.py::test_folder_of_the_package_is_a_program",
    "openjd run": "addon/test_farm.py::test_openjd_runs_the_job",
    "openjd check": "addon/test_farm.py::test_openjd_template_is_valid",
    "cmake -S . -B build": "python/test_consumer.py::test_sources_as_a_part_of_another_project",
    "cmake --install": "python/test_consumer.py::test_installed_library",
    "pip install .": "python/test_wheel.py::test_command",
    "python3 tests/wrap_docs.py": "python/test_docs.py::test_the_docs_are_wrapped",
    "python3 -m lab.race.judge": "../lab/tests/test_race.py::test_the_commands_of_the_page",
}
# How commands begin -> why no test runs them.
NOT_RUN = {
    "python3 build_addon.py": "minutes to hours; it is what runs the tests, and its parser reads each of them here",
    "build_addon.py": "the same",
    "cmake": "the build itself, and all presets; the names of presets are looked for here",
    "python3 -m pytest": "runs tests",
    "python3 tests/addon/run.py": "runs tests",
    "python3 -m lab.breaking": "tries as long as it is told",
    "python3 -m lab.corpus": "fetches packages; test_corpus.py runs it on a folder",
    "python3 -m lab.race": "half an hour; its parts have tests of their own in test_race.py",
    "python3 lab/benchmarks/": "minutes, with meshes of the optional data folder",
    "python3 lab/mutations/sweep.py": "half an hour; test_mutations.py tries that every fault fits",
    "python3 lab/mutations/sweep_python.py": "ten minutes; test_mutations.py tries that every bug fits",
    "python3 lab/pictures/": "renders pictures",
    "python3 tests/fuzz.py": "minutes; the tests run a tenth of it",
    "python3 tests/readers.py": "needs programs of others",
    "blender --background --factory-startup --python-exit-code 1 --python lab/pictures/": "renders pictures",
    "medial_axis skeleton walk.blend": "needs Blender; frames are run by addon/test_cli.py",
}


def commands_of(page):
    """The commands in blocks and spans, without prompts, comments and the text next to them."""
    text = page.read_text(encoding="utf-8")
    fenced = re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    lines = [line for line in text.splitlines() if line.startswith("    ")]
    lines += [line for block in fenced for line in block.replace("\\\n", " ").splitlines()]
    lines += SPAN.findall("\n".join(x for x in text.splitlines() if not x.startswith("    ")))
    for line in lines:
        for part in re.split(r"\s{3,}\S|\s#\s", line.strip())[0].split(" && "):
            if len(part.split()) > 1 and part.split()[0] in PROGRAMS and "=" not in part.split()[1]:
                yield part


ALL = sorted({command for page in PAGES for command in commands_of(page)})
OWN = [c for c in ALL if re.match(r"medial[_-]axis |python3 -m medial_axis ", c)]
THERE = {shlex.join(shlex.split(c)) for c in documented("command_line.md")}  # by test_cli.py
WHOLE = [c for c in OWN if "INPUT" not in c and ".blend" not in c and len(shlex.split(c)) > 3]
HERE = [c for c in WHOLE if shlex.join(shlex.split(c)) not in THERE]


def known(command):
    """The longest of the two lists' entries that a command begins with."""
    return max((x for x in (*RUN_BY, *NOT_RUN) if command.startswith(x)), key=len, default=None)


def test_there_are_commands():
    assert len(ALL) > 40 and len(HERE) > 3


def test_every_command_is_run_or_named():
    names = {c for c in OWN if c not in WHOLE}  # what is spoken of: `medial_axis skeleton`
    assert [c for c in ALL if known(c) is None and c not in HERE and c not in names] == []


def test_no_entry_is_left_over():
    used = {known(command) for command in ALL}
    assert sorted({*RUN_BY, *NOT_RUN} - used) == []


@pytest.mark.parametrize("place", sorted(set(RUN_BY.values())))
def test_what_runs_them_is_there(place):
    name, _, function = place.partition("::")
    assert f"def {function}(" in (ROOT / "tests" / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("command", HERE)
def test_command_line(command, tmp_path, monkeypatch, capsys):
    """Every command ends well on a small input of the kind that it names, and writes what it names."""
    monkeypatch.chdir(tmp_path)
    words = shlex.split(command)
    words = words[words.index("medial_axis") + 1 :]
    inputs = [word for word in words if re.fullmatch(r"[\w#]+\.(ply|obj|xyz|stl)", word)]
    for name in inputs[:-1] if words[-1:] == inputs[-1:] else inputs:
        for frame in range(1, 6) if "#" in name else [0]:
            write(tmp_path / name.replace("####", f"{frame:04d}"))
    if words[0] == "robot":
        (tmp_path / words[1]).write_text(ROBOT if words[1].endswith(".urdf") else MODEL)
    if any(name.endswith(".stl") for name in inputs) and words[0] not in ("hollow", "solidify"):
        words += ["--samples", "300"]  # of the faces; for the sake of time
    before = {path.name for path in tmp_path.iterdir()}
    code = cli.main(words)
    # Thin parts are 5; an ellipsoid has no thin walls, and is less than 4 thick.
    fives, threes = ("thickness", "thicken", "solidify"), ("midsurface", "hollow")
    may_end = dict.fromkeys(fives, (0, 5)) | dict.fromkeys(threes, (0, 3))
    assert code in may_end.get(words[0], (0,)), capsys.readouterr().err
    assert code == 3 or {path.name for path in tmp_path.iterdir()} > before


def write(path):
    """An ellipsoid: points with normals, or triangles where the format knows nothing else."""
    if path.suffix == ".stl":
        with open(path, "wb") as stream:
            write_stl(*of_ellipsoid(SHAPES["ellipsoid"], subdivisions=2), stream)
    elif path.suffix == ".xyz":
        write_egg(path)
    else:
        write_input(path)


@pytest.mark.parametrize("command", [c for c in ALL if "build_addon.py " in c])
def test_build_addon_takes_its_words(command):
    """The options of a command, also the optional ones in brackets."""
    text = re.sub(r"\[(-[^\]]+?)( \.\.\.)?\]", r"\1", command.partition("build_addon.py ")[2])
    assert build_addon.parse(shlex.split(text)).command


SCRIPTS = [c for c in ALL if re.match(r"(python3|blender .*--python) (tests|native)/", c)]


@pytest.mark.parametrize("command", SCRIPTS)
def test_scripts_know_their_options(command):
    words = shlex.split(command)
    script = ROOT / next(w for w in words if w.startswith(("tests/", "native/")))
    text = script.read_text(encoding="utf-8")
    for module in re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE):
        beside = script.parent / f"{module}.py"
        text += beside.read_text(encoding="utf-8") if beside.is_file() else ""
    own = words[words.index(next(w for w in words if w.endswith(script.name))) + 1 :]
    options = [word for word in own if word.startswith("--") and word != "--"]
    assert [option for option in options if f'"{option}"' not in text] == []


@pytest.mark.parametrize("command", [c for c in ALL if "--preset" in c])
def test_presets_are_there(command):
    name = re.search(r"--preset (\w+)", command)[1]
    assert f'"name": "{name}"' in (ROOT / "CMakePresets.json").read_text(encoding="utf-8")
