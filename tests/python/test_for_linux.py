# SPDX-License-Identifier: GPL-3.0-or-later
"""Modules for Linux: older systems run them; packages for arm64 are those of the other processor."""

import platform
import re
import subprocess
import sys

import pytest
from support.package import ROOT

from tools.packaging import check_module, debian, paths

APT = """#!/bin/sh
case "$*" in
  *indextargets*) echo http://mirror/debian/ ;;
  *) echo "$@" >> "$APT_LOG" ;;
esac
"""


@pytest.fixture
def asked_of_apt(tmp_path, monkeypatch):
    """The words that a stand-in for apt-get was given, line by line."""
    program = tmp_path / "apt-get"
    program.write_text(APT)
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setenv("APT_LOG", str(tmp_path / "log"))
    monkeypatch.setattr(debian, "KEYRING", program)
    return lambda: (tmp_path / "log").read_text().splitlines()


def test_packages_of_another_processor_are_asked_for(tmp_path, asked_of_apt):
    debian.download(tmp_path / "own", "bookworm", ["a"])
    debian.download(tmp_path / "other", "bookworm", ["a"], "arm64")
    *own, update, download = asked_of_apt()
    assert not any("APT::Architecture" in line for line in own)
    for line, command in ((update, "update"), (download, "download a")):
        assert "-oAPT::Architecture=arm64 -oAPT::Architectures=arm64" in line
        assert line.endswith(f" {command}")


# Returns 0 where all that older_systems.cpp replaces works, else the number of the line that does not.
USER = """
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
static int alive = 0;
struct Error {
  Error() { ++alive; }
  Error(const Error&) { ++alive; }
  ~Error() { --alive; }
};
static int exceptions() {
  std::exception_ptr one = std::make_exception_ptr(Error{}), two = one, three;
  three = two;
  one = two = nullptr;
  try { std::rethrow_exception(three); } catch (const Error&) { return alive == 1 ? 0 : __LINE__; }
  return __LINE__;
}
static int lengths() {
  try { (void)std::allocator<double>().allocate(std::size_t(-1) / 4); }
  catch (const std::bad_array_new_length&) { return 0; }
  return __LINE__;
}
extern "C" __attribute__((visibility("default"))) int PyInit__medial() {
  if (int line = exceptions()) return line;
  if (alive != 0) return __LINE__;
  if (int line = lengths()) return line;
  std::once_flag flag;
  int calls = 0;
  for (int i = 0; i < 3; ++i) std::call_once(flag, [&] { ++calls; });
  if (calls != 1) return __LINE__;
  std::shared_ptr<int> shared = std::make_shared<int>(3), copy = shared;
  if (*copy != 3 || shared.use_count() != 2) return __LINE__;
  std::ostringstream text;
  text << 1.5 << "x";
  volatile double e = 2.718281828459045;
  return text.str() == "1.5x" && std::log(e) == 1 ? 0 : __LINE__;
}
"""


def compiled(tmp_path, *more, level="-O2"):
    module = tmp_path / "_medial.cpython-311-x86_64-linux-gnu.so"
    (tmp_path / "user.cpp").write_text(USER)
    (tmp_path / "exports.map").write_text("{ global: PyInit__medial; local: *; };")
    words = ["-std=c++20", level, "-shared", "-fPIC", "-fvisibility=hidden", "-fno-math-errno"]
    words += ["-Wall", "-Wextra", "-Werror", f"-Wl,--version-script={tmp_path}/exports.map"]
    subprocess.run(["g++", *words, "-o", module, tmp_path / "user.cpp", *more], check=True)
    return module


@pytest.mark.parametrize("level", ["-Os", "-O1", "-O2", "-O3"])
def test_what_older_systems_lack_is_in_the_module_and_works(tmp_path, monkeypatch, level):
    """Whatever of the C++ library the compiler puts inline: copies of exceptions once called themselves for ever."""
    monkeypatch.setattr(check_module, "OF_CGAL", {"log"})
    with pytest.raises(SystemExit, match=r"needs (GLIBC|GLIBCXX|CXXABI)_\S+, newer than"):
        check_module.check(compiled(tmp_path, level=level))
    module = compiled(tmp_path, ROOT / "native/python/older_systems.cpp", level=level)
    assert "exports PyInit__medial only" in check_module.check(module)[1]
    call = "import ctypes, sys; sys.exit(ctypes.CDLL(sys.argv[1]).PyInit__medial())"
    assert subprocess.run([sys.executable, "-c", call, module]).returncode == 0


def test_the_docs_say_what_modules_for_linux_ask_for():
    compiled = sorted(paths.LIBRARY.glob("_medial.*-x86_64-linux-gnu.so"))
    system = platform.freedesktop_os_release()
    if not compiled or (system["ID"], system.get("VERSION_ID")) != ("debian", "12"):
        pytest.skip("no module was built on Debian 12, as releases are")
    stated = (ROOT / "docs" / "compatibility.md").read_text(encoding="utf-8")
    for module in compiled:
        (asked,) = re.findall(r"GLIBC ([\d.]+),", check_module.check(module)[1])
        assert f"| Linux x86-64 | none | glibc {asked}, C++ run time" in stated
