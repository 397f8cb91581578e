#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Varies each geometric constant by 30 % and writes which product shows it first: docs/lab/constants.csv.

    python3 lab/benchmarks/vary_constants.py /tmp/vary build          a copy whose constants can be set
    python3 lab/benchmarks/vary_constants.py /tmp/vary time           the seconds of each job
    python3 lab/benchmarks/vary_constants.py /tmp/vary run docs/lab/constants.csv [first job]

Constants that change nothing are cleared in groups: a job is run with half of the group at 0.7 and half at 1.3 times
their values, and only a group that changes the result is divided. The second round swaps the factors. A number within
0.1 of 1 or -1 is a tolerance: its difference from there is varied.
"""

import contextlib
import csv
import hashlib
import importlib
import io
import math
import os
import pkgutil
import re
import select
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from support import plates, rounded, thin_solids  # noqa: E402 - found through the line above
from support.constants import CPP, DECLARED, geometric  # noqa: E402
from support.data import DATA  # noqa: E402

from lab.benchmarks.output_hashes import ellipsoid, torus  # noqa: E402
from lab.benchmarks.product_hashes import hash_of, off, shapes  # noqa: E402

FACTORS = (0.7, 1.3)
JOBS = """
axis angle.off npz --samples 700
axis spot_low.obj npz --samples 700
midsurface angle.off obj --samples 600
skeleton spot_low.obj json --samples 800
thickness angle.off csv --samples 600 --limit 0.3
balls angle.off ma --count 6 --samples 400
rig spot_low.obj - --samples 1000
axis ring.off npz --samples 700 --simplify 3 --erode 2 --spike 2
axis angle.off npz --samples 700 --vertices 40
axis spot_low.obj npz --samples 800 --form curve --detail 0.5
hollow box.off stl --wall 0.3 --voxel-size 0.15
thickness rounded.off csv --samples 600 --limit 0.3
thicken plate.off stl --samples 600 --limit 0.3
midsurface tee.off obj --samples 600 --keep-thick
axis bracket.off npz --samples 900
axis rounded.off npz --samples 900
midsurface rounded.off obj --samples 600
skeleton cup.off json --samples 600 --fill outside
thickness pipe.off csv --samples 600 --limit 0.3
balls spot_low.obj json --count 6 --samples 400 --refine
axis voxels.off npz --samples 900
axis two_boxes_open.off npz --samples 700
axis tetra_cavity_0.45.off npz --samples 600
axis slanted_plate_70.off npz --samples 600 --mesh voronoi
axis hinge_06.off npz --samples 700 --sampling adaptive --budget 2000
axis pipe.off npz --samples 700 --pairs
axis torus.xyz npz --sides poles
axis open_tube.off npz --samples 700
axis cup.off npz --samples 600 --sides wrap --wrap-opening 8 --side outer
thickness pipe.off csv --gap --samples 600 --limit 0.3
thicken cup.off stl --samples 600 --limit 0.3 --subdivide
midsurface angle.off inp --samples 500 --size 0.6 --quads
skeleton ring.off csv --samples 600 --mirror
skeleton spot_low.obj json --samples 800 --mirror --simplify 0.02
balls angle.off json --count 6 --samples 500 --mode around
balls spot_low.obj json --shapes capsules --count 2 --samples 400
balls box.off json --shapes tapered --count 2 --samples 300
axis noisy.xyz npz
thickness noisy.xyz csv --noise scan
"""
TUNED = """#include <cstdlib>
#include <cstring>
inline double medial_tuned(const char* key, double value) {
  const size_t n = std::strlen(key);
  for (const char* at = std::getenv("MEDIAL_TUNE"); at; at = std::strchr(at, ';')) {
    if (*at == ';') ++at;
    if (std::strncmp(at, key, n) != 0 || at[n] != '=') continue;
    const double factor = std::atof(at + n + 1), one = value < 0 ? -1 : 1, off = value - one;
    return off != 0 && off > -0.1 && off < 0.1 ? one + factor * off : factor * value;
  }
  return value;
}
"""
# Tables that the core has constexpr, with constants in them.
TABLES = re.compile(r"\bconstexpr (Bar|Vec3)\b")


def build(tree: Path) -> None:
    """Write and compile a copy in which MEDIAL_TUNE="file:name=factor;..." sets constants of the core."""
    for name in ("native", "blender_addon"):
        ignored = shutil.ignore_patterns("__pycache__", "*.so")
        shutil.copytree(ROOT / name, tree / name, ignore=ignored)
    shutil.copy(ROOT / "CMakeLists.txt", tree)
    (tree / "tuned.h").write_text(TUNED)
    (tree / "constants.txt").write_text("\n".join(c.key for c in geometric()), encoding="utf-8")
    for path in (tree / "native" / "medial").rglob("*.*"):
        file = path.relative_to(tree).as_posix()
        text = path.read_text(encoding="utf-8")
        path.write_text(
            CPP.sub(lambda found, file=file: _variable(found, file), TABLES.sub(r"const \1", text))
        )
    flags = [f"-DCMAKE_CXX_FLAGS=-include {tree}/tuned.h", "-DMEDIAL_TESTS=OFF", "-GNinja"]
    flags += ["-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON"]
    subprocess.run(["cmake", "-S", tree, "-B", tree / "build", *flags], check=True)
    subprocess.run(
        ["nice", "-n15", "ninja", "-C", tree / "build", "-j1", "-k0", "_medial"], check=True
    )
    (tree / "blender_addon" / "lib").mkdir(exist_ok=True)
    for path in (tree / "build").glob("_medial*.so"):
        shutil.copy(path, tree / "blender_addon" / "lib")


def _variable(found: re.Match[str], file: str) -> str:
    def value(one: re.Match[str]) -> str:
        has_digit = re.search(r"\d", one[2])
        return f'{one[1]} = medial_tuned("{file}:{one[1]}", {one[2]})' if has_digit else one[0]

    of_class = found["indent"] and "static" in found[0].partition("constexpr")[0]
    before = f"{found['indent']}static {'inline ' if of_class else ''}const {found['type']} "
    return f"{before}{DECLARED.sub(value, found['rest'])};{found['tail']}"


def write_inputs(folder: Path) -> None:
    meshes = {
        "bracket": plates.bracket(),
        "tee": plates.t_plate(),
        "rounded": rounded.rounded_box((1.0, 0.7, 0.12), 0.1, 3),
        "voxels": thin_solids.stairs(0.2).mesh,
    }
    texts = shapes() | {name: off(*mesh) for name, mesh in meshes.items()}
    for name, text in texts.items():
        (folder / f"{name}.off").write_text(text, encoding="ascii")
    np.savetxt(folder / "noisy.xyz", ellipsoid(600, 0.015))
    np.savetxt(folder / "torus.xyz", torus(1200))
    for name in {job.split()[1] for job in JOBS.strip().splitlines()}:
        for path in (DATA / name, DATA / "cases" / name):
            if path.exists():
                shutil.copy(path, folder)


def load(tree: Path):
    """Import all modules but the compiled one, so that each run has it to load."""
    sys.path.insert(0, str(tree))
    for room in ("core", "commands"):
        package = importlib.import_module(f"blender_addon.{room}")
        for found in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
            importlib.import_module(found.name)
    return importlib.import_module("blender_addon.cli")


def set_constants(wanted: dict[str, float]) -> None:
    os.environ["MEDIAL_TUNE"] = ";".join(f"{key}={factor}" for key, factor in wanted.items())
    modules = [m for n, m in sys.modules.items() if n.startswith("blender_addon")]
    for key, factor in wanted.items():
        file, name = key.split(":")
        if file.endswith(".py"):
            old = getattr(sys.modules[file[:-3].replace("/", ".")], name)
            one = math.copysign(1, old)
            new = one + factor * (old - one) if 0 < abs(old - one) < 0.1 else factor * old
            for module in modules:
                if vars(module).get(name) is old:
                    setattr(module, name, new)


def rig(source: Path, options: list[str]) -> bytes:
    from blender_addon.core.files.read_shape import read_shape
    from blender_addon.core.rig.rig import compute_rig
    from blender_addon.core.settings import Settings, SkeletonSettings

    found = compute_rig(
        read_shape(source)[0], Settings(samples=int(options[1])), SkeletonSettings()
    )
    return repr(
        (found.names, found.limbs, found.bones.tail.tolist(), found.weight.tolist())
    ).encode()


def product(cli, folder: Path, job: str) -> bytes:
    """The hash of all that a job writes, or of how it fails."""
    name, source, extension, *options = job.split()
    digest = hashlib.sha256()
    out = folder / f"out{os.getpid()}"
    out.mkdir()
    try:
        if name == "rig":
            digest.update(rig(folder / source, options))
        else:
            words = [str(folder / source), str(out / f"out.{extension}"), "--quiet", *options]
            digest.update(b"%d" % cli.main(words if name == "axis" else [name, *words]))
            for path in sorted(out.iterdir()):
                digest.update(hash_of(path).encode())
    except Exception as error:  # whatever a strange value does
        digest.update(type(error).__name__.encode())
    finally:
        shutil.rmtree(out)
    return digest.digest()


def run(cli, folder: Path, job: str, wanted: dict[str, float], seconds: float) -> bytes:
    """The hash of a job with these factors, in a process of its own; nothing where it crashes or takes too long."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            try:
                signal.alarm(int(seconds) + 1)  # also where the parent has ended
                set_constants(wanted)
                os.write(write, product(cli, folder, job))
            finally:
                os._exit(0)
    os.close(write)
    if not select.select([read], [], [], seconds)[0]:
        os.kill(child, signal.SIGKILL)
    found = os.read(read, 64)
    os.close(read)
    os.waitpid(child, 0)
    return found


def changing(keys: list[str], factor: dict[str, float], differs) -> list[str]:
    """Return the `keys` that change a result by themselves, by dividing groups that do."""
    if not keys or not differs({key: factor[key] for key in keys}):
        return []
    if len(keys) == 1:
        return keys
    half = len(keys) // 2
    return changing(keys[:half], factor, differs) + changing(keys[half:], factor, differs)


def label(job: str) -> str:
    name, source, _, *options = job.split()
    kinds = [o[2:] for o in options if o.startswith("--") and o not in ("--samples", "--limit")]
    return " ".join([name, Path(source).stem, *kinds])


def sweep(cli, tree: Path, folder: Path, table: Path, first: int) -> None:
    keys = (tree / "constants.txt").read_text(encoding="utf-8").split()
    rows = {key: ["", ""] for key in keys}
    if table.exists():  # of a sweep that was ended
        with table.open(encoding="utf-8", newline="") as file:
            known = {f"{a}:{b}": seen for a, b, *seen in csv.reader(file)}
        rows = {key: known.get(key, ["", ""]) for key in keys}
    for swap in (0, 1):
        factor = {key: FACTORS[(i + swap) % 2] for i, key in enumerate(keys)}
        for job in JOBS.strip().splitlines()[0 if swap else first :]:
            start, runs = time.perf_counter(), 0
            want = run(cli, folder, job, {}, 600.0)
            most = 8 + 6 * (time.perf_counter() - start)

            def differs(wanted, job=job, want=want, most=most):
                nonlocal runs
                runs += 1
                return run(cli, folder, job, wanted, most) != want

            left = [k for k in keys if not rows[k][factor[k] > 1]]
            found = changing(left, factor, differs)
            for key in found:
                rows[key][factor[key] > 1] = label(job)
            took = time.perf_counter() - start
            print(
                f"{label(job)}: {len(found)} of {len(left)}, {runs} runs, {took:.0f} s", flush=True
            )
            with table.open("w", encoding="utf-8", newline="") as file:
                write = csv.writer(file, lineterminator="\n")
                write.writerow(["file", "constant", "at 0.7 seen in", "at 1.3 seen in"])
                write.writerows([*key.split(":"), *row] for key, row in rows.items())


def main() -> None:
    work, what, *rest = Path(sys.argv[1]), *sys.argv[2:]
    work.mkdir(exist_ok=True)
    if what == "build":
        return build(work / "tree")
    folder = work / "inputs"
    folder.mkdir(exist_ok=True)
    write_inputs(folder)
    cli = load(work / "tree")
    if what == "run":
        return sweep(cli, work / "tree", folder, Path(rest[0]), int(rest[1]) if rest[1:] else 0)
    for job in JOBS.strip().splitlines():
        start = time.perf_counter()
        found = [run(cli, folder, job, {}, 600.0).hex()[:8] for _ in range(2)]
        print(f"{(time.perf_counter() - start) / 2:.2f} s {found} {job}", flush=True)
    return None


if __name__ == "__main__":
    main()
