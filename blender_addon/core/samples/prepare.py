# SPDX-License-Identifier: GPL-3.0-or-later
"""Facts about a shape before samples of it are taken: how its faces are read, and which of them count."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..settings import Settings, SidesFrom
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from ..shape.solid_faces import sharp_angle_of
from ..shape.wrapped_faces import without_wrap, wrap_reason, wrapped_shape
from .mesh_parts import without_sheets
from .sample_spacing import Amount, first_pass
from .scan import Scan, prepared


@dataclass(frozen=True, eq=False)
class Input:
    """A shape to analyse, how to analyse it, and what was done to it."""

    # With faces that look outward; before sheets were left out, or before it was wrapped
    given: Shape
    read: Shape  # Without sheets, or wrapped; before points were moved or left out
    shape: Shape  # The one that is analysed
    settings: Settings  # `side` is not AUTOMATIC, and a wrap is a closed surface
    # The measures of points without faces, and what was done to them; None where there are faces
    scan: Scan | None = None
    wrap: str = ""  # The reason for what is inside of a wrap; or empty
    # A sentence that explains why there are fewer samples than the settings ask for; or empty
    thinned: str = ""

    @property
    def sharp(self) -> float:
        """The angle from which edges are sharp."""
        return sharp_angle_of(self.shape, self.settings)

    @cached_property
    def first(self) -> Amount:
        """The amount of a first pass over the faces, which there have to be."""
        return first_pass(self.shape, self.settings)

    @property
    def by_open_faces(self) -> bool:
        """Whether open faces decide what is inside, unless they are a sheet: no other source was chosen or given."""
        normals, wanted = self.shape.normals, self.settings.sides
        is_given = normals is not None and bool(normals.any())
        return wanted is SidesFrom.AUTOMATIC and self.shape.open_edges > 0 and not is_given


def prepare(shape: Shape, settings: Settings, progress: Any) -> Input:
    """Read a shape: wrap it, turn its faces outward and leave out sheets, or smooth points without faces.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : _medial.Progress
    """
    if settings.sides is SidesFrom.WRAP:
        wrap = wrapped_shape(shape, settings, progress)
        return Input(shape, wrap, wrap, without_wrap(settings), wrap=wrap_reason(wrap, settings))
    if not len(shape.triangles):
        smooth, scan = prepared(shape, settings, progress)
        return Input(shape, shape, smooth, settings, scan=scan)
    given = outward_shape(shape)
    read = without_sheets(given, settings)
    return Input(given, read, read, settings)
