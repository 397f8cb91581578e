# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files are bytes: Python keeps bytes that are not text as surrogates, which no encoding can write."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TextIO

LONGEST = 255  # a name may have at most this many bytes in the usual file systems


def shown(text: str, stream: TextIO | None = None) -> str:
    """Return the text with backslash escapes for characters that the stream, or else UTF-8, cannot encode."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    return text.encode(encoding, "backslashreplace").decode(encoding)


def is_folder(path: str | os.PathLike) -> bool:
    """Return whether there is a folder; if the system reports an error it is False, and writing reports the error."""
    try:
        return Path(path).is_dir()
    except (OSError, ValueError):
        return False


def bytes_of(name: str) -> int:
    """Return the length of a name in bytes, as the file system counts it."""
    return len(os.fsencode(name))
