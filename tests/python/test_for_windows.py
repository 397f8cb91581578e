# SPDX-License-Identifier: GPL-3.0-or-later
"""Modules for Windows: what is read of them, what is refused, how they are made. No test needs a Windows."""

import re
import struct
import subprocess
import sysconfig

import pytest
from support.package import ROOT

from tools.packaging import check_module, headers_for_windows, licences, paths, pe
from tools.packaging.terminal import Failure

START, PLACE = 0x1000, 0x400  # of the only section, in memory and in the file
NEEDED = ("python311.dll", "KERNEL32.dll")


def library(processor=pe.X64, needed=NEEDED, exported=("PyInit__medial",), kind=0x20B):
    """A library without code: one section with the libraries that it needs and the names that it gives."""
    body = bytearray()

    def put(data):
        body.extend(data + bytes(-len(data) % 8))
        return START + len(body) - len(data) - (-len(data) % 8)

    rows = [struct.pack("<5I", 0, 0, 0, put(name.encode() + b"\0"), 0) for name in needed]
    imports = put(b"".join(rows) + bytes(20))
    names = put(b"".join(struct.pack("<I", put(name.encode() + b"\0")) for name in exported))
    exports = put(struct.pack("<10I", 0, 0, 0, 0, 1, 0, len(exported), 0, names, 0))
    options = struct.pack("<H110x4I", kind, exports, 1, imports, 1)
    head = b"MZ".ljust(60, b"\0") + struct.pack("<I", 64) + b"PE\0\0"
    head += struct.pack("<2H3I2H", processor, 1, 0, 0, 0, len(options), 0) + options
    head += struct.pack("<8s4I16x", b".all", len(body), START, len(body), PLACE)
    return head.ljust(PLACE, b"\0") + bytes(body)


def test_what_a_library_says_is_read():
    found = pe.read(library(0xAA64, ("a.dll", "b.dll", "a.dll"), ("x", "yy")))
    assert found == pe.Image(0xAA64, {"a.dll", "b.dll"}, ["x", "yy"])
    assert pe.read(library(needed=(), exported=())) == pe.Image(pe.X64, set(), [])
    with pytest.raises(ValueError, match="no library for Windows"):
        pe.read(b"\x7fELF" + bytes(80))
    with pytest.raises(ValueError, match="no library of 64 bits"):
        pe.read(library(kind=0x10B))


@pytest.mark.parametrize(
    "fault, told",
    [
        ({}, None),
        ({"needed": (*NEEDED, "msvcrt.dll")}, None),
        ({"processor": 0xAA64}, "must be for amd64, found 0xaa64"),
        ({"needed": ("KERNEL32.dll",)}, "must need python311.dll and what every Windows has, fou"),
        ({"needed": (*NEEDED, "python313.dll")}, "must need python311.dll and what every Windows"),
        ({"needed": (*NEEDED, "libstdc++-6.dll")}, "must need python311.dll and what every W"),
        ({"needed": (*NEEDED, "api-ms-win-crt-math-l1-1-0.dll")}, "must need python311.dll"),
        ({"exported": ()}, "must export PyInit__medial only, found 0"),
        ({"exported": ("main",)}, "must export PyInit__medial only, found 1: .'main'"),
        ({"exported": ("PyInit__medial", "x")}, "must export PyInit__medial only, found 2"),
    ],
)
def test_module_for_windows_needs_python_and_windows_alone(tmp_path, fault, told):
    module = tmp_path / "_medial.cp311-win_amd64.pyd"
    module.write_bytes(library(**fault))
    if told is None:
        (needed, exports) = check_module.check(module)
        assert "needs KERNEL32.dll, " in needed and needed.endswith("python311.dll")
        assert "exports PyInit__medial only" in exports
    else:
        with pytest.raises(SystemExit, match=told):
            check_module.check(module)


def test_a_unit_that_sees_windows_is_compiled_alone():
    """Its macros are words such as near and far, which the units compiled together with it would see, too."""
    native = ROOT / "native"
    files = [path for end in ("cpp", "h") for path in native.rglob(f"*.{end}")]
    seeing = [path for path in files if "#include <windows.h>" in path.read_text("utf-8")]
    assert [path.suffix for path in seeing] == [".cpp"], "a header would bring them everywhere"
    rules = (native / "CMakeLists.txt").read_text("utf-8")
    for unit in seeing:
        name = re.escape(unit.relative_to(native).as_posix())
        assert re.search(rf"\({name} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON\)", rules)


def test_the_module_gives_out_its_own_entry_alone(tmp_path):
    """Not that of pybind11, which it calls. Elsewhere the linker would hide it, on Windows none does."""
    (tmp_path / "docstrings.h").write_text("")
    folders = [tmp_path, *(ROOT / "native" / name for name in ("include", "medial", "python"))]
    words = ["-std=c++20", "-E", "-P", "-DPYBIND11_EXPORT=GIVEN_OUT", *(f"-I{f}" for f in folders)]
    words.append(f"-I{sysconfig.get_paths()['include']}")
    source = ROOT / "native" / "python" / "module.cpp"
    text = subprocess.check_output(["g++", *words, source], text=True)
    assert set(re.findall(r"GIVEN_OUT PyObject\s*\*\s*(\w+)", text)) == {"PyInit__medial"}
    assert "initialise_medial" in text


EXPORTING = (
    'extern "C" { int PyInit(){return 0;} int _PyOther(){return 0;} int PyExc_A = 1; int other; }'
)


def test_import_library_has_the_names_of_python_and_knows_data(tmp_path, monkeypatch):
    """Made from a library for this system with some names as Python's have."""
    (tmp_path / "a.cpp").write_text(EXPORTING)
    made = tmp_path / "libpython.so"
    subprocess.run(["g++", "-shared", "-fPIC", "-o", made, tmp_path / "a.cpp"], check=True)
    monkeypatch.setattr(headers_for_windows, "DLLTOOL", "true")
    headers_for_windows.make_import_library(made, "python399", tmp_path)
    text = (tmp_path / "python399.def").read_text().splitlines()
    assert text[:2] == ["LIBRARY python399.dll", "EXPORTS"]
    assert sorted(text[2:]) == ["PyExc_A DATA", "PyInit", "_PyOther"]


def test_a_tool_that_is_missing_is_a_failure(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(Failure, match="expected x86_64-w64-mingw32-dlltool, found none"):
        headers_for_windows.fetch_for_windows("3.13", "trixie", tmp_path)


def test_licences_of_mingw_belong_to_what_was_compiled_here(tmp_path, monkeypatch):
    """Modules of Microsoft's compiler, from another machine, have none of it."""
    monkeypatch.setattr(paths, "BUILD", tmp_path)
    wanted = licences.Component("mingw-w64", "/no/such/*.a", "MIT and others")
    monkeypatch.setattr(licences, "WINDOWS", (wanted,))
    assert "mingw-w64" not in licences.text(["lib/_medial.cp311-win_amd64.pyd"])
    (tmp_path / "mingw").mkdir()
    with pytest.raises(Failure, match=r"Expected mingw-w64 as /no/such/\*\.a"):
        licences.text(["lib/_medial.cp311-win_amd64.pyd"])
