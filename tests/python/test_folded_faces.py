# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that a fold hides get no samples in pairs; where loops stay, a warning names the place."""

from types import SimpleNamespace

import numpy as np
from medial_axis import library
from medial_axis.core.samples.doubts import worst_doubt
from medial_axis.core.shape.shape import Shape
from support import thin_solids


def test_neighbours_are_found_across_vertices_with_the_same_coordinates():
    points, triangles = thin_solids.plate(0.5).mesh
    shape = Shape(points[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    found = shape.neighbours
    assert np.array_equal(found, Shape(points, triangles).neighbours)
    assert (found >= 0).all()
    for face, row in enumerate(found):
        for corner, other in enumerate(row):
            ends = {triangles[face, corner], triangles[face, (corner + 1) % 3]}
            assert ends <= set(triangles[other])
    assert (Shape(points, triangles[1:]).neighbours < 0).sum() == 3


def test_faces_between_two_others_in_a_fold_are_hidden():
    points, triangles = thin_solids.turned(thin_solids.folded_plate(0.01).mesh)
    assert sorted(set(range(len(triangles))) - set(Shape(points, triangles).unfolded)) == [10, 11]
    inward = Shape(points, triangles[:, ::-1])
    assert np.array_equal(inward.unfolded, np.arange(len(triangles)))
    wedge = Shape(*thin_solids.wedge(2.0).mesh)
    assert np.array_equal(wedge.unfolded, np.arange(len(wedge.triangles)))


def test_a_fold_in_a_face_makes_no_loops():
    mesh = thin_solids.turned(thin_solids.folded_plate(0.01).mesh)
    found = library.compute(*mesh, side="inner", samples=3000)
    assert found.axis.level.betti == (1, 0, 0)
    assert found.topology.endswith("as the solid") and not found.warnings
    assert len(found.chosen.samples.points) < 3200


def test_the_worst_doubt_is_among_the_most_others_and_in_the_world():
    places = np.array([(5.0, 0, 0), (0.0, 0, 0), (0.1, 0, 0), (0.2, 0, 0)])
    samples = SimpleNamespace(points=np.zeros((1, 3)), apart=np.array([0.05]))
    frame = np.eye(4)
    frame[:3, 3] = 1, 2, 3
    shape = Shape(places, np.zeros((0, 3), np.int32), frame=frame)
    found = worst_doubt(shape, samples, places)
    assert found.place == (1.0, 2.0, 3.0) and found.apart == 0.05
    assert found.words == "(1, 2, 3)"
    assert worst_doubt(shape, samples, places[:0]) is None


def test_a_warning_names_the_place_where_loops_stay():
    """The budget allows one pass in pairs only, which is too coarse for the round wall."""
    points, triangles = thin_solids.cup(0.002, around=48).mesh
    found = library.compute(points, triangles, side="inner", samples=1000, budget=1200)
    assert found.axis.level.betti != (1, 0, 0) and found.chosen.differs
    (said,) = [some for some in found.warnings if "not as many pieces" in some]
    assert f"most of all near {found.chosen.worst.words}, where they are 0." in said
    low, high = points.min(axis=0), points.max(axis=0)
    assert ((found.chosen.worst.place >= low) & (found.chosen.worst.place <= high)).all()
    assert "overlap" not in found.topology
