# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks, kind after kind, for so many seconds: `python3 -m lab.breaking SECONDS [SEED [KIND ...]]`.

A batch of trials runs in a process of its own, so that a crash, too, is an outcome and not the end. Prints what broke,
with the seed of its trial, and at the end, or when it is stopped, a table for the docs.
"""

import itertools
import os
import resource
import signal
import subprocess
import sys
import time
import traceback
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parents[2]
if str(ROOT) not in sys.path:
    sys.path.insert(0, str(ROOT))

BATCH_SECONDS = 20.0  # after which a batch begins no other trial
LIMIT_SECONDS = 300.0  # after which it has hung


def main(seconds: float, seed: int, kinds: list[str]) -> int:
    from lab.breaking.kinds import KINDS

    begun = time.monotonic()
    tried, broke, spent = Counter(), Counter(), Counter()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        for number in itertools.count():
            for kind in kinds or KINDS:
                if time.monotonic() > begun + seconds:
                    return _table(tried, broke, spent, begun)
                before = _processor_time()
                said = _batch(kind, seed + number)
                spent[kind] += _processor_time() - before
                tried[kind] += said.count("\ntried ")
                faults = [line for line in said.splitlines() if line.startswith("BROKE ")]
                broke[kind] += len(faults)
                for line in faults:
                    print(line, flush=True)
    except KeyboardInterrupt:
        pass
    return _table(tried, broke, spent, begun)


def _processor_time() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _batch(kind: str, seed: int) -> str:
    """Runs a batch and returns its output. Its temporary files are deleted, however it ends."""
    command = [sys.executable, "-m", "lab.breaking", "--batch", kind, str(seed)]
    with TemporaryDirectory(prefix="breaking_", ignore_cleanup_errors=True) as folder:
        process = subprocess.Popen(
            command,
            cwd=ROOT,
            env={**os.environ, "TMPDIR": folder},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        try:
            out, err = process.communicate(timeout=LIMIT_SECONDS)
        except subprocess.TimeoutExpired:
            _kill(process)
            out, _ = process.communicate()
            return f"{out}\nBROKE {kind} {seed}: no end in {LIMIT_SECONDS:g} s"
        finally:
            _kill(process)
    if process.returncode != 0:
        last = out.splitlines()[-1:] + err.splitlines()[-3:]
        return f"{out}\nBROKE {kind} {seed}: exit code {process.returncode}: {last}"
    return out


def _kill(process: subprocess.Popen) -> None:
    """Kills the process and all that it has started, because those would hold its pipes and its folder."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        return
    process.wait()


def batch(kind: str, seed: int) -> None:
    """Trials of one kind, each with a seed of its own."""
    from lab.breaking.kinds import KINDS, numbered

    end = time.monotonic() + BATCH_SECONDS
    print()
    for trial in itertools.count():
        with TemporaryDirectory(prefix="breaking_") as folder:
            print(f"tried {kind} {seed} {trial}", flush=True)
            try:
                KINDS[kind](numbered(kind, seed, trial), Path(folder))
            except Exception as error:
                at = traceback.extract_tb(error.__traceback__)[-1]
                words = " ".join(str(error).split())[:300]
                where = f"{Path(at.filename).name}:{at.lineno}"
                print(f"BROKE {kind} {seed} {trial}: {type(error).__name__} {where} {words}")
        if time.monotonic() > end:
            return


def _table(tried: Counter, broke: Counter, spent: Counter, begun: float) -> int:
    print("| kind | tried | broke | processor time |\n|---|---|---|---|")
    for kind in tried:
        print(f"| {kind} | {tried[kind]:,} | {broke[kind]:,} | {spent[kind]:,.0f} s |")
    print(f"| all | {tried.total():,} | {broke.total():,} | {spent.total():,.0f} s |")
    print(f"by the clock: {time.monotonic() - begun:,.0f} s")
    return min(1, broke.total())


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if sys.argv[1:2] == ["--batch"]:
        batch(sys.argv[2], int(sys.argv[3]))
    else:
        words = [*sys.argv[1:], "60", "1"][: max(2, len(sys.argv) - 1)]
        sys.exit(main(float(words[0]), int(words[1]) if len(sys.argv) > 2 else 1, words[2:]))
