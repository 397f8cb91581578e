# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing whose last bits differ between processors, C libraries or C++ libraries reaches a result: the sources and the
compiled module are searched for it.
"""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from native.packaging import check_module, paths  # noqa: E402 - found through the line above

SOURCES = [
    path
    for folder in ("medial", "python")
    for path in (ROOT / "native" / folder).rglob("*")
    if path.suffix in {".h", ".cpp"}
]
# The standard leaves the order of equal or of unselected items open, or the values of hashes and distributions.
OPEN = re.compile(
    r"std::(nth_element|partial_sort|partition|random_shuffle|shuffle|hash|[a-z_]+_distribution)\b"
)
# Products by BLAS, and functions of the C library. (Lengths along an axis are sums in order.)
NUMPY = re.compile(
    r"np\.linalg\.(?!norm\(.*axis=[12])\w+|np\.(?:dot|matmul|vdot|einsum)\(|\S @ \S"
    r"|(?:np|math)\.(?:sin|cos|tan|arc\w+|a?sinh?|a?cosh?|a?tanh?|atan2|exp\w*|log\w*|power|pow|cbrt|hypot|dist)\("
)
# These choose, count or draw.
ALLOWED = {
    "few_addresses.py": 1,  # makes BLAS start
    # Whole numbers.
    "nearness.py": 3,
    "fans.py": 1,
    "offset_surface.py": 7,
    "picture.py": 3,  # pictures in reports
}


def code_of(path):
    return re.sub(r"//.*", "", path.read_text(encoding="utf-8"))


def test_sources_call_no_inexact_function():
    functions = check_module.INEXACT.pattern
    found = {
        (path.name, match[0])
        for path in SOURCES
        for match in re.finditer(rf"\bstd::({functions})\(", code_of(path))
    }
    assert len(SOURCES) > 200
    assert found == set()


def test_orders_that_the_standard_leaves_open_are_not_used_for_items():
    found = {
        path.name: len(OPEN.findall(code_of(path)))
        for path in SOURCES
        if OPEN.search(code_of(path))
    }
    # Medians: of all that is left in the order, the value in the middle alone is read.
    medians = {"samples_on_faces.cpp", "focal_line.cpp", "crisp_rims.cpp", "closing_samples.cpp"}
    medians |= {"outliers.cpp", "mover.cpp", "noise.cpp"}
    assert set(found) == medians


def test_compiled_modules_import_no_inexact_function():
    compiled = sorted(paths.LIBRARY.glob("_medial.*-linux-gnu.so"))
    if not compiled:
        pytest.skip("no module was built")
    for module in compiled:
        check_module.without_inexact(module)


def test_results_of_python_depend_on_no_library():
    core = ROOT / "blender_addon" / "core"
    found = {}
    for path in core.rglob("*.py"):
        text = re.sub(r"`[^`]*`", "", path.read_text(encoding="utf-8"))
        if some := NUMPY.findall(text):
            found[path.name] = len(some)
    assert found == ALLOWED


def test_no_multiplication_is_contracted():
    assert "-ffp-contract=off" in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
