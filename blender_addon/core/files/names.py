# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files, which are bytes: Python holds what is no text in surrogates, which no encoding can write."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TextIO

LONGEST = 255  # bytes that a name may have in the usual file systems


def shown(text: str, stream: TextIO | None = None) -> str:
    """The text as a stream can show it, with backslashes for what it cannot; without a stream as UTF-8 can."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    return text.encode(encoding, "backslashreplace").decode(encoding)


def is_folder(path: str | os.PathLike) -> bool:
    """Whether there is a folder, as far as the system says; where it says nothing, writing will tell why."""
    try:
        return Path(path).is_dir()
    except (OSError, ValueError):
        return False


def bytes_of(name: str) -> int:
    """The length of a name as the file system counts it."""
    return len(os.fsencode(name))
