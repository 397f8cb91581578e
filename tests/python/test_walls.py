# SPDX-License-Identifier: GPL-3.0-or-later
"""No axis is silently wrong: the faces reveal walls closer than the samples, which are refined and reported."""

import json
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.axis.compute import compute
from medial_axis.core.machine.memory_limit import WHAT_IS_FREE
from medial_axis.core.samples.analysed import Analysed
from medial_axis.core.samples.choose_samples import begin
from medial_axis.core.samples.decide import Effort
from medial_axis.core.samples.density import Density
from medial_axis.core.samples.next_amount import next_amount
from medial_axis.core.samples.walls import Walls
from medial_axis.core.settings import SamplingMode, Settings, Side
from support import meshes, thin_solids, topology
from support.measure import following
from support.meshes import shape_of
from support.plates import prism
from support.poses import random_turn
from support.thick_meshes import block, ellipsoid, lathe, pipe

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle

AREA = 1.0  # of the sheet of a plate
TURN = random_turn(3)


def plate(thickness, turned=False):
    vertices, triangles = meshes.box((1, 1, 1), (0.5, 0.5, thickness / 2))
    if turned:
        vertices = (vertices @ TURN.T).astype(np.float32).astype(np.float64)
    return vertices, triangles


def sheet_area(axis, turned=False):
    """The area of the facets, projected along the plate's normal."""
    where = axis.vertices @ TURN if turned else axis.vertices
    corners, after = where[axis.face_vertices], following(axis)
    doubled = corners[:, 0] * corners[after, 1] - corners[:, 1] * corners[after, 0]
    facet = np.repeat(np.arange(axis.facets), np.diff(axis.face_offsets))
    return np.abs(np.bincount(facet, doubled, axis.facets)).sum() / 2


def computed(mesh, sampling=SamplingMode.AUTOMATIC, **settings):
    settings = {"samples": 2000, "budget": 12_000, **settings}
    return compute(*mesh, Settings(sampling=sampling, **settings))


def said(found):
    return [text for text in found.warnings if "closer to each other" in text]


@pytest.mark.parametrize("turned", [False, True], ids=["straight", "turned, float32"])
@pytest.mark.parametrize("thickness", [0.02, 0.01, 0.005, 0.0015, 0.001, 0.0002, 0.00001])
@pytest.mark.parametrize("sampling", ["AUTOMATIC", "ADAPTIVE", "SURFACE"])
def test_what_is_missing_of_a_plate_is_said(sampling, thickness, turned):
    found = computed(plate(thickness, turned), SamplingMode[sampling])
    there = sheet_area(found.axis, turned) / AREA
    assert there + found.missed > 0.85
    assert said(found) or there > 0.85
    if there < 0.5:
        assert found.missed > 0.8


@pytest.mark.parametrize("sampling", [SamplingMode.AUTOMATIC, SamplingMode.ADAPTIVE])
def test_close_walls_are_refined_within_the_budget(sampling):
    """2,000 samples are 0.034 apart, 20,000 are 0.011."""
    hows = SamplingMode.SURFACE, sampling
    even, fine = (computed(plate(0.015), how, budget=20_000) for how in hows)
    assert said(even) and sheet_area(even.axis) < 0.3
    assert fine.missed < 0.05 and sheet_area(fine.axis) > 0.85
    assert fine.points < 21_000


def test_no_samples_are_spent_on_walls_that_stay_too_close():
    found = computed(plate(0.0002))
    assert found.points < 2_500 and found.missed == 0.0  # pairs see the sheet


@pytest.mark.parametrize("seed", repeats(4))
def test_fuzzed_plates(seed):
    random = np.random.default_rng([seed, 1])
    thickness, samples = 10.0 ** random.uniform(-6, -1.5), int(random.integers(500, 3000))
    sampling = list(SamplingMode)[random.integers(2, len(SamplingMode))]
    found = computed(plate(thickness), sampling, samples=samples, budget=4 * samples)
    there = sheet_area(found.axis) / AREA
    assert there + found.missed > 0.85, (thickness, samples, sampling)
    assert said(found) or there > 0.85


@pytest.mark.parametrize("thickness", [3e-5, 1e-5, 1e-6])
def test_a_sheet_of_some_thickness_is_not_taken_for_one_without(thickness):
    """The samples are 0.034 apart; one looks 3.4e-5 off the surface for its two sides."""
    found = computed(plate(thickness), SamplingMode.SURFACE)
    (text,) = said(found)
    assert f"about {thickness:.2g}," in text and found.missed > 0.95
    assert found.chosen.samples.buried == 0


def test_sheets_without_thickness_bound_nothing():
    """A sheet that is there twice, and rotated, next to a block."""
    sheet = np.array([(1, 1, 0), (2, 1, 0), (2, 2, 0), (1, 2, 0)], float)
    twice = np.array([(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)], np.int32)
    found = computed(meshes.join((sheet, twice), meshes.box((1, 1, 1), (0.3, 0.3, 0.3))))
    assert found.chosen.samples.points.max() < 0.5 and not said(found)
    assert sum("were left out" in text for text in found.warnings) == 2


def test_close_walls_of_overlapping_parts_are_said_but_not_refined():
    """The closest walls of overlapping parts are slivers between them."""
    both = meshes.join(plate(0.015), block(0.4, 0.4, 0.4, (0.41, 0.41, 0.0)))
    found = computed(both, budget=20_000)
    assert found.chosen.samples.buried > 0
    assert said(found) and found.points < 5_000


def test_dense_vertices_of_a_thin_plate_are_not_trusted():
    mesh = meshes.box((20, 20, 1), (0.5, 0.5, 0.0075))
    found = computed(mesh)
    assert found.chosen.sampling is not SamplingMode.VERTICES
    assert sheet_area(found.axis) > 0.85 and not said(found)
    (text,) = said(computed(mesh, SamplingMode.VERTICES))
    assert "missing or torn" in text


def test_a_thin_shell():
    ball = meshes.icosphere(4)
    shell = meshes.join(ball, meshes.flip((0.99 * ball[0], ball[1])))
    (text,) = said(computed(shell, SamplingMode.SURFACE))
    assert text.startswith("at ") and "about 0.01" in text
    assert computed(shell, SamplingMode.SURFACE).missed > 0.95


def test_two_linked_thin_tubes():
    """All of them is sharp; what is said of shares and of medians speaks of the same samples."""
    one = meshes.torus(1.0, 0.008, 64, 4, turn=0.5)
    two = one[0][:, [0, 2, 1]] * (1, -1, 1) + (1, 0, 0), one[1]
    found = computed(meshes.join(one, two), SamplingMode.SURFACE, samples=1000)
    assert said(found)
    assert (found.density.median > found.density.limit) == (found.density.share > 0.5)


def holed_block(along, across):
    """A flat block with a grid of square holes, so many along each side: a surface of genus along times across."""
    solid = np.ones((2 * along + 1, 2 * across + 1), bool)
    solid[1::2, 1::2] = False
    cells = np.argwhere(solid)
    ends = np.dstack((cells, cells + 1)).transpose(0, 2, 1) / along
    return thin_solids.union(*((((*low, 0.0), (*high, 0.02)) for low, high in ends)))


def test_a_block_with_many_tunnels(medial):
    mesh = holed_block(19, 7)
    assert medial.open_edges(*mesh) == 0
    assert topology.euler(mesh[1]) == 2 - 2 * 133
    found = computed(mesh, SamplingMode.SURFACE, samples=4000)
    assert said(found) and found.missed > 0.5
    assert (found.density.median > found.density.limit) == (found.density.share > 0.5)


@pytest.mark.parametrize(
    "mesh",
    [meshes.icosphere(4), meshes.box((1, 1, 1)), ellipsoid((1.0, 0.7, 0.4), 4)],
    ids=["ball", "box", "ellipsoid"],
)
def test_nothing_is_said_of_thick_shapes(mesh):
    found = computed(mesh)
    assert not said(found) and found.missed == 0.0


def test_a_wedge_is_not_thin_at_its_edge():
    mesh = prism([(0, 0), (1, 0), (1, 0.8)], [(0, 1, 2)], 1.0)
    found = computed(mesh, SamplingMode.SURFACE)
    assert found.axis.facets > 100 and found.missed == 0.0


def test_the_report_has_the_share(tmp_path, capsys):
    words = [meshes.write_off(tmp_path / "plate.off", plate(0.01)), str(tmp_path / "plate.ma")]
    assert cli.main([*words, "--samples", "2000", "--sampling", "surface", "--json"]) == 0
    report = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert report["missed"] > 0.8
    assert any("missing or torn" in text for text in report["warnings"])


@pytest.mark.parametrize(
    "change, word",
    [
        ({"reach": np.array([-1.0])}, "positive reaches"),
        ({"reach": np.array([1.0, 1.0])}, "one normal and one reach"),
        ({"points": np.array([[np.nan, 0, 0]])}, "finite coordinates"),
        ({"triangles": np.array([[0, 1, 99]], np.int32)}, "triangle corners below"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_distances_check_their_input(medial, change, word):
    vertices, triangles = meshes.box((1, 1, 1))
    given = {"points": np.zeros((1, 3)), "normals": np.eye(3)[:1], "reach": np.ones(1)}
    given = {**given, "vertices": vertices, "triangles": triangles, **change}
    with pytest.raises(medial.InvalidInputError, match=rf"^Expected .*{re.escape(word)}.*found.+;"):
        medial.wall_distances(*given.values())


def test_wanted_spacings_show_what_is_missed():
    areas, distances = np.array([1.0, 2.0, 1.0]), np.array([0.1, 1.5, 9.0])
    walls = Walls(np.eye(3), np.eye(3), np.ones(3), areas, np.arange(3), distance=distances)
    assert walls.missed == 0.25 and walls.thickness == 0.1
    points, spacings = walls.wanted(0.01)
    assert points.tolist() == np.eye(3)[:2].tolist() and spacings.tolist() == [0.05, 0.75]
    assert walls.wanted(0.2)[1].tolist() == [0.2, 0.75]
    assert walls.wanted(0.3)[1].tolist() == [0.75]  # the first stays too close


def test_a_surface_bulges_where_the_middle_of_its_walls_would_be_outside():
    given = np.eye(3), np.eye(3), np.ones(3), np.ones(3), np.arange(3)
    walls = Walls(*given, distance=np.array([1, 1, np.inf]), bulge=np.array([0.4, 0.6, 0.3]))
    assert walls.bulges.tolist() == [False, True, False]
    assert replace(walls, bend=np.full(3, 0.3)).bulges.tolist() == [True, True, False]
    assert replace(walls, bend=np.full(3, 0.1)).bulges.tolist() == [False, True, False]


def test_no_spacing_is_wanted_above_that_of_the_first_pass():
    """Vertices that are samples, too, make the mean spacing smaller than the distance of the other samples."""
    places, ones, far = np.eye(3), np.ones(3), np.full(3, np.inf)
    density = Density(places, ones, far, places[:0], finest=0.5, limit=0.25)
    distances = np.array([0.1, 0.6, 1.5])
    walls = Walls(places, places, ones, ones, np.arange(3), distance=distances)
    samples = Analysed(points=places, analysis=None, density=density, spacing=0.5, walls=walls)
    amount = next_amount(SimpleNamespace(effort=Effort(2, 1.0, 0.0625, 0.0625)), samples, 200)
    sites, spacings = amount.sizing
    assert amount.count == 200 and sites.tolist() == places.tolist()
    assert spacings.tolist() == [0.05, 0.3, 0.5]


def plates_of(mesh, spacing, **settings):
    """The share of the samples on plates, and how they were chosen."""
    wanted = Settings(samples=4000, side=Side.INNER, **settings)
    chosen = begin(shape_of(mesh), wanted, None, WHAT_IS_FREE, levels=True).chosen
    assert chosen.samples.spacing == pytest.approx(spacing, rel=0.2)
    return float(chosen.samples.plates.mean()), chosen


def test_the_walls_of_a_pipe_need_no_second_pass():
    """Epsilon is 0.5 at walls 3 spacings apart, but the axis between them is exact."""
    mesh = pipe(30, 0.5, 0.5, 0.15, 3.0)
    share, chosen = plates_of(mesh, 0.07)
    assert share > 0.8 and len(chosen.samples.points) < 4500
    assert chosen.samples.density.dense_enough
    _, dense = plates_of(mesh, 0.07, crisp=False)  # no ball has an exact place
    assert len(dense.samples.points) > 2 * len(chosen.samples.points)


def test_the_line_in_a_rod_needs_no_second_pass_either():
    mesh = lathe([(0, 0), (0.05, 0), (0.05, 3), (0, 3)], 48)
    share, chosen = plates_of(mesh, 0.0165)
    assert share > 0.8 and len(chosen.samples.points) < 4500
    axis = compute(*mesh, Settings(samples=4000)).axis
    line = np.setdiff1d(axis.edges, axis.face_vertices)
    assert axis.level.betti == (1, 0, 0) and len(line) > 100
    assert np.linalg.norm(axis.vertices[line, :2], axis=1).max() < 5e-5
    assert axis.radius[line] == pytest.approx(0.05, rel=2e-3)


@pytest.mark.parametrize("wall, is_plate", [(0.12, True), (0.08, True), (0.04, False)])
@pytest.mark.parametrize("bent", [False, True])
def test_walls_are_plates_as_far_as_their_axis_is_there(wall, is_plate, bent):
    """Below 0.8 spacings pairs show it, and neither needs more samples than the first pass."""
    mesh = pipe(40, 0.5, 0.5, wall, 3.0) if bent else block(3.0, 2.0, wall)
    _, chosen = plates_of(mesh, 0.065)
    assert (chosen.samples.partners is None) == is_plate
    assert len(chosen.samples.points) < 4500 and chosen.samples.density.dense_enough
    assert not chosen.differs
