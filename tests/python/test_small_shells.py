# SPDX-License-Identifier: GPL-3.0-or-later
"""Small shells have enough samples, and what the faces know of the topology is compared with every result."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.axis.solid_warnings import solid_warnings
from medial_axis.core.cover.ball_cover import cover_by_balls
from medial_axis.core.settings import (
    BallSettings,
    SamplingMode,
    Settings,
    Side,
    SidesFrom,
    SkeletonSettings,
    ThicknessSettings,
)
from medial_axis.core.skeleton.compute import compute_skeleton
from medial_axis.core.thickness.face_lengths import MeasuredFaces
from medial_axis.core.thickness.thickness import measure_thickness
from support import meshes
from support.meshes import shape_of
from support.thick_meshes import block

TETRAHEDRON = np.array([[0.0, 0, 0], [1, 0, 0], [0.2, 0.9, 0], [0.5, 0.3, 0.8]])
INWARD = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])


def with_cavities(size, count=1, edge=10):
    """A cube with cavities along a line through its middle."""
    places = [(x, 0.1, 0.2) for x in np.arange(count) - 0.5 * (count - 1)]
    cavities = ((size * TETRAHEDRON + place, INWARD) for place in places)
    return meshes.join(block(edge, edge, edge), *cavities)


# Two boxes that share an edge, so that no count of the faces is that of a solid.
AT_AN_EDGE = meshes.join(block(2, 2, 2, (11, 0, 0)), block(2, 2, 2, (13, 2, 0)))
SEVEN_CAVITIES = meshes.join(with_cavities(0.1, 7), AT_AN_EDGE)


@pytest.mark.parametrize("size", [0.4, 0.04, 0.01])
@pytest.mark.parametrize("seed", range(2))
def test_a_small_cavity_is_not_lost(size, seed):
    found = compute_axis(shape_of(with_cavities(size)), Settings(seed=seed))
    assert found.axis.level.betti == (1, 0, 1) and found.topology.endswith("as the solid")


def test_a_cavity_that_no_sample_reaches_is_told():
    found = compute_axis(shape_of(with_cavities(0.002)), Settings())
    assert found.axis.level.betti == (1, 0, 1) or any("as the faces" in w for w in found.warnings)


@pytest.mark.parametrize("size", [1e7, 1e9, 1e37])
def test_a_shell_too_small_for_the_sampler_takes_no_samples(size):
    settings = Settings(sampling=SamplingMode.SURFACE, samples=300)
    found, alone = (
        len(compute_axis(shape_of(mesh), settings).chosen.samples.points)
        for mesh in (with_cavities(1.0, edge=size), block(size, size, size))
    )
    assert found <= alone


def test_cavities_beside_an_edge_of_four_faces():
    found = compute_axis(shape_of(SEVEN_CAVITIES), Settings())
    assert found.chosen.samples.by_faces is None and found.axis.level.betti[2] == 7


def said(mesh, betti):
    shape = shape_of(mesh)
    chosen = compute_axis(shape, Settings(samples=1000)).chosen
    return list(solid_warnings(shape, Side.INNER, SidesFrom.SURFACE, chosen, betti))


def test_another_topology_than_that_of_the_faces_is_told():
    box = block(1, 1, 1)
    assert said(box, (1, 0, 0)) == said(box, None) == []
    (sentence,) = said(box, (1, 1, 0))
    assert "not as many pieces, loops and cavities as the faces" in sentence


def test_more_pieces_than_parts_and_fewer_cavities_than_inward_shells_are_told():
    assert said(SEVEN_CAVITIES, (3, 0, 7)) == []
    (sentence,) = said(SEVEN_CAVITIES, (3, 0, 6))
    assert "6 cavities, and 7 parts of the faces look inward" in sentence
    open_box = (block(1, 1, 1)[0], block(1, 1, 1)[1][1:])
    assert any("40 pieces, and the faces have 1" in text for text in said(open_box, (40, 0, 0)))


@pytest.mark.parametrize(
    "mesh",
    [
        (block(1, 1, 4)[0], block(1, 1, 4)[1][1:]),
        block(1.0, 0.5, 0.005),
        meshes.join(block(1, 1, 4), block(1, 1, 4, (0.5, 0.2, 0.1))),
    ],
    ids=["open", "thinner than samples are apart", "parts that overlap"],
)
def test_other_results_give_the_warnings_of_the_axis(mesh):
    settings = Settings(samples=1000, crisp=False, sampling=SamplingMode.SURFACE)
    shape = shape_of(mesh)
    axis = set(compute_axis(shape, settings).warnings)
    assert axis <= set(compute_skeleton(shape, settings, SkeletonSettings()).warnings)
    assert axis <= set(cover_by_balls(shape, settings, BallSettings()).warnings)
    thickness = measure_thickness(shape, settings, ThicknessSettings())
    by_faces = isinstance(thickness.chosen, MeasuredFaces)  # no sample can be too far apart
    assert axis and (by_faces or axis <= set(thickness.warnings))
