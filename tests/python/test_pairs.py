# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples in pairs across thin walls: with the option, and where Automatic closes its loop, the topology is right."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from medial_axis import cli, library
from medial_axis.core.machine import native
from medial_axis.core.machine.progress import Progress
from medial_axis.core.samples import judge, next_amount
from medial_axis.core.samples.buried_samples import find_bare, on_flat_faces
from medial_axis.core.samples.doubts import Topology
from medial_axis.core.samples.sample_spacing import Amount
from medial_axis.core.samples.surface_samples import _of_rows, are_paired
from medial_axis.core.samples.walls import Walls
from medial_axis.core.shape.shape import Shape
from scipy.spatial import cKDTree
from support import meshes, thin_solids
from support.measure import polygons
from support.readers import area_of
from support.thick_meshes import block, pipe, shell

PLATES = thin_solids.plate(0.01), thin_solids.plate(1e-4), thin_solids.profile_t(0.002)


def inside(mesh, **options):
    return library.compute(*thin_solids.turned(mesh), side="inner", **options)


def in_pairs(solid):
    return inside(solid.mesh, pairs=True, sampling="surface", samples=4000)


@pytest.mark.parametrize(
    "solid",
    [
        *PLATES, thin_solids.profile_l(0.002), thin_solids.cross(0.004), thin_solids.stairs(0.004),
        thin_solids.slot(1e-4), thin_solids.layers(0.002), thin_solids.layers(0.002, thickness=0.004),
        thin_solids.bent_gap(0.003),
    ],
    ids=["plate", "foil", "T", "L", "cross", "stairs", "slot", "plates", "foils", "bent"],
)  # fmt: skip
def test_few_samples_show_whole_sheets_and_none_across_narrow_gaps(solid):
    """The samples are 0.03 apart."""
    found = in_pairs(solid)
    assert tuple(found.axis.level.betti) == solid.betti
    assert len(found.chosen.samples.points) < 4200 and found.chosen.samples.buried == 0
    assert not any("walls are closer" in warning for warning in found.warnings)


def test_small_faces_at_a_sharp_edge_and_narrow_slots_are_not_buried():
    """The samples are 0.03 apart, so that one looks 3e-5 off the surface for its two sides."""
    tip = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]) * 1e-3 + [0, 0, 1]
    faces = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)], np.int32)
    for mesh in ((tip, faces), thin_solids.slot(2e-5).mesh):
        shape = Shape(*thin_solids.turned(mesh))
        found = native.load().sample_surface(shape.points, shape.triangles, count=4000)
        given = shape, *on_flat_faces(shape, found, found.triangle, 0.03), 0.03
        bare, buried = find_bare(*given)
        assert buried == 0 and bare.all() == (mesh[0] is tip)
        assert find_bare(*given, gaps=True)[0].all()


def test_kept_vertices_bound_the_spacing_however_small_the_count_is():
    """Else every vertex is a neighbour of all others, and thousands of them take minutes."""
    points, triangles = shell(1.0, 0.9)
    options = {"count": 100, "keep_vertices": True, "pairs": True}
    kept = native.load().sample_surface(points, triangles, **options)
    assert len(points) <= len(kept.points) < 2.2 * len(points)
    spacing = np.sqrt(1.1547 * kept.area / len(points))
    assert kept.radius.max() < 2 * spacing


def test_every_share_of_the_rest_leaves_room_for_the_next_one():
    progress, seen = Progress(), []
    up, mesh = np.array([(0.0, 0.0, 1.0)]), thin_solids.plate(0.5).mesh
    for _ in range(4):
        progress.begin_share(0.3)
        native.load().wall_distances(up, up, np.ones(1), *mesh, progress=progress.part())
        seen.append(progress.fraction)
    assert np.allclose(seen, 1 - 0.7 ** np.arange(1, 5))


def test_crisp_places_do_not_fold_the_rim_of_a_foil():
    """The samples are 13 times as far apart as the walls; needles between them once let vertices go far astray."""
    solid = thin_solids.plate(0.001)
    axis = inside(solid.mesh).axis
    area = area_of(axis.vertices, polygons(axis))
    assert 0.995 * solid.area < area < 1.01 * (solid.area + solid.into_edges)


def test_a_second_pass_follows_curved_walls():
    solid = thin_solids.shell(0.003, subdivisions=4)
    found = inside(solid.mesh, pairs=True, samples=4000)
    assert tuple(found.axis.level.betti) == solid.betti
    assert 4500 < len(found.chosen.samples.points) < 60_000


def sampled_in_pairs(mesh, **options):
    return native.load().sample_surface(*mesh, pairs=True, **{"count": 2000} | options)


def share_with_partners(samples):
    named = np.flatnonzero(samples.partner >= 0)
    return len(np.union1d(named, samples.partner[named])) / len(samples.points)


def ways_of_pairs(samples):
    named = samples.partner >= 0
    return named, samples.points[named] - samples.points[samples.partner[named]]


@pytest.mark.parametrize("thickness", [0.03, 0.01, 1e-3, 1e-5])
def test_every_sample_of_a_plate_is_opposite_its_partner(thickness):
    samples = sampled_in_pairs(thin_solids.turned(thin_solids.plate(thickness).mesh))
    assert share_with_partners(samples) == 1.0
    apart = np.linalg.norm(ways_of_pairs(samples)[1], axis=1)
    np.testing.assert_allclose(apart, thickness, rtol=0.02, atol=2e-7)
    nearest = cKDTree(samples.points).query(samples.points, 2)[0][:, 1]
    assert thickness != 0.01 or nearest.min() > 0.9 * 0.01, "none takes the place of a corner"


def test_thick_solids_are_sampled_without_partners():
    cube = thin_solids.turned(block(1, 1, 1))
    samples = sampled_in_pairs(cube)
    assert (samples.partner == -1).all()
    plain = native.load().sample_surface(*cube, count=2000)
    assert len(samples.points) == pytest.approx(len(plain.points), abs=40)


def test_partners_on_curved_walls_lie_along_the_normals():
    outer, inner = (meshes.torus(1.0, small, 64, 32) for small in (0.4, 0.39))
    samples = sampled_in_pairs(meshes.join(outer, meshes.flip(inner)), count=6000, smooth=True)
    assert share_with_partners(samples) > 0.99
    named, ways = ways_of_pairs(samples)
    along = np.einsum("ij,ij->i", ways, samples.normals[named]) / np.linalg.norm(ways, axis=1)
    assert along.min() > 0.9995


def test_samples_of_a_long_edge_follow_a_small_spacing_next_to_large_ones():
    """The smallest spacing is in the middle of no step of a coarse division of the edge."""
    points, triangles = block(1, 1, 1)
    start, along = points[0], np.eye(3)[0] * -2 * points[0, 0]
    spacings = np.where(np.arange(101) == 12, 0.002, 0.5)
    sites = start + np.linspace(0.0, 1.0, 101)[:, None] * along
    samples = native.load().sample_surface(points, triangles, sizing=(sites, spacings), pairs=True)
    share = (samples.points - start) @ along
    off = np.linalg.norm(samples.points - start - share[:, None] * along, axis=1)
    at = np.sort(share[off < 1e-5])
    far = np.abs(at - 0.12)
    assert len(at) > 20
    assert (np.diff(at) < 1.3 * (0.002 + 0.3 * np.maximum(far[1:], far[:-1]))).all()


def test_partners_have_to_fit_the_points(medial):
    mesh = thin_solids.plate(0.01).mesh
    samples = sampled_in_pairs(mesh, count=500)
    analysis = medial.MedialAnalysis(samples.points, mesh[1], vertices=mesh[0])
    few = samples.partner[:-1]
    for wrong in (few, np.append(few, np.int32(len(samples.points)))):
        with pytest.raises(medial.InvalidInputError):
            analysis.hierarchy(partners=wrong)


def test_without_the_option_no_sample_has_a_partner():
    found = inside(thin_solids.plate(0.05).mesh, sampling="surface", samples=2000)
    assert found.chosen.samples.partners is None


def test_partners_are_counted_among_the_samples_that_are_kept():
    partners = np.array([3, 2, 1, -1, 1], np.int32)
    assert are_paired(partners).tolist() == [True, True, True, True, True]
    kept = np.array([True, False, True, True, True])
    assert _of_rows(partners, kept).tolist() == [2, -1, -1, -1]


def test_pairs_miss_walls_only_where_these_bend_away():
    walls = Walls(
        points=np.zeros((4, 3)),
        normals=np.zeros((4, 3)),
        distance=np.full(4, 0.1),
        spacing=np.ones(4),
        area=np.ones(4),
        faces=np.arange(4, dtype=np.int32),
        bend=np.array([0.0, 0.01, 1.0, 0.0]),
        paired=np.array([True, True, True, False]),
    )
    assert walls.missed == 0.5
    places, wanted = walls.wanted(1e-3)
    assert np.allclose(np.sort(wanted), [0.05, np.sqrt(0.025)])
    assert len(places) == 2


def plate_with_a_hole(width, thickness):
    """A plate of 1 by 1 with a square hole."""
    low, high = 0.5 - width / 2, 0.5 + width / 2
    bars = [((0, 0), (low, 1)), ((high, 0), (1, 1))]
    bars += [((low, 0), (high, low)), ((low, high), (high, 1))]
    boxes = [((*a, 0.0), (*b, thickness)) for a, b in bars]
    return thin_solids.ThinSolid(thin_solids.union(*boxes), (1, 1, 0), 1.0)


@pytest.mark.parametrize(
    "solid",
    [
        *PLATES,
        thin_solids.shell(0.01),
        plate_with_a_hole(0.006, 0.005),
    ],
    ids=["plate", "foil", "T", "shell", "hole"],
)
def test_automatic_finds_thin_walls_and_small_holes(solid):
    found = inside(solid.mesh)
    assert found.axis.level.betti == solid.betti
    assert "samples in pairs" in found.chosen.reason and found.settings.pairs
    assert not found.warnings and found.topology.endswith("as the solid")


@pytest.mark.parametrize(
    "differences, passes",
    [
        # The spacings of both sides of a wall became small one after the other.
        ([8, 3, 46, 19, 5, 0], 6),
        ([8, 4, 17, 36, 16, 2, 0], 7),
        ([8, 9, 9, 9, 9, 0], 1),  # three in a row are no better
        ([8, 5, 200, 0], 2),
        ([9, 8, 7, 6, 5, 4, 3, 2, 1, 1, 0], 10),
    ],
)
def test_the_loop_goes_on_while_it_helps(monkeypatch, differences, passes):
    """The best of the passes is taken; `differences` are those that each pass would have."""
    samples = SimpleNamespace(points=np.zeros((1, 3)), buried=0, walls_are_close=False)
    samples.density, amount = SimpleNamespace(dense_enough=True), Amount(1, 1.0, flat=1.0)
    monkeypatch.setattr(judge, "finer_in_pairs", lambda *_: amount)
    plan = SimpleNamespace(given=SimpleNamespace(settings=SimpleNamespace(budget=1000)))
    known = {"samples": samples, "amount": amount, "topology": object()}
    made = [SimpleNamespace(differences=number, **known) for number in (10, *differences)]
    count = next(k for k in range(2, 99) if not judge._next_in_pairs(plan, made[:k]))
    best, found = judge._best_of(made[:count])
    assert found == passes and best.differences == differences[passes - 1]


@pytest.mark.parametrize(
    "missed, doubts, follows",
    [
        (0.0, 1, ["own", "doubts"]),
        (0.05, 1, ["density", "doubts"]),
        (0.5, 1, ["density"]),  # the doubts are everywhere
        (0.0, 0, ["density"]),
    ],
)
def test_the_second_pass_in_pairs_is_denser_where_it_has_to_be(
    monkeypatch, missed, doubts, follows
):
    spacings = {"own": [3.0, 3.0], "density": [2.0], "doubts": [1.5]}
    amount = Amount(1, 1.0, sizing=(np.zeros((1, 3)), np.array(spacings["density"])))
    monkeypatch.setattr(next_amount, "next_amount", lambda *_: amount)
    samples = SimpleNamespace(
        points=np.array([(0.0, 0.0, 0.0), (9.0, 0.0, 0.0)]),
        apart=np.array(spacings["own"]),
        walls=SimpleNamespace(missed=missed),
        walls_are_close=missed > 0.01,
        by_faces=(1, 0, 0),
    )
    topology = Topology((1, 7, 0), np.full((doubts, 3), 1.0), np.full(doubts, 5.0))
    plan = SimpleNamespace(first=amount)
    sites, apart = next_amount.finer_in_pairs(plan, samples, topology, 1, 1000).sizing
    assert apart.tolist() == [s for name in follows for s in spacings[name]]
    assert len(sites) == len(apart)


def assert_one_loop(sides, wall, length=12.0):
    """The axis of a pipe of radius 1 with flat ends."""
    found = library.compute(*pipe(sides, 1.0, 1.0, wall, length), side="inner")
    assert tuple(found.axis.level.betti) == (1, 1, 0) and not found.warnings
    assert len(found.chosen.samples.points) < 20_000


@pytest.mark.parametrize("of", [(13, 0.05), (24, 0.01), (32, 0.012, 4.0), (32, 0.01, 4.0)])
def test_the_axis_of_a_thin_tube_of_flat_sides_has_one_loop(of):
    """Its smooth surface leaves its walls, and edges of its flat faces that had no samples made loops.

    It left walls of 32 sides by less than half their distance, and facets lay outside: 2 and 29 loops.
    """
    assert_one_loop(*of)


@pytest.mark.parametrize("sides, wall", [(14, 0.05), (16, 0.05), (16, 0.08)])
def test_pairs_do_not_cross_at_edges_that_are_rounded(sides, wall):
    """Places beside an edge have their partners beyond the opposite one: the axis had up to 19 loops."""
    assert_one_loop(sides, wall)


def test_a_thick_mesh_takes_one_pass_and_the_same_samples(monkeypatch):
    mesh = thin_solids.union(((0, 0, 0), (1, 2, 0.7)))
    found = inside(mesh)
    monkeypatch.setattr(judge, "compares", lambda *_: False)
    plain = inside(mesh)
    assert found.chosen.reason == plain.chosen.reason
    for name in ("vertices", "radius", "face_vertices"):
        assert getattr(found.axis, name).tobytes() == getattr(plain.axis, name).tobytes()


def test_doubts_are_where_samples_are_too_few_whatever_the_threads():
    module = native.load()
    for thickness, some in ((0.002, True), (0.4, False)):
        points, triangles = thin_solids.turned(plate_with_a_hole(0.1, thickness).mesh)
        samples = module.sample_surface(points, triangles, count=4000)
        reach = 1.5 * samples.radius / 0.727
        found = []
        for threads in (1, 3):
            analysis = module.MedialAnalysis(
                samples.points, triangles, vertices=points, threads=threads
            )
            found.append(analysis.doubts(points, triangles, samples.normals, reach))
        (places, gaps), (again, _) = found
        assert places.tobytes() == again.tobytes() and len(places) == len(gaps)
        assert bool(len(places)) == some
    with pytest.raises(module.InvalidInputError, match="one reach per point"):
        analysis.doubts(points, triangles, samples.normals, reach[:-1])


def test_the_command_line_says_what_was_done(tmp_path):
    mesh = thin_solids.turned(thin_solids.plate(0.002).mesh)
    source = meshes.write_obj(tmp_path / "plate.obj", mesh)
    assert cli.main([source, str(tmp_path / "plate.ply")]) == 0
    report = json.loads((tmp_path / "plate.ply.json").read_text())
    assert "the walls are thin: samples in pairs" in report["sampled"]
    assert report["topology"].endswith("as the solid")
