# SPDX-License-Identifier: GPL-3.0-or-later
"""The noise of samples is measured as its definition says."""

import numpy as np
import pytest
from medial_axis.core.samples import noise
from support.meshes import icosphere


def test_roughness_is_that_of_a_plain_reading():
    """The height of a sample over the mean of its neighbours, less the mean of their heights, in mean distances."""
    points, triangles = icosphere(1)
    normals = points / np.linalg.norm(points, axis=1)[:, None]
    points = points + np.random.default_rng(0).normal(0.0, 0.05, points.shape)
    rings = [np.unique(triangles[(triangles == i).any(axis=1)]) for i in range(len(points))]
    rings = [ring[ring != i] for i, ring in enumerate(rings)]
    ways = [points[ring] - points[i] for i, ring in enumerate(rings)]
    height = np.array([way.mean(axis=0) @ normal for way, normal in zip(ways, normals)])
    length = [np.linalg.norm(way, axis=1).mean() for way in ways]
    off = [abs(height[i] - height[r].mean()) for i, r in enumerate(rings)]
    found = noise._roughness(points, triangles.astype(np.int32), normals)
    assert found == pytest.approx(np.median(np.divide(off, length)), rel=1e-12)
