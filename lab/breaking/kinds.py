# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of trials by name; each takes a random generator and an empty folder, and raises where something broke."""

import zlib

import numpy as np

from . import inside, memory, outside, written

KINDS = {
    "files: tokens, pieces, other extensions": inside.files,
    "degenerate meshes, odd settings": inside.meshes,
    "points, threads 1, 2, 64": inside.points,
    "not finite, wrong types and shapes": inside.wrong_arguments,
    "settings out of range": inside.settings_out_of_range,
    "command line out of range": inside.words_out_of_range,
    "cancelled at any instant": inside.cancelled,
    "killed while writing, then resumed": outside.killed,
    "closed pipes": outside.closed_pipes,
    "names of any bytes": outside.odd_names,
    "four at once in one folder": outside.at_once,
    "batches with bad items": outside.bad_items,
    "axes written and read again": written.axes,
    "skeletons written and read again": written.skeletons,
    "balls written and read again": written.balls,
    "full disks": written.full_disks,
    "memory told and taken": memory.told,
    "few threads, every command": memory.few_threads,
}


def numbered(kind: str, seed: int, trial: int) -> np.random.Generator:
    return np.random.default_rng([zlib.crc32(kind.encode()), seed, trial])
