#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Refuses a compiled module that would not live well inside Blender, and prints what it needs.

    python3 tools/packaging/check_module.py _medial.cpython-311-x86_64-linux-gnu.so ... [--local]

A module must not need libraries that Blender brings too, must export its entry point alone, must call
no function of the C library whose last bits differ from machine to machine, and must run on systems
as old as RHEL 8 and Ubuntu 20.04. --local allows newer ones: it is for this machine. None may name the
folder in which it was built.
One for Windows must need nothing but Python and what every Windows has. One for Macs must need nothing
but what every macOS since 11.0 has, take no name that neither Python nor macOS has, be signed, and lie in
pages of the size that its processor has.
"""

import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from tools.packaging import macho, paths, pe, zig

FORBIDDEN = re.compile(r"lib(tbb|gmp|mpfr|python)")
# Functions whose last bits differ between C libraries and processors; base/portable_math.h has others for them.
INEXACT = re.compile(
    r"(sin|cos|sincos|tan|asin|acos|atan|sinh|cosh|tanh|asinh|acosh|atanh|atan2|exp|exp2|exp10|expm1|log|log2|log10"
    r"|log1p|pow|cbrt|hypot|erf|erfc|tgamma|lgamma|j0|j1|jn|y0|y1|yn)[fl]?"
)
# CGAL calls these, and none reaches a result. In alpha wraps sincos (for Macs sin and cos) gives the direction of a ray
# that tells whether a point is inside closed faces, which all directions tell alike, and log the level at which
# a search for a cell begins. In remeshing cos is asked for 160 degrees alone, beyond which a triangle is a cap.
OF_CGAL = {"sincos", "log", "cos"}
OF_WINDOWS = {"KERNEL32.dll", "msvcrt.dll"}  # every Windows has these
OF_MACS = ["/usr/lib/libSystem.B.dylib"]
OLDEST_MACOS = (11, 0)
PAGE_OF_MACS = {macho.X64: 4096, macho.ARM64: 16384}
# zig's linker cannot hide the operators new and delete of its C++ library, all of which end in malloc and free, names
# of types, which are alike wherever they are defined, nor the entry point that pybind11 writes and ours calls; it adds
# two marks.
OF_ZIG = re.compile(
    r"__Z(nw|na|dl|da)\w+|__ZT[IS]\w+|_initialise_medial|__mh_dylib_header|___dso_handle"
)
ENTRY = "PyInit__medial"
# The newest symbol versions that those systems have (glibc 2.28 and the C++ library of GCC 8).
NEWEST = {"GLIBC": "2.28", "GLIBCXX": "3.4.25", "CXXABI": "1.3.11"}


def check(module, local=False):
    """Lines to print about a module; raises SystemExit with one sentence."""
    names_no_folder(module)
    if module.name.endswith("-darwin.so"):
        return check_mac(module)
    return check_windows(module) if module.suffix == ".pyd" else check_linux(module, local)


def names_no_folder(module):
    if str(paths.ROOT).encode() in module.read_bytes():
        refuse(module, f"must not name {paths.ROOT}, where it was built; strip it")


def check_mac(module):
    """Each processor's image by itself."""
    found = [macho.read(data) for data in macho.processors(module.read_bytes()).values()]
    for image in found:
        check_image(module, image)
        only_entry(module, [name[1:] for name in image.exported if not OF_ZIG.fullmatch(name)])
        calls_nothing_inexact(module, image.undefined - {"_sin"})  # Clang's sincos
        missing = image.undefined - python_for_macs(module) - names_of_macos(image.processor)
        if missing:
            refuse(module, f"must take names of Python and macOS alone, found {sorted(missing)}")
    names = " and ".join(macho.NAMES[image.processor] for image in found)
    return [
        f"{module.name}: {module.stat().st_size / 1e6:.1f} MB for {names}, needs {OF_MACS[0]}",
        f"  exports {ENTRY} and operators of C++; every name it takes is of Python or of macOS",
    ]


def check_image(module, image):
    """Whether macOS would load it."""
    if image.libraries != OF_MACS:
        refuse(module, f"must need {OF_MACS[0]} alone, found {image.libraries}")
    if image.oldest_system is None or image.oldest_system > OLDEST_MACOS:
        refuse(module, f"must run on macOS 11.0, found {image.oldest_system} to be needed")
    if image.processor == macho.ARM64 and not image.signed:
        refuse(module, "must have a signature that agrees with its pages, found none")
    page = PAGE_OF_MACS[image.processor]
    if image.page < page:
        refuse(module, f"must have pages of {page} bytes, found {image.page}")


def python_for_macs(module):
    """The names that Python gives to others on Macs."""
    digits = re.search(r"cpython-3(\d+)-", module.name)[1]
    library = paths.BUILD / "python" / "macos" / f"3.{digits}" / f"libpython3.{digits}.dylib"
    (data, *_) = macho.processors(library.read_bytes()).values()
    return macho.read(data).exported


def names_of_macos(processor):
    """The names that macOS gives to programs for a processor, of the list that zig links with."""
    listed = (zig.program().parent / "lib/libc/darwin/libSystem.tbd").read_text(encoding="utf-8")
    wanted = {macho.X64: "x86_64-macos", macho.ARM64: "arm64e-macos"}[processor]
    found = set()
    for part in listed.split("targets:"):
        targets, _, names = part.partition("]")
        if wanted in targets:
            found.update(re.findall(r"[A-Za-z_][\w$.]*", names))
    return found


def check_windows(module):
    """Names of Python that no library has are known to the linker, which has a list of them."""
    image = pe.read(module.read_bytes())
    digits = re.fullmatch(r"_medial\.cp(\d+)-win_amd64", module.stem)[1]
    if image.processor != pe.X64:
        refuse(module, f"must be for amd64, found {image.processor:#x}")
    python = f"python{digits}.dll"
    found = sorted(image.libraries)
    if python not in found or not OF_WINDOWS.issuperset(image.libraries - {python}):
        refuse(module, f"must need {python} and what every Windows has, found {found}")
    only_entry(module, image.exported)
    size = module.stat().st_size / 1e6
    return [
        f"{module.name}: {size:.1f} MB, needs {', '.join(found)}",
        f"  exports {ENTRY} only",
    ]


def only_entry(module, exported):
    if exported != [ENTRY]:
        refuse(module, f"must export {ENTRY} only, found {len(exported)}: {exported[:5]}")


def without_inexact(module):
    names = [
        line.split()[-1] for line in output("nm", "-D", "--undefined-only", module).splitlines()
    ]
    calls_nothing_inexact(module, {name.split("@")[0] for name in names})


def calls_nothing_inexact(module, names):
    """Names of Macs begin with an underscore more, and theirs for both sine and cosine ends with _stret."""
    called = {name.strip("_").replace("_stret", "") for name in names} - OF_CGAL
    inexact = sorted(filter(INEXACT.fullmatch, called))
    if inexact:
        refuse(
            module,
            f"must not call {', '.join(inexact)} of the C library, whose last bits differ from machine to machine; "
            "use base/portable_math.h",
        )


def check_linux(module, local):
    libraries = re.findall(r"\(NEEDED\).*\[(.+)\]", output("readelf", "-d", module))
    unwanted = [library for library in libraries if FORBIDDEN.match(library)]
    if unwanted:
        refuse(module, f"must not need {', '.join(unwanted)}; link it statically or leave it out")
    exported = [
        line.split()[-1] for line in output("nm", "-D", "--defined-only", module).splitlines()
    ]
    only_entry(module, exported)
    without_inexact(module)
    symbols = output("objdump", "-T", module)
    found = {name: newest(name, symbols) for name in NEWEST}
    for name, version in found.items():
        if not local and numbers(version) > numbers(NEWEST[name]):
            refuse(
                module,
                f"needs {name}_{version}, newer than {NEWEST[name]}; build what others shall use on "
                "Debian 12 or older, or with --local for this machine alone",
            )
    needed = ", ".join(f"{name} {version or 'none'}" for name, version in found.items())
    return [
        f"{module.name}: {module.stat().st_size / 1e6:.1f} MB, needs {', '.join(libraries)}",
        f"  exports {ENTRY} only; newest versions needed: {needed}",
    ]


def refuse(module, reason):
    raise SystemExit(f"{module.name} {reason}")


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def numbers(version):
    return [int(part) for part in version.split(".") if part]


def newest(name, symbols):
    """The highest version of a library's symbols, such as '2.34'; '' when there is none."""
    return max(re.findall(rf"\b{name}_([0-9.]+)", symbols), key=numbers, default="")


if __name__ == "__main__":
    for word in sys.argv[1:]:
        if word != "--local":
            print("\n".join(check(Path(word), "--local" in sys.argv)))
