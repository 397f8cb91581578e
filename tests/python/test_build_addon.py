# SPDX-License-Identifier: GPL-3.0-or-later
"""build_addon.py and tools/packaging: what they ask for, what they pack, what they refuse."""

import ast
import json
import os
import re
import struct
import subprocess
import sys
import zipfile

import pytest

import build_addon
from tools.packaging import check_module, licences, macho, modules, needs, pack, paths, presets
from tools.packaging.blender import Blender
from tools.packaging.terminal import Failure

ROOT = paths.ROOT


@pytest.fixture(autouse=True)
def environment(monkeypatch):
    """The commands may change these; afterwards they are as before."""
    for name in ("PATH", "PYTHONHOME", "PYTHONPATH", "VIRTUAL_ENV"):
        monkeypatch.setenv(name, os.environ.get(name, ""))
        if not os.environ[name]:
            monkeypatch.delenv(name)


def write(folder, texts):
    """Files of these names with these texts, and the folders for them."""
    for name, text in texts.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


@pytest.fixture
def sources(tmp_path, monkeypatch):
    """A tiny add-on in place of the real one."""
    addon = tmp_path / "blender_addon"
    texts = {
        "__init__.py": 'bl_info = {"version": (1, 2, 3)}\n',
        "core/a.py": "a = 1",
        "lib/_medial.cpython-311-x86_64-linux-gnu.so": "compiled",
        "blender_manifest.toml": 'schema_version = "1.0.0"\nversion = "1.2.3"\n\n[permissions]\n',
        "../LICENSE": "licence",
    }
    write(addon, texts)
    monkeypatch.setattr(
        pack, "make_manual", lambda folder: (folder.mkdir(), (folder / "a.html").write_text("A"))
    )
    for name, path in {"ROOT": tmp_path, "ADDON": addon, "DIST": tmp_path / "dist"}.items():
        monkeypatch.setattr(paths, name, path)
    return addon


@pytest.mark.parametrize("command", ["", "build", "demo", "test", "bench", "race", "clean"])
def test_help_is_there(command):
    words = [sys.executable, str(ROOT / "build_addon.py"), *command.split(), "--help"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith("usage:") and "--help" in done.stdout


def test_the_driver_runs_on_python_3_8():
    """Python's own parser finds no newer syntax in its files; the linter finds uses of a newer library."""
    files = [ROOT / "build_addon.py", *(ROOT / "tools" / "packaging").glob("*.py")]
    files += [ROOT / "tests" / name for name in ("parts.py", "lint.py", "demo/show.py")]
    for file in files:
        ast.parse(file.read_text(encoding="utf-8"), str(file), feature_version=(3, 8))


@pytest.fixture
def advice(monkeypatch, capsys):
    """(command, which packages are missing) -> what a user without rights is told."""

    def told(command, is_missing):
        monkeypatch.setattr(needs, "is_installed", lambda package: not is_missing(package))
        monkeypatch.setattr(needs, "administrator_prefix", lambda: None)
        assert build_addon.main([command]) == 2
        return capsys.readouterr().err

    return told


def test_missing_packages_without_rights_name_the_command_and_exit_2(monkeypatch, advice):
    monkeypatch.setattr(needs.shutil, "which", lambda name: f"/usr/bin/{name}")
    command = "sudo apt-get update && sudo apt-get install -y --no-install-recommends"
    assert f"{command} cmake libcgal-dev" in advice("build", ("cmake", "libcgal-dev").__contains__)


@pytest.mark.parametrize("wanted", [needs.DEMO, needs.TEST], ids=["build", "test"])
def test_readme_names_what_the_commands_install(wanted):
    """The two sentences of the README that promise what is installed."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert not set(wanted.values()) - set(re.findall(r"[\w+.-]+", readme))


def test_a_user_without_rights_hears_of_all_packages_before_anything_is_done(monkeypatch, advice):
    monkeypatch.setattr(build_addon.modules, "build_core", lambda: pytest.fail("compiled"))
    told = advice("demo", ("cmake", "blender").__contains__)
    assert "--no-install-recommends cmake blender" in told


def test_packing_where_nothing_was_compiled_asks_for_what_it_needs(monkeypatch, advice):
    """In a bare container the modules come from other machines, licences and Blender from packages."""
    monkeypatch.setattr(build_addon, "find_blender", lambda name: pytest.fail("too early"))
    told = advice("pack", lambda package: True)
    assert "libcgal-dev libboost-dev pybind11-dev python3-markdown python3-numpy blender" in told
    assert "cmake" not in told


SYSTEMS = {
    "linux-x64": ["_medial.cpython-311-x86_64-linux-gnu.so"],
    "linux-arm64": ["_medial.cpython-313-aarch64-linux-gnu.so"],
    "macos-x64": ["_medial.cpython-311-darwin.so"],
    "macos-arm64": ["_medial.cpython-311-darwin.so"],
    "windows-x64": ["_medial.cp311-win_amd64.pyd"],
}


def image_of(processor):
    return struct.pack("<8I", 0xFEEDFACF, processor, 0, 6, 0, 0, 0, 0)


ARM, INTEL = image_of(macho.ARM64), image_of(macho.X64)
MANIFEST = {"blender_manifest.toml": b'version = "1"\n\n[permissions]\n'}


def test_each_system_gets_its_own_modules_from_one_folder():
    every = {f"lib/{name}": b"" for names in SYSTEMS.values() for name in names}
    every["lib/_medial.cpython-311-darwin.so"] = macho.join([ARM, INTEL])
    assert set(SYSTEMS) == set(pack.PLATFORMS)
    for platform, names in SYSTEMS.items():
        own = pack.for_platform({**every, **MANIFEST}, platform)
        assert [name for name in own if name.startswith("lib/")] == [f"lib/{n}" for n in names]
        assert f'platforms = ["{platform}"]'.encode() in own["blender_manifest.toml"]


def test_missing_blender_exits_2(monkeypatch):
    monkeypatch.setattr(needs, "require", lambda needs: None)
    assert build_addon.main(["build", "--blender", "no-such-blender"]) == 2


def test_zip_holds_what_is_needed_and_nothing_else(sources):
    caches = "core/__pycache__/a.cpython-311.pyc", "lib/_medial.new"
    extra = *caches, ".hidden/b.py", "core/.c.py", "core/notes.txt"
    write(sources, dict.fromkeys(extra, "not wanted"))
    target = pack.pack()
    assert target.name == "medial_axis-1.2.3.zip"
    assert sorted(zipfile.ZipFile(target).namelist()) == [
        "medial_axis/LICENSE",
        "medial_axis/THIRD_PARTY_LICENSES",
        "medial_axis/__init__.py",
        "medial_axis/blender_manifest.toml",
        "medial_axis/core/a.py",
        "medial_axis/lib/_medial.cpython-311-x86_64-linux-gnu.so",
        "medial_axis/manual/a.html",
        *(f"medial_axis/presets/medial_axis/{name}.py" for name in sorted(presets.PRESETS)),
    ]


def test_zip_for_the_platform_has_no_folder_and_says_what_it_is_for(sources):
    first = pack.pack()
    target = first.with_name("medial_axis-1.2.3-linux-x64.zip")
    with zipfile.ZipFile(first) as ours, zipfile.ZipFile(target) as platform:
        names = platform.namelist()
        assert [f"medial_axis/{name}" for name in names] == ours.namelist()
        manifest = platform.read("blender_manifest.toml").decode()
        platforms = 'version = "1.2.3"\n\nplatforms = ["linux-x64"]\n\n[permissions]\n'
        assert manifest == f'schema_version = "1.0.0"\n{platforms}'
        for name in set(names) - {"blender_manifest.toml"}:
            assert platform.read(name) == ours.read(f"medial_axis/{name}")


def commit_sources(folder):
    git = ["git", "-C", str(folder), "-c", "user.name=a", "-c", "user.email=a@b.c"]
    subprocess.run(["git", "init", "-q", folder], check=True)
    subprocess.run([*git, "add", "blender_addon"], check=True)
    subprocess.run([*git, "commit", "-qm", "all"], check=True)
    return git


def test_development_builds_carry_their_commit_and_releases_do_not(sources, monkeypatch):
    """In the names of the zips, in the manifest and in the package; a change that is not committed is said, too."""
    (sources / "__init__.py").write_text('bl_info = {"version": (1, 2, 3)}\nCOMMIT = ""  # here\n')
    git = commit_sources(paths.ROOT)
    terminal = sys.modules["tools.packaging.terminal"]
    monkeypatch.setattr(terminal, "ROOT", paths.ROOT)
    commit = paths.commit()
    assert re.fullmatch("g[0-9a-f]{8}", commit)
    target = pack.pack()
    assert target.name == f"medial_axis-1.2.3+{commit}.zip"
    with zipfile.ZipFile(target) as archive:
        manifest = archive.read("medial_axis/blender_manifest.toml").decode()
        assert manifest.startswith(f'schema_version = "1.0.0"\nversion = "1.2.3+{commit}"\n')
        assert f'\nCOMMIT = "{commit}"  # here' in archive.read("medial_axis/__init__.py").decode()
    (sources / "core" / "a.py").write_text("changed")
    assert paths.commit() == f"{commit}.modified"
    subprocess.run([*git, "commit", "-qam", "more"], check=True)
    subprocess.run([*git, "tag", "v1.2.3"], check=True)
    assert paths.commit() == "" and pack.pack().name == "medial_axis-1.2.3.zip"


def test_same_sources_same_zip(sources):
    first = pack.pack().read_bytes()
    for path in sources.rglob("*.py"):
        os.utime(path, (0, 0))
    assert pack.pack().read_bytes() == first


def test_versions_must_agree(sources):
    (sources / "blender_manifest.toml").write_text('version = "1.2.4"\n', encoding="utf-8")
    with pytest.raises(Failure, match=r"1\.2\.4.*1, 2, 3"):
        pack.pack()


def test_real_versions_agree():
    """Manifest and bl_info by the script itself; the newest heading of the changelog; the compiled modules."""
    version = paths.version()
    assert version.count(".") == 2
    changelog = (ROOT / "docs" / "changelog.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\d\S+)", changelog, re.MULTILINE)[0] == version
    compiled = sorted(paths.LIBRARY.glob("_medial.*.so"))
    assert compiled and all(version.encode() in module.read_bytes() for module in compiled)


class CompilingError(Exception):
    """A command has come to its compiling for Python; what follows is left out."""


@pytest.fixture
def configured(tmp_path, monkeypatch):
    """A function that runs a command of build_addon.py in one build folder, up to its compiling: the targets of it."""
    wanted = []

    def configure(preset, *definitions, targets=()):
        words = ["cmake", "--preset", preset, "-B", tmp_path, *definitions]
        subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
        words = ["cmake", "--build", tmp_path, "--target", "help"]
        there = subprocess.run(words, check=True, capture_output=True, text=True).stdout
        assert set(targets) <= {line.partition(":")[0] for line in there.splitlines()}
        wanted.extend(targets)
        if "-DMEDIAL_PYTHON=ON" in definitions:
            raise CompilingError

    def of(*words):
        wanted.clear()
        arguments = build_addon.parse(words)
        with pytest.raises(CompilingError):
            arguments.action(arguments)
        return set(wanted)

    python = sys.executable, "cpython-311-x86_64-linux-gnu"
    monkeypatch.setattr(needs, "is_installed", lambda package: True)
    monkeypatch.setattr(modules, "PYTHONS", {})
    for place in (build_addon, modules):
        monkeypatch.setattr(place, "blender_python", lambda blender: python)
    monkeypatch.setattr(modules, "build_preset", configure)
    return of


# Each command that compiles asks these of the build; the native tests are among all targets.
COMPILED = {
    ("build", "--local"): {"_medial"},
    ("demo",): {"medial", "_medial"},
    ("test", "--only", "build"): set(),
    ("bench",): {"_medial", "bare_triangulation"},
    ("race",): {"_medial", "_medial_study"},
}


def all_pairs(things):
    """A walk that steps from each thing to each, also to itself, once: of Hierholzer (1873)."""
    left, walk, stack = {one: list(things) for one in things}, [], [things[0]]
    while stack:
        if left[stack[-1]]:
            stack.append(left[stack[-1]].pop())
        else:
            walk.append(stack.pop())
    return walk


def test_every_command_compiles_what_it_needs_after_every_other(configured):
    """CMake remembers what the command before defined: bench once asked for a target that was not there."""
    walk = all_pairs(list(COMPILED))
    assert len(walk) == len(COMPILED) ** 2 + 1
    for words in walk:
        assert configured(*words) == COMPILED[words], words


def test_presets_forget_what_a_command_defined():
    """So the native tests that CONTRIBUTING.md names are there after each command, or it is an error."""
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    base = presets["configurePresets"][0]["cacheVariables"]
    assert base["MEDIAL_TESTS"] == base["MEDIAL_PYTHON"] == "ON"
    actions = [preset["execution"] for preset in presets["testPresets"]]
    assert actions == len(actions) * [{"noTestsAction": "error"}]


def compile_library(folder, source, *options, name="_medial.so"):
    """A shared library of one C++ source."""
    (folder / "a.cpp").write_text(source, encoding="utf-8")
    words = ["g++", "-shared", "-fPIC", "-o", folder / name, folder / "a.cpp", *options]
    subprocess.run(words, check=True)
    return folder / name


GOOD = 'extern "C" __attribute__((visibility("default"))) int PyInit__medial() { return 0; }\n'


def test_module_that_exports_one_symbol_passes(tmp_path):
    (_, text) = check_module.check(compile_library(tmp_path, GOOD))
    assert "exports PyInit__medial only" in text


SINES = "#include <cmath>\nint sum(double x) { return std::sin(x) + std::sqrt(x); }\n"


@pytest.mark.parametrize(
    "more, options, told",
    [
        ('extern "C" int other() { return 1; }\n', (), "PyInit__medial only, found 2"),
        (SINES, ("-fvisibility=hidden", "-O2"), "must not call sin of the C library"),
    ],
    ids=["it exports more", "it takes sines from the C library"],
)
def test_module_that_is_refused(tmp_path, more, options, told):
    module = compile_library(tmp_path, GOOD + more, *options)
    with pytest.raises(SystemExit, match=told):
        check_module.check(module)


@pytest.mark.parametrize(
    "name", ["libtbb.so.12", "libgmp.so.10", "libmpfr.so.6", "libpython3.11.so.1.0"]
)
def test_module_that_needs_blenders_libraries_is_refused(tmp_path, name):
    needed = compile_library(tmp_path, "", f"-Wl,-soname,{name}", name=name)
    with pytest.raises(SystemExit, match=f"must not need {name}"):
        check_module.check(compile_library(tmp_path, GOOD, "-Wl,--no-as-needed", needed))


def test_module_for_newer_systems_is_refused_unless_it_is_for_this_one(tmp_path, monkeypatch):
    source = '#include <cstdio>\nextern "C" __attribute__((visibility("default"))) '
    module = compile_library(tmp_path, source + 'int PyInit__medial() { return std::puts(""); }\n')
    check_module.check(module)
    monkeypatch.setitem(check_module.NEWEST, "GLIBC", "2.2")
    with pytest.raises(SystemExit, match=r"needs GLIBC_2\.\d+.*, newer than 2\.2; .*--local"):
        check_module.check(module)
    assert check_module.check(module, local=True)


def test_clean_removes_what_was_made(tmp_path, monkeypatch):
    made = "build/release/x", "dist/a.zip", "blender_addon/lib/m.so", "core/__pycache__/a.pyc"
    write(tmp_path, dict.fromkeys((*made, "demo_output/a.png", "keep.py"), "x"))
    places = {"ROOT": "", "BUILD": "build", "DIST": "dist", "LIBRARY": "blender_addon/lib"}
    for name, path in places.items():
        monkeypatch.setattr(paths, name, tmp_path / path)
    assert build_addon.main(["clean"]) == 0
    assert sorted(p.name for p in tmp_path.rglob("*") if p.is_file()) == ["a.png", "keep.py"]
    assert build_addon.main(["clean", "--all"]) == 0
    assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == ["keep.py"]


# --- presets and licences


LINUX = "lib/_medial.cpython-311-x86_64-linux-gnu.so"


def test_licences_name_what_is_compiled_in_with_versions_and_terms():
    text = licences.text([LINUX])
    for name in ("libcgal-dev", "libboost", "pybind11-dev"):
        assert re.search(rf"^Debian package {name}\S* \d+\.\d+", text, re.MULTILINE), name
    for words in (
        "Boost Software License - Version 1.0",
        "Redistributions in binary form must reproduce",
        "GNU LESSER GENERAL PUBLIC LICENSE",
    ):
        assert words in text
    assert "winpthreads" not in text and len(text) < 200_000


def test_licence_that_is_not_at_hand_is_a_failure(tmp_path, monkeypatch):
    monkeypatch.setattr(licences, "DOCUMENTS", tmp_path)
    with pytest.raises(Failure, match="Expected the licence of CGAL at .*libcgal-dev/copyright"):
        licences.text([LINUX])
    nothing = licences.Component("Nothing", "/no/such/*.h", "none")
    monkeypatch.setattr(licences, "EVERYWHERE", (nothing,))
    with pytest.raises(Failure, match=r"Expected Nothing as /no/such/\*\.h, found none"):
        licences.text([LINUX])


def test_a_private_blender_finds_the_systems_python_first(monkeypatch, tmp_path):
    """Debian's Blender started by a pyenv's Python once took that one's library, which has no NumPy."""
    monkeypatch.setenv("PATH", "/home/artist/.pyenv/bin:/bin")
    monkeypatch.setenv("PYTHONHOME", "/home/artist/.pyenv")
    environment = Blender(["blender"], tmp_path / "profile").environment
    assert environment["PATH"].startswith("/usr/bin:") and "PYTHONHOME" not in environment
