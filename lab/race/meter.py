# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds and memory of a command: meter.py RESULT.json SECONDS WORD ...

A process of its own and without NumPy, for what a child inherits counts for its memory: this is 10 MB or so.
"""

import json
import os
import resource
import signal
import sys
import time


def main() -> None:
    result, limit, *command = sys.argv[1:]
    start = time.perf_counter()
    child = os.posix_spawnp(command[0], command, os.environ)
    signal.signal(signal.SIGALRM, lambda *_: os.kill(child, signal.SIGKILL))
    signal.alarm(int(limit))
    _, status = os.waitpid(child, 0)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(result, "w", encoding="utf-8") as file:
        json.dump(
            {
                "exit": os.waitstatus_to_exitcode(status),
                "cpu": used.ru_utime + used.ru_stime,
                "wall": time.perf_counter() - start,
                "bytes": used.ru_maxrss * 1024,
            },
            file,
        )


if __name__ == "__main__":
    main()
