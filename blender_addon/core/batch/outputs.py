# SPDX-License-Identifier: GPL-3.0-or-later
"""No output of a run replaces an input or another output.

Files are the same if the system says so (links included) or if their paths are, because an output need not exist yet.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path

from ..errors import InvalidInputError
from .batch import report_path


class Files:
    """Records the files that a run reads and writes; `beside` returns what is written next to an output."""

    def __init__(
        self,
        inputs: Iterable[str] = (),
        beside: Callable[[Path], tuple[Path, ...]] = lambda _output: (),
    ) -> None:
        self._beside = beside
        self._read: dict[object, Path] = {
            key: path for path in map(Path, inputs) for key in _identities(path)
        }
        self._written: dict[object, Path] = {}

    def check_not_read(self, output: Path) -> None:
        """Check that neither an output nor a file that is written next to it is an input."""
        for path in self._written_with(output):
            if (found := _same_file(path, self._read)) is not None:
                raise InvalidInputError(
                    f"Expected an output that replaces no input, found '{path}', which is the input "
                    f"'{found}'; choose another folder or name"
                )

    def claim(self, output: Path) -> None:
        """Check an output and the files next to it, and reserve their paths for this run."""
        self.check_not_read(output)
        for path in self._written_with(output):
            if _same_file(path, self._written) is not None:
                raise InvalidInputError(
                    f"Expected another output for each input, found '{output}' again; put {{file}} "
                    "or {name} in OUTPUT"
                )
        for path in self._written_with(output):
            self._written |= dict.fromkeys(_identities(path), path)

    def _written_with(self, output: Path) -> tuple[Path, ...]:
        return output, report_path(output), *self._beside(output)


def _same_file(path: Path, recorded: dict[object, Path]) -> Path | None:
    """Return the recorded path of the same file.

    An inode counts only if both paths still have it: that of a file which was replaced since, by this
    run or by another one in the same folder, is given to the next new file.
    """
    for key in _identities(path):
        other = recorded.get(key)
        if other is not None and (isinstance(key, str) or key in _identities(other)):
            return other
    return None


def _identities(path: Path) -> set[object]:
    """Return the path with links resolved and, if the file exists, its device and inode."""
    found: set[object] = {os.path.normcase(os.path.realpath(path))}
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return found
    return found | {(status.st_dev, status.st_ino)}
