# SPDX-License-Identifier: GPL-3.0-or-later
"""Modules for Macs: what is read of them, what is refused, how they are made. No test needs zig or a Mac."""

import hashlib
import struct
import subprocess
from pathlib import Path

import pytest

from tools.packaging import check_module, licences, macho, paths, zig

SYSTEM = "/usr/lib/libSystem.B.dylib"
NAME = "_medial.cpython-311-darwin.so"


def image(
    processor=macho.ARM64,
    libraries=(SYSTEM,),
    system=(11, 0),
    undefined=("_malloc",),
    exported=("_PyInit__medial",),
    signed=True,
    places=(0, 16384),
):
    """A library for one processor, without code: its commands, its names, a signature of pages of 4096 bytes, and
    segments at these places in memory."""
    symbols = [(name, 0x01) for name in undefined] + [(name, 0x0F) for name in exported]
    symbols += [("_hidden", 0x1F), ("_local", 0x0E), ("_debug", 0x64)]
    commands = [library_command(name) for name in libraries]
    commands.append(struct.pack("<6I", 0x32, 24, 1, system[0] << 16 | system[1] << 8, 0, 0))
    for at in places:
        commands.append(struct.pack("<II16s4Q4I", 0x19, 72, b"__A", at, 1, at, 1, *4 * [0]))
    size = sum(map(len, commands)) + 24 + 16 * signed
    table, names = b"", b"\0"
    for name, kind in symbols:
        table += struct.pack("<IBBHQ", len(names), kind, 0, 0, 0)
        names += name.encode() + b"\0"
    start = 32 + size
    place = (start, len(symbols), start + len(table), len(names))
    commands.append(struct.pack("<6I", 2, 24, *place))
    end = start + len(table) + len(names)
    commands += [struct.pack("<4I", 0x1D, 16, end, 0)] * signed
    head = struct.pack("<8I", 0xFEEDFACF, processor, 0, 6, len(commands), size, 0, 0)
    whole = head + b"".join(commands) + table + names
    return whole + signature(whole) * signed


def library_command(name):
    text = name.encode() + b"\0"
    text += bytes(-len(text) % 8)
    return struct.pack("<6I", 0xC, 24 + len(text), 24, 0, 0, 0) + text


def signature(whole):
    pages = [whole[at : at + 4096] for at in range(0, len(whole), 4096)]
    hashes = b"".join(hashlib.sha256(page).digest() for page in pages)
    places = (44 + len(hashes), 0, 0, 44, 0, 0, len(pages), len(whole))
    directory = struct.pack(">9I", 0xFADE0C02, *places)
    directory += struct.pack("4BI", 32, 2, 0, 12, 0) + hashes
    return struct.pack(">5I", 0xFADE0CC0, 20 + len(directory), 1, 0, 20) + directory


def test_what_an_image_says_is_read():
    many = [f"_name_{i}" for i in range(300)]  # several pages
    found = macho.read(image(undefined=many, exported=("_a", "_b"), system=(12, 3)))
    names = (set(many), {"_a", "_b"})
    assert found == macho.Image(macho.ARM64, [SYSTEM], (12, 3), *names, True, 16384)
    assert macho.read(image(places=(4096, 16384))).page == 4096
    with pytest.raises(ValueError, match="no image of 64 bits"):
        macho.read(b"\x7fELF" + bytes(60))


@pytest.mark.parametrize("where", ["head", "names", "hash"])
def test_a_signature_that_disagrees_is_none(where):
    data = bytearray(image(undefined=[f"_name_{i}" for i in range(300)]))
    assert macho.read(bytes(data)).signed
    end = data.index(struct.pack(">I", 0xFADE0CC0))
    data[{"head": 28, "names": end - 10, "hash": len(data) - 1}[where]] ^= 1
    assert not macho.read(bytes(data)).signed


def test_images_for_two_processors_are_joined():
    arm, intel = image(), image(macho.X64, signed=False)
    both = macho.join([arm, intel])
    assert macho.processors(both) == {macho.ARM64: arm, macho.X64: intel}
    assert macho.processors(arm) == {macho.ARM64: arm}
    places = [struct.unpack_from(">I", both, 16 + 20 * row)[0] for row in range(2)]
    assert places == [16384, 32768], "images begin at pages of memory"


@pytest.fixture
def built(tmp_path, monkeypatch):
    """A folder build with the libraries that the checks compare with: Python's, and zig's list of macOS."""
    monkeypatch.setattr(paths, "BUILD", tmp_path)
    monkeypatch.setattr(paths, "LIBRARY", tmp_path / "lib")
    python = tmp_path / "python/macos/3.11/libpython3.11.dylib"
    python.parent.mkdir(parents=True)
    python.write_bytes(image(exported=("_PyList_New",), signed=False))
    listed = zig.program().parent / "lib/libc/darwin/libSystem.tbd"
    listed.parent.mkdir(parents=True)
    listed.write_text(
        "exports:\n  - targets: [ x86_64-macos ]\n    symbols: [ _old$INODE64 ]\n"
        "  - targets: [ x86_64-macos, arm64e-macos ]\n    symbols: [ _malloc, _tan, ___sincos_stret ]\n"
    )
    return tmp_path


@pytest.mark.parametrize(
    "fault, told",
    [
        ({}, None),
        ({"exported": ("_PyInit__medial", "__Znwm", "__ZdaPvm", "___dso_handle")}, None),
        ({"undefined": ("_PyList_New", "___sincos_stret")}, None),
        ({"processor": macho.X64, "signed": False, "undefined": ("_old$INODE64",)}, None),
        ({"libraries": (SYSTEM, "/usr/lib/libc++.1.dylib")}, "must need /usr/lib/libSystem.B"),
        ({"libraries": ()}, "must need /usr/lib/libSystem.B.dylib alone, found .."),
        ({"system": (12, 0)}, r"must run on macOS 11.0, found \(12, 0\)"),
        ({"processor": macho.X64, "places": (0, 4096)}, None),
        ({"places": (0, 20480)}, "must have pages of 16384 bytes, found 4096"),
        ({"places": ()}, "must have pages of 16384 bytes, found 0"),
        ({"signed": False}, "must have a signature"),
        ({"exported": ()}, "must export PyInit__medial only, found 0"),
        ({"exported": ("_PyInit__medial", "_other")}, "must export PyInit__medial only, found 2"),
        ({"undefined": ("_tan",)}, "must not call tan of the C library"),
        ({"undefined": ("_forgotten",)}, "Python and macOS alone, found .'_forgotten'"),
        ({"undefined": ("_old$INODE64",)}, "Python and macOS alone, found"),
    ],
)
def test_module_for_macs_needs_python_and_macos_alone(built, fault, told):
    module, own = built / NAME, image(**fault)
    module.write_bytes(macho.join([image(), own]) if "processor" in fault else own)
    if told is None:
        text = check_module.check(module)
        assert "for arm64" in text[0] and "every name it takes is of Python or of macOS" in text[1]
    else:
        with pytest.raises(SystemExit, match=told):
            check_module.check(module)


def test_module_that_names_a_folder_of_its_build_is_refused(built, monkeypatch):
    monkeypatch.setattr(paths, "ROOT", Path("/home/somebody/checkout"))
    module = built / NAME
    module.write_bytes(image(undefined=("_malloc",)) + b"/home/somebody/checkout/a.cpp")
    with pytest.raises(SystemExit, match="must not name /home/somebody/checkout, where it was bui"):
        check_module.check(module)


def test_zig_is_brought_once_and_has_commands_for_each_target(tmp_path, monkeypatch):
    monkeypatch.setattr(paths, "BUILD", tmp_path / "with space")
    brought = []
    monkeypatch.setattr(zig, "_bring_headers", lambda target: ["libcgal-dev 6"])
    monkeypatch.setattr(
        zig, "_bring_compiler", lambda target: brought.append(target) or f"ziglang {zig.VERSION}"
    )
    assert zig.bring() == zig.bring() == ["libcgal-dev 6", f"ziglang {zig.VERSION}"]
    assert len(brought) == 1
    zig.program().parent.mkdir()
    zig.program().write_text('#!/bin/sh\necho "$@" in "$ZIG_GLOBAL_CACHE_DIR"\n')
    zig.program().chmod(0o755)
    for target in zig.TARGETS.values():
        said = subprocess.check_output([zig.folder() / target / "c++", "-c", "a b.cpp"], text=True)
        assert said.startswith(f"c++ -target {target} ") and "-c a b.cpp in " in said
        assert said.endswith("with space/zig/cache\n")
    monkeypatch.setattr(zig, "VERSION", "99")
    zig.bring()
    assert len(brought) == 2, "another version is brought anew"


def test_licences_name_what_zig_compiles_in(tmp_path, monkeypatch):
    monkeypatch.setattr(paths, "BUILD", tmp_path)
    assert "LLVM" not in licences.text([f"lib/{NAME}"]), "compiled on a Mac, which has the library"
    terms = zig.folder() / "ziglang/lib/libcxx/LICENSE.TXT"
    terms.parent.mkdir(parents=True)
    terms.write_text("The LLVM Project is under the Apache License")
    (zig.folder() / zig.STAMP).write_text(f"libcgal-dev 6\nziglang {zig.VERSION}\n")
    text = licences.text([f"lib/{NAME}"])
    assert f"libcgal-dev 6, ziglang {zig.VERSION}" in text and "The LLVM Project is under" in text
    assert "LLVM" not in licences.text(["lib/_medial.cpython-311-x86_64-linux-gnu.so"])
