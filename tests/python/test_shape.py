# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of the input that are measured from its faces."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.settings import SamplingMode, Settings
from medial_axis.core.shape.shape import Shape
from support.meshes import box


@pytest.mark.parametrize("away", [0.0, 2.0**20])
def test_volume_and_area_do_not_depend_on_the_place(away):
    points, triangles = box((4, 3, 2))
    size = np.ptp(points, axis=0)
    shape = Shape(points + away, triangles)
    assert shape.volume == pytest.approx(size.prod(), rel=1e-6)
    assert shape.area == pytest.approx(2 * (size.prod() / size).sum(), rel=1e-6)
    assert Shape(points + away, triangles[:, ::-1]).volume == pytest.approx(-size.prod(), rel=1e-6)


def test_a_computation_counts_open_edges_once(medial, monkeypatch):
    counted, count = [], medial.open_edges
    monkeypatch.setattr(medial, "open_edges", lambda *faces: counted.append(1) or count(*faces))
    compute(*box(), Settings(sampling=SamplingMode.SURFACE, samples=500))
    assert len(counted) == 1
