# SPDX-License-Identifier: GPL-3.0-or-later
"""Files appear whole or not at all: they are written next to their target, then renamed to it."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from ..errors import ExportError


def write_whole(path: str | os.PathLike, write: Callable[[BinaryIO], object]) -> Path:
    """Write a file.

    Parameters
    ----------
    path : path of the file; a link is followed
    write : callable
        It writes the content to the given binary stream.

    Returns
    -------
    path : Path
        The path with links resolved.

    Raises
    ------
    ExportError
        The system refused to write; an old file is then unchanged.
    """
    target = Path(os.path.realpath(path))
    temporary = target.parent / f".medial_axis_{secrets.token_hex(8)}.tmp"
    try:
        if target.exists() and not target.is_file():
            raise ExportError(
                f"Expected the name of a file, found '{path}', which is not one; choose another name"
            )
        try:
            with open(temporary, "xb") as stream:
                write(stream)
                stream.flush()
                os.fsync(stream.fileno())
            os.replace(temporary, target)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except ExportError:
        raise
    except OSError as error:
        raise ExportError(
            f"Expected to write '{path}', but the system says '{error.strerror or error}'; "
            "choose another folder or free some space (no file was changed)"
        ) from error
    return target
