#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what modules return, of other compilers and C++ libraries, with and without fused multiply-add in the C
library, on one to three threads: all of it must be the same to the last bit.

    python3 lab/benchmarks/same_bytes.py build/release/_medial.*.so build/clang/_medial.*.so [--only WORD ...]

Each line of output_hashes.py is one job. Exits with 1 where one differs, but for wraps, which are named and depend on
the version of CGAL. A module for Linux on arm64 is run by
qemu-user, which tests/matrix/arm64.sh prepares; its processor always has fused multiply-add.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

ARM64 = Path(__file__).resolve().parents[2] / "tests" / "matrix" / "arm64.sh"
HASHES = Path(__file__).with_name("output_hashes.py")
# Names of glibc before and after 2.33; names that it does not know, it ignores.
WITHOUT_FMA = "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-FMA4_Usable,-AVX2,-FMA,-FMA4"


def is_for_arm64(module: str) -> bool:
    return "-aarch64-" in Path(module).name


def hashes(module: str, tunables: str, words: list[str]) -> dict[str, str]:
    """The hash of each job; one that differs by threads has another name."""
    python = ARM64 if is_for_arm64(module) else sys.executable
    out = subprocess.run(
        [python, HASHES, module, *words],
        env={**os.environ, "GLIBC_TUNABLES": tunables},
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    return {name: digest for digest, name in (line.split("  ", 1) for line in out.splitlines())}


def arcsines(tunables: str) -> str:
    """A hash of arcsines of the C library: the tunables must change it, or they prove nothing."""
    script = "import math; print(hash(tuple(math.asin(i / 1e4) for i in range(10_000))))"
    environment = {**os.environ, "GLIBC_TUNABLES": tunables}
    return subprocess.check_output([sys.executable, "-c", script], env=environment, text=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("modules", nargs="+")
    parser.add_argument("--only", nargs="*", default=[], metavar="WORD")
    wanted = parser.parse_args()
    if arcsines("") == arcsines(WITHOUT_FMA):
        sys.exit(
            "Expected a C library that has other arcsines without FMA, found the same; use another machine"
        )
    first, bad = None, 0
    for module in wanted.modules:
        ways = (("FMA", ""), ("no FMA", WITHOUT_FMA))
        for name, tunables in ways[:1] if is_for_arm64(module) else ways:
            found = hashes(module, tunables, wanted.only)
            first = first or found
            other = [job for job in first.keys() | found.keys() if first.get(job) != found.get(job)]
            threads = [job for job in found if job.endswith("DIFFERS BY THREADS")]
            bad += sum(not job.endswith(": wrap") for job in other) + len(threads)
            print(
                f"{module}, {name}: {len(found)} jobs, {len(other)} differ from the first",
                flush=True,
            )
            print("".join(f"    {job}\n" for job in sorted({*other, *threads})), end="")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
