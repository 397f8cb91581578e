# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis of each connected part of a mesh, as if the others were not there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import DegenerateInputError
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.mesh_parts import split
from ..settings import Settings
from ..shape.shape import Shape
from .compute import Computation, compute_axis


@dataclass(frozen=True, eq=False)
class EachPart:
    """The medial axes of the connected parts of a mesh.

    Parameters
    ----------
    computations : tuple of Computation
    numbers : tuple of int
        The number of the part of each computation, from 1, in the order of the first faces of all parts.
    warnings : tuple of str
        A sentence about parts that were left out because they have no thickness, and about parts without an axis.
    """

    computations: tuple[Computation, ...]
    numbers: tuple[int, ...]
    warnings: tuple[str, ...]


def compute_each_part(
    shape: Shape,
    settings: Settings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> EachPart:
    """Compute the medial axis of each connected part of a shape that has thickness."""
    found, progress = split(shape, settings), progress or Progress()
    computed, failed, many = {}, [], len(found.parts)
    for done, part in enumerate(found.parts):
        progress.begin_section(done / many, (done + 1) / many)
        try:
            computed[part.number] = compute_axis(part.shape, settings, progress, limit)
        except DegenerateInputError as error:
            failed.append(error)
    if not computed:
        raise failed[0]
    warnings = (*found.warnings, *without_axis(failed, found.count))
    return EachPart(tuple(computed.values()), tuple(computed), warnings)


def without_axis(errors: Sequence[Exception], count: int) -> tuple[str, ...]:
    """A sentence about parts, among so many, that have no axis because of errors."""
    if not errors:
        return ()
    return (f"{len(errors):,} of {count:,} connected parts have no medial axis: {errors[0]}",)
