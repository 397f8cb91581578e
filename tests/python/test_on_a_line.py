# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets whose vertices lie on one line, though more than two: symmetric samples have them; they have no area."""

import numpy as np
import pytest
from support import meshes


@pytest.mark.parametrize("count", [1000, 4000, 16000])
def test_no_facet_of_a_symmetric_sample_is_a_line(medial, count):
    """Rows that mirror each other in three edges meet at the corners of a cube, about its diagonals."""
    cube = meshes.box((1, 1, 1), (1.0, 1.0, 1.0))
    samples = medial.sample_surface(*cube, count=count)
    analysis = medial.MedialAnalysis(samples.points, cube[1], vertices=cube[0])
    mesh = analysis.extract(side=medial.Side.INNER)
    corners = np.split(mesh.face_vertices, mesh.face_offsets[1:-1])
    assert min(_width(mesh.vertices[face]) for face in corners) > 1e-9
    assert len({tuple(sorted(face)) for face in corners}) == len(corners)
    assert mesh.zero_area > 0


def _width(polygon):
    """Smaller extent of a polygon in its plane, as a share of the larger."""
    spread = np.linalg.svd(polygon - polygon.mean(axis=0), compute_uv=False)
    return spread[1] / spread[0]
