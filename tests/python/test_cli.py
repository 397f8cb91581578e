# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line without Blender: what is written, what is said, and with which exit code it ends."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from argparse import Namespace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.commands.parse import parse
from medial_axis.core.axis.compute import compute
from medial_axis.core.batch import option_words
from medial_axis.core.batch.frames import at_frame, output_path, parse_frames
from medial_axis.core.errors import ExportError, InvalidInputError
from medial_axis.core.files.read import import_points
from medial_axis.core.files.write import export_axis
from medial_axis.core.machine.memory_limit import LIMITS
from medial_axis.core.options import Choice, Switch
from medial_axis.core.products import axis as axis_work
from medial_axis.core.products.product import PRODUCTS
from medial_axis.core.settings import OPTIONS, Settings, Side
from support.clouds import on_ellipsoid
from support.package import PACKAGE, ROOT


def egg(stretch=1.0, count=400):
    """(n, 6) points and normals of an ellipsoid."""
    return np.column_stack(on_ellipsoid(count, (1.0, 0.7, 0.5 * stretch), seed=None))


def write_egg(path, *arguments):
    np.savetxt(path, egg(*arguments), fmt="%.17g")
    return path


def write_ply(path, table):
    axes = ("x", "y", "z", "nx", "ny", "nz")[: table.shape[1]]
    head = [f"ply\nformat ascii 1.0\nelement vertex {len(table)}"]
    head += [*(f"property double {axis}" for axis in axes), "end_header\n"]
    np.savetxt(path, table, fmt="%.17g", header="\n".join(head)[:-1], comments="")


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder with an egg, which is the working folder."""
    monkeypatch.chdir(tmp_path)
    write_egg(tmp_path / "egg.xyz")
    return tmp_path


def run_words(capsys, *words):
    """The exit code, the reports of --json, and standard error."""
    code = cli.main([*map(str, words), "--json"])
    said = capsys.readouterr()
    return code, [json.loads(line) for line in said.out.splitlines()], said.err


@pytest.fixture
def run(capsys):
    return partial(run_words, capsys)


@pytest.fixture(scope="session")
def program(tmp_path_factory):
    """(words, **options) -> the finished process of `python3 -m medial_axis`."""
    folder = tmp_path_factory.mktemp("installed")
    (folder / "medial_axis").symlink_to(PACKAGE, target_is_directory=True)
    environment = {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}

    def start(*words, popen=False, **options):
        command = [sys.executable, "-m", "medial_axis", *map(str, words)]
        options = {"env": environment, "text": True, "stderr": subprocess.PIPE, **options}
        options.setdefault("stdout", subprocess.PIPE)
        return subprocess.Popen(command, **options) if popen else subprocess.run(command, **options)

    start.environment = environment
    return start


def files(folder):
    return sorted(path.name for path in folder.iterdir())


# --- one file


def test_output_is_what_compute_and_export_make(here, run):
    code, (report,), said = run("egg.xyz", "egg.ma", "--theta", "30", "--side", "both")
    assert (code, said) == (cli.DONE, "")
    found = import_points("egg.xyz")
    settings = Settings(theta=np.pi / 6, side=Side.BOTH)
    none = np.zeros((0, 3), np.int32)
    expected = compute(found.vertices, none, settings, normals=found.normals).axis
    export_axis(expected, "expected.ma")
    assert Path("egg.ma").read_bytes() == Path("expected.ma").read_bytes()
    assert report["status"] == "done" and report["facets"] == expected.facets > 0
    assert report["radius"] == [expected.radius.min(), expected.radius.max()]
    assert report["settings"]["theta"] == 30 and report["settings"]["side"] == "both"
    assert (report["input"], report["object"], report["frame"]) == ("egg.xyz", None, None)
    assert json.loads(Path("egg.ma.json").read_text()) == report


def test_lines_for_people(here, capsys):
    assert cli.main(["egg.xyz", "egg.ma"]) == cli.DONE
    said = capsys.readouterr()
    assert re.fullmatch(r"egg\.ma: [\d,]+ facets, done in \d+\.\d\d s\n", said.out)
    assert said.err == ""


# --- options


def test_options_are_those_of_settings(capsys):
    assert cli.main(["--help"]) == cli.DONE
    text = capsys.readouterr().out
    flags = set(re.findall(r"^  --([a-z-]+)", text, re.MULTILINE))
    assert {name.replace("_", "-") for name in OPTIONS} <= flags
    assert "medial_axis bunny.ply bunny.ma" in text and "exit codes:" in text
    assert set(PRODUCTS) - {""} <= set(text[text.index("results besides") :].split())


@pytest.mark.parametrize("name", OPTIONS)
def test_every_option_arrives(name):
    option, word = OPTIONS[name], f"--{name}".replace("_", "-")
    if isinstance(option, Switch):
        values = {(word,): True, (word.replace("--", "--no-", 1),): False}
    elif isinstance(option, Choice):
        values = {(word, option_words._word(member)): member for member in option.items}
    else:
        values = {(word, str(option_words._outward(option, option.minimum))): option.minimum}
    for words, value in values.items():
        settings = parse(["a.off", *words, "a.ma"]).work.settings
        assert getattr(settings, name) == value
        reported = Namespace(**option_words.as_words(settings))
        assert getattr(option_words.settings_from(reported, Settings), name) == value


def test_options_in_one_word():
    wanted = parse(["a.off", "--options", "--rho 9 --side 'both' --json", "a.ma", "--rho=7"])
    settings = wanted.work.settings
    assert (settings.rho, settings.side, wanted.json) == (9.0, Side.BOTH, True)
    assert parse(["a.off", "a.ma", "--options="]).work.settings == Settings()


def test_degrees_are_exact_where_it_matters():
    for degrees, radians in ((22.5, np.pi / 8), (90, np.pi / 2), (0, 0.0)):
        assert parse(["a.off", "a.ma", f"--theta={degrees}"]).work.settings.theta == radians


# Options of lengths, by their commands.
LENGTHS = (
    "thickness --limit", "thicken --limit", "thicken --blend", "hollow --wall", "hollow --voxel-size",
    "solidify --thickness", "midsurface --size",
)  # fmt: skip
WRONG = {
    "thickness a.stl --limit 1": "found one path",
    "balls a.obj": "found one path",
    "a.off a.ma --vertices -1": "Expected --vertices of 0 or more",
    "a.off a.ma --vertices 5 --side outer": "Expected --side inner with --vertices",
    "a.off a.ma --memory-limit -5": "Expected memory_limit from 0 to",
    "a.off a.ma --above-limit swap": "invalid choice",
    "thickness a.off a.json --limit -1": "a finite length of at least 0",
    "thickness a.off a.json --theta 20": "unrecognized",
    "thickness a.off a.json --edges round": "invalid choice",
    "thickness a.off a.ma": ".csv, .html, .json or .ply",
    "robot a.urdf b.urdf --balls 0": "Expected count from 1",
    "robot a.urdf b.urdf --tolerance -1": "a finite length of at least 0",
    "robot a.urdf b.urdf --balls 2 --capsules 2": "not allowed with",
    "robot a.urdf b.json": ".urdf, .xml or .mjcf",
    "robot a.urdf a.urdf": "replaces no input",
    **{
        f"{command} {length}".replace(" ", " a.off b/ ", 1): "a finite length of at least 0"
        for command in LENGTHS
        for length in ("inf", "1e400", "nan")
    },
}


@pytest.mark.parametrize(
    "words, said",
    [
        ([], "required"),
        (["a.off"], "found one path"),
        *((words.split(), said) for words, said in WRONG.items()),
        (["a.off", "a.ma", "--theta", "x"], "invalid float"),
        (["a.off", "a.ma", "--theta", "200"], "Expected theta from"),
        (["a.off", "a.ma", "--side", "left"], "invalid choice"),
        (["a.off", "a.ma", "--nonsense"], "unrecognized"),
        (["a.off", "a.ma", "--options=--nonsense"], "unrecognized"),
        (["a.off", "a.ma", "--options", "'"], "No closing quotation"),
        (["a.off", "a.txt"], "ends in .ma"),
        (["a.off", "folder"], "ends in .ma"),
        (["a.off", "out/CON.ma"], "found 'CON.ma'"),
        (["a.off", "b.off", "a.ma"], "{name} in OUTPUT"),
        (["thickness-of", "b.off", "a.ma"], "or one of thickness, "),
        (["a_##.off", "a.ma", "--frames", "1-3"], "--frames together with ####"),
        (["a.off", "a_####.ma"], "--frames together with ####"),
        (["a.off", "a_####.ma", "--frames", "1-3"], "#### in INPUT"),
        (["a_#.off", "a_####.ma", "--frames", "3-1"], "Expected frames such as"),
        (["a_#.off", "a_####.ma", "--frames", "1..3"], "Expected frames such as"),
    ],
)
def test_wrong_usage(here, words, said, capsys):
    assert cli.main(words) == cli.USAGE
    text = capsys.readouterr()
    assert said in text.err and text.out == ""
    assert files(here) == ["egg.xyz"]


# --- many files


def test_a_failing_item_does_not_stop_the_others(here, run):
    Path("bad.off").write_text("OFF\n3 x\n")
    Path("flat.xyz").write_text("".join(f"{i} {i * i} 0\n" for i in range(50)))
    Path("a.blend").write_bytes(b"BLENDER")
    write_egg(here / "nul.xyz")
    names = ["none.ply", "bad.off", "nul.xyz", "egg.xyz", "a.blend", "flat.xyz"]
    code, reports, said = run(*names, "out/")
    assert code == cli.INPUT
    states = {report["input"]: report["status"] for report in reports}
    assert states == {name: "done" if name == "egg.xyz" else "failed" for name in names}
    assert files(here / "out") == ["egg.ma", "egg.ma.json"]
    *kinds, last = [report["kind"] for report in reports if "kind" in report]
    assert set(kinds) == {"ReadError", "InvalidInputError"} and last == "DegenerateInputError"
    assert "found 'a.blend'" in reports[-2]["error"]
    assert len(said.splitlines()) == 5 and "flat.xyz: " in said
    assert "found 'nul.ma' for '{name}.ma' in OUTPUT" in said


def test_what_fails_without_fault_of_the_input_is_another_code(here, run, monkeypatch):
    strict = "--form", "published", "--rho", "1e9", "--criteria", "ratio"
    code, (report,), _ = run("egg.xyz", "egg.ma", *strict)
    assert code == cli.FAILED and "no facet passes" in report["error"]
    assert files(here) == ["egg.xyz"]

    def refuse(*_):
        raise ExportError("Expected room, found none; make some")

    monkeypatch.setattr(axis_work, "export_axis", refuse)
    assert run("egg.xyz", "none.off", "out/")[0] == cli.FAILED
    assert run("none.off", "egg.xyz", "out/")[0] == cli.FAILED


def test_two_results_never_share_a_file(here, run):
    (here / "other").mkdir()
    write_egg(here / "other" / "egg.xyz", 1.5)
    code, reports, said = run("egg.xyz", "other/egg.xyz", "out/")
    assert code == cli.USAGE and reports == [] and not (here / "out").exists()
    assert "found 'out/egg.ma' again" in said
    for name in ("a", "a.json"):
        write_egg(here / f"{name}.xyz")
    code, reports, said = run("balls", "a.xyz", "a.json.xyz", "out/", "--format", "json")
    assert code == cli.USAGE and reports == [] and "again" in said, "the report is a.json.json"


def written(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


COMMANDS = [
    ["egg.ply", "egg.ply"],
    ["egg.ply", "./", "--format", "ply"],
    ["egg.ply", "sub/../egg.ply"],
    ["egg.ply", "linked.ply"],
    ["egg.ply", "hard.ply"],
    ["linked.ply", "egg.ply"],
    ["egg.ply", "other.ply", ".", "--format", "ply"],
    ["egg_####.ply", "egg_####.ply", "--frames", "1-2"],
    ["egg.ply", "egg_####.ply", "new/{file}.ply"],
    ["thickness", "egg.ply", "egg.ply"],
    ["thickness", "egg.ply", "other.ply", ".", "--format", "ply"],
    ["skeleton", "egg.obj", "egg.obj"],
    ["skeleton", "egg.obj", ".", "--format", "obj"],
    ["egg.npz", "egg.npz"],
    ["thickness", "egg_####.ply", "./egg_####.ply", "--frames", "1-2"],
    ["balls", "egg_0001.ply", "hard.ma"],
    ["balls", "egg_####.ply", "hard_####.ma", "--frames", "1-2"],
]


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_no_output_replaces_an_input(here, run, words):
    """The command refuses it, by name, link, folder or frame, computes nothing and changes no byte."""
    points = egg(1.0, 30)[:, :3]
    for name in ("egg", "other", "egg_0001", "egg_0002"):
        write_ply(here / f"{name}.ply", points)
    (here / "egg.obj").write_text("".join("v {} {} {}\n".format(*p) for p in points.tolist()))
    np.savez(here / "egg.npz", vertices=points)
    (here / "sub").mkdir()
    (here / "linked.ply").symlink_to("egg.ply")
    os.link(here / "egg.ply", here / "hard.ply")
    os.link(here / "egg_0001.ply", here / "hard.ma")
    os.link(here / "egg_0002.ply", here / "hard_0002.ma")
    before = written(here)
    code, reports, said = run(*words)
    assert code == cli.USAGE and reports == [] and written(here) == before
    if "new/{file}.ply" not in words:
        assert "Expected an output that replaces no input" in said


def test_outputs_next_to_inputs_are_written(here, run):
    assert run("egg.xyz", "./", "--format", "ply")[0] == cli.DONE
    assert files(here) == ["egg.ply", "egg.ply.json", "egg.xyz"]
    assert run("egg.xyz", "./", "--format", "ply")[1][0]["status"] == "kept"


def test_numbered_files(here, run):
    for frame in (8, 9, 10):
        write_egg(here / f"egg_{frame:03d}.xyz", 1 + frame / 10)
    code, reports, _ = run("egg_###.xyz", "axes/{name}.#####.npz", "--frames", "8-10")
    assert code == cli.DONE
    assert [r["frame"] for r in reports] == [8, 9, 10]
    names = [f"egg.{frame:05d}.npz" for frame in (8, 9, 10)]
    assert [r["output"] for r in reports] == [f"axes/{name}" for name in names]
    assert len({r["digest"] for r in reports}) == 3
    assert run("egg_###.xyz", "axes/", "--frames", "9-11", "--format", "off")[0] == cli.INPUT
    assert {"egg_0009.off", "egg_0010.off"} <= set(files(here / "axes"))


def test_frames():
    assert parse_frames("1-4") == [1, 2, 3, 4]
    assert parse_frames("7") == [7]
    assert parse_frames("1-10:4, 3,2-3") == [1, 2, 3, 5, 9]
    assert parse_frames("-3--1") == [-3, -2, -1]
    for text in ("", "a", "1-", "4-1", "1-4:0", "1-4:", "1;2", "1e9"):
        with pytest.raises(ValueError, match="Expected frames such as"):
            parse_frames(text)
    with pytest.raises(ValueError, match="at most 1,000,000 frames, found 999,999,999"):
        parse_frames("1-999999999")
    assert at_frame("a_####/b_##.ply", 123) == "a_0123/b_123.ply"
    assert output_path("{file}/{name}_##.ma", "A/b: #1", "x", 3) == Path("x/A_b_ #1_03.ma")


DEVICES = (
    "CON", "nul", "Aux", "prn", "COM1", "com9", "LPT1", "COM¹", "CONIN$", "NUL.txt", "con .x",
)  # fmt: skip


@pytest.mark.parametrize("name", [".", "..", "...", "Body.", "Body ", " ", *DEVICES])
def test_names_that_lead_elsewhere_are_refused(name):
    """An object called .. would write into the folder above; devices and trailing dots are those of Windows."""
    with pytest.raises(InvalidInputError, match="Expected a name that files can have on every"):
        output_path("axes/{name}/axis.npz", name, "file", None)
    with pytest.raises(InvalidInputError, match=re.escape(f"found '{name}' for '{{file}}'")):
        output_path("axes/{file}/axis.npz", "name", name, None)


@pytest.mark.parametrize("name", ["console", "COM10", "Nullo", ".hidden", "a..b", "a b", "..a"])
def test_names_like_those_are_taken(name):
    assert output_path("axes/{name}.ma", name, "file", None) == Path(f"axes/{name}.ma")


def test_numbers_can_make_a_device():
    assert output_path("com#_{name}.ma", "a", "b", 1) == Path("com1_a.ma")
    with pytest.raises(InvalidInputError, match="found 'com1.ma' for 'com#.ma'"):
        output_path("com#.ma", "a", "b", 1)


# --- resuming


@pytest.mark.parametrize(
    "change",
    [
        lambda: write_egg("egg.xyz", 1.01),
        lambda: Path("egg.ma").unlink(),
        lambda: Path("egg.ma.json").unlink(),
        lambda: Path("egg.ma").write_bytes(Path("egg.ma").read_bytes()[:-1]),
        lambda: Path("egg.ma.json").write_text("{"),
        lambda: Path("egg.ma.json").write_text("[1]"),
    ],
    ids=["input", "no output", "no report", "output", "broken report", "other report"],
)
def test_what_changed_is_computed_again(here, run, change):
    run("egg.xyz", "egg.ma")
    change()
    assert run("egg.xyz", "egg.ma")[1][0]["status"] == "done"
    assert run("egg.xyz", "egg.ma")[1][0]["status"] == "kept"


# --- as a program


def test_folder_of_the_package_is_a_program(here):
    words = [sys.executable, str(PACKAGE), "egg.xyz", "egg.ma"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "") and Path("egg.ma").is_file()


def test_program_says_usage_and_version(program):
    assert program().returncode == cli.USAGE
    assert program("--version").stdout.startswith("medial_axis ")
    assert "Traceback" not in program("a.off", "b.ma", "--nonsense").stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_cancelled(here, program, number):
    """The second of three is stopped in the middle of its computation; the first is there."""
    np.save("big.npy", egg(count=150_000))
    write_egg(here / "third.xyz")
    process = program("egg.xyz", "big.npy", "third.xyz", "out/{name}.ma", "--json", popen=True)
    assert json.loads(process.stdout.readline())["status"] == "done"
    time.sleep(0.5)
    process.send_signal(number)
    out, said = process.communicate(timeout=60)
    assert process.returncode == cli.CANCELLED and "Traceback" not in said
    assert json.loads(out)["status"] == "cancelled"
    assert files(here / "out") == ["egg.ma", "egg.ma.json"]


def test_killed_while_writing_leaves_the_old_file(here, program):
    """kill -9 comes as soon as the new file begins to grow next to the old one."""
    Path("out").mkdir()
    np.save("big.npy", egg(count=25_000))
    words = "big.npy", "out/big.off", "--mesh", "voronoi"  # a file that takes a while
    assert program(*words, "--rho", "20").returncode == 0
    old = Path("out/big.off").read_bytes(), Path("out/big.off.json").read_bytes()
    process, until = program(*words, popen=True), time.monotonic() + 60
    while not any(path.stat().st_size for path in Path("out").glob(".medial_axis_*.tmp")):
        assert process.poll() is None, "it was written before it could be killed"
        assert time.monotonic() < until, "it did not begin to write"
        time.sleep(0.005)
    process.kill()
    process.communicate()
    assert (Path("out/big.off").read_bytes(), Path("out/big.off.json").read_bytes()) == old
    again = program(*words, "--json")
    assert json.loads(again.stdout)["status"] == "done"
    assert Path("out/big.off").read_bytes() != old[0]


def test_two_at_once_in_one_folder(here, program):
    """The same work runs twice, next to other work: every file is whole, and equal to one made alone."""
    names = [f"egg{i}.npy" for i in range(3)]
    for i, name in enumerate(names):
        np.save(name, egg(1 + i / 5, 3000))
    assert program(*names, "alone/").returncode == 0
    both = [program(*order, "out/", popen=True) for order in (names, names[::-1])]
    assert [(p.communicate()[1], p.returncode) for p in both] == [("", 0)] * 2
    assert files(here / "out") == files(here / "alone")
    for name in ("egg0.ma", "egg1.ma", "egg2.ma"):
        assert (here / "out" / name).read_bytes() == (here / "alone" / name).read_bytes()
    kept = program(*names, "out/", "--json")
    assert [json.loads(x)["status"] for x in kept.stdout.splitlines()] == ["kept"] * 3


def test_progress_on_a_terminal(here, program):
    import pty

    np.save("big.npy", egg(count=8_000))
    try:
        ours, theirs = pty.openpty()
    except OSError as reason:  # in a chroot without /dev/pts
        pytest.skip(f"no terminal: {reason}")
    process = program("big.npy", "big.ma", popen=True, stderr=theirs)
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 4096):
            shown += piece
    except OSError:  # how a terminal ends
        pass
    os.close(ours)
    process.communicate()
    assert process.returncode == 0
    assert re.search(rb"\r\x1b\[Kbig\.npy: [A-Z][a-z ]+, \d+ %|big.npy, [A-Z]", shown), shown[-300:]


# --- documentation


def documented(name):
    """The commands of the fenced blocks `sh` of a page that run without Blender."""
    text = (ROOT / "docs" / name).read_text(encoding="utf-8")
    lines = "\n".join(re.findall(r"```sh\n(.*?)```", text, re.DOTALL)).replace("\\\n", " ")
    return [line for line in lines.splitlines() if line.startswith("python3 -m medial_axis")]


def test_documented_commands(here, program):
    """Every command of the page ends well, in the order of the page."""
    for name in ("bunny.ply", "hand.obj", "scan.xyz"):
        write_input(here / name)
    for frame in range(1, 6):
        write_egg(here / f"cloth_{frame:04d}.xyz", 1 + frame / 10)
    commands = documented("command_line.md")
    assert len(commands) >= 5
    for command in commands:
        done = program(*shlex.split(command.partition("#!")[0])[3:])
        assert done.returncode == 0, f"{command}: {done.stderr}"


def write_input(path):
    table = egg()
    if path.suffix == ".obj":
        text = "".join(
            "vn {} {} {}\nv {} {} {}\n".format(*n, *p)
            for p, n in zip(table[:, :3].tolist(), table[:, 3:].tolist())
        )
        path.write_text(text)
    elif path.suffix == ".ply":
        write_ply(path, table)
    else:
        write_egg(path)


def test_documented_options_are_all():
    """The table of the page names every option, with its default."""
    text = (ROOT / "docs" / "command_line.md").read_text(encoding="utf-8")
    table = dict(re.findall(r"^\| `--([a-z-]+)[^`]*` \| ([^|]+?) \|", text, re.MULTILINE))
    for name, option in {**OPTIONS, **LIMITS}.items():
        shown = option_words._outward(option, option.default)
        if isinstance(option, Switch):
            shown = "on" if shown else "off"
        elif not isinstance(option, Choice):
            shown = f"{shown:g}"
        assert table.get(name.replace("_", "-")) == shown, name
    flags = {"frames", "object", "format", "options", "force", "allow-scripts", "json", "quiet"}
    assert flags <= {*table}
