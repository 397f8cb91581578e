# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles in the form of faces that Blender and the file formats use."""

from __future__ import annotations

import numpy as np

from ..arrays import Ints


class TriangleFaces:
    """Gives a class that has `triangles`, (f, 3) int32, the same arrays of faces as a `MedialAxis`."""

    triangles: Ints

    @property
    def face_offsets(self) -> Ints:
        """(f + 1,) int32, as `MedialAxis.face_offsets`."""
        return np.arange(0, self.triangles.size + 1, 3, dtype=np.int32)

    @property
    def face_vertices(self) -> Ints:
        """(3 f,) int32, as `MedialAxis.face_vertices`."""
        return self.triangles.ravel()
