# SPDX-License-Identifier: GPL-3.0-or-later
"""Middle surfaces of thin solids whose sheets are known, and as files; CalculiX judges the shell elements."""

import json
import shutil
import subprocess
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.mid_surface import even_quads, few_faces, quad_pairs, thin_sheets
from medial_axis.core.mid_surface import mid_surface as middle
from medial_axis.core.mid_surface.carried_sheets import CarriedSheets
from medial_axis.core.mid_surface.crossed_borders import crossings
from medial_axis.core.mid_surface.even_triangles import divided, even_triangles
from medial_axis.core.mid_surface.mid_surface import mid_surface
from medial_axis.core.mid_surface.quad_pairs import least_sines
from medial_axis.core.mid_surface.sheet_faces import SheetFaces
from medial_axis.core.settings import MidSurfaceSettings, Settings
from medial_axis.core.shape.shape import Shape
from support import distance, mid_surfaces, reference, topology
from support.meshes import shape_of, write_off
from support.thick_meshes import block, lathe, pipe
from support.thin_solids import turned, union
from test_reduce import grid


def sheets_of(mesh, settings=Settings(samples=4000), **wanted):
    return mid_surface(shape_of(mesh), settings, MidSurfaceSettings(**wanted))


def area(found):
    return topology.area(found.vertices, found.triangles)


def assert_one_disc(found):
    """One sheet in one piece without holes, of few polygons."""
    assert found.sheets == topology.components(found.triangles) == 1
    assert topology.euler(found.triangles) == 1 and len(found.part) < 30


def off(known, places):
    """(n,) how far places are from the rectangles."""
    corner, u, v = known.rectangles.transpose(1, 0, 2)
    halves = [np.stack((corner, corner + side, corner + u + v), axis=1) for side in (u, v)]
    return distance.to_triangles(places, np.concatenate(halves))


@pytest.mark.parametrize("name", mid_surfaces.FLAT)
def test_sheets_of_flat_walls(name):
    known = mid_surfaces.ALL[name]()
    check_flat(known, sheets_of(known.mesh))


@pytest.mark.parametrize(("thickness", "samples"), [(0.04, 3000), (0.04, 4000), (0.06, 1500)])
def test_three_walls_meet_in_one_corner(thickness, samples):
    known = mid_surfaces.tray(thickness)  # the line of two sheets went on beyond it, and back
    check_flat(known, sheets_of(known.mesh, Settings(samples=samples)))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", mid_surfaces.FLAT[:8])
def test_sheets_of_flat_walls_at_the_defaults(name, seed):
    """In a random pose, for which the sheets are turned back."""
    known = mid_surfaces.ALL[name]()
    points = np.asarray(known.mesh[0], float)
    mesh = turned(known.mesh, seed) if seed else known.mesh
    pose = np.linalg.lstsq(points, mesh[0], rcond=None)[0]
    found = sheets_of(mesh, Settings())
    check_flat(known, replace(found, vertices=found.vertices @ np.linalg.inv(pose)))


def check_flat(known, found):
    assert found.sheets == known.sheets
    assert off(known, found.vertices).max() < 0.005 * known.t
    _, u, v = known.rectangles.transpose(1, 0, 2)
    corners = known.rectangles[:, :1] + np.stack((0 * u, u, v, u + v), axis=1)
    away = np.linalg.norm(corners.reshape(-1, 1, 3) - found.vertices, axis=2).min(axis=1)
    assert away.max() < 0.005 * known.t, "corners of walls and ends of junctions are vertices"
    np.testing.assert_allclose(found.thickness, known.t, rtol=0.005)
    exact = np.linalg.norm(np.cross(*known.rectangles[:, 1:].transpose(1, 0, 2)), axis=1).sum()
    assert area(found) == pytest.approx(exact, rel=0.001)
    triangles = found.triangles
    assert topology.euler(triangles) == known.betti[0] - known.betti[1] + known.betti[2]
    assert topology.components(triangles) == known.betti[0]
    assert found.share == pytest.approx(1.0, abs=0.03)


def test_ribs_and_their_plate_thickened_are_the_solid():
    """Less than 1 % of the volume of the solid is in one of the two only, by random places in its box."""
    known = mid_surfaces.ribbed_plate()
    found = sheets_of(known.mesh)
    half = known.t / 2
    places = np.random.default_rng(5).uniform((0, 0, 0), (1, 1, 0.2), (20000, 3))
    fins = np.abs(places[:, :1] - (0.25, 0.5, 0.75)).min(axis=1) < half
    solid = (places[:, 2] < known.t) | fins
    thick = np.zeros(len(places), bool)
    thickness = found.thickness[found.face_of_triangles]
    for triangle, wall in zip(found.vertices[found.triangles], thickness, strict=True):
        thick |= in_prism(places, triangle, wall)
    assert (thick != solid).sum() < 0.01 * solid.sum()


def in_prism(places, triangle, height):
    """(n,) which places are at most half of a height beside a triangle, in the direction of its normal."""
    (normal,) = topology.vector_areas(triangle, np.array([(0, 1, 2)]))
    size = np.linalg.norm(normal)
    beside = (np.abs((places - triangle[0]) @ normal) <= size * height / 2) & (size > 0.0)
    for start, end in zip(triangle, np.roll(triangle, -1, axis=0), strict=True):
        beside &= (places - start) @ np.cross(normal, end - start) >= 0.0
    return beside


def test_a_web_reaches_its_flange_between_reflex_edges():
    """So few samples that one row of facets, between samples on the two edges, reaches from the web to the flange."""
    mesh = union(((0.2, 0, 1.0), (0.4, 0.2, 1.02)), ((0.29, 0, 0.85), (0.31, 0.2, 1.02)))
    found = sheets_of(mesh, Settings(samples=800))
    assert found.sheets == 3 and topology.components(found.triangles) == 1
    assert area(found) == pytest.approx(0.2 * 0.2 + 0.16 * 0.2, rel=0.005)


def test_a_bent_sheet_is_in_the_middle_and_has_its_area():
    """Two flat sides of 0.5 and a quarter of a cylinder of radius 0.1, 1 wide."""
    known = mid_surfaces.bent_sheet()
    found = sheets_of(known.mesh)
    x, y, z = found.vertices.T
    away = np.where(
        x < 0, np.abs(z + 0.1), np.where(z > 0, np.abs(x - 0.1), np.abs(np.hypot(x, z) - 0.1))
    )
    assert away.max() < 0.1 * known.t and np.quantile(away, 0.99) < 0.03 * known.t
    assert y.min() > -0.05 * known.t and y.max() < 1.0 + 0.05 * known.t
    assert found.sheets == 1 and topology.euler(found.triangles) == 1
    assert area(found) == pytest.approx(1.0 + 0.05 * np.pi, rel=0.001)
    assert found.share == pytest.approx(1.0, abs=0.01)
    np.testing.assert_allclose(found.thickness, known.t, rtol=0.005)


def assert_polygon(mesh, sides, bar):
    found = sheets_of(mesh, Settings(samples=2500))
    assert_one_disc(found)
    assert area(found) == pytest.approx(0.125 * sides * np.sin(2 * np.pi / sides), rel=bar)


def test_a_rim_round_a_plate_does_not_cross_itself():
    """The plate is thinner than samples are apart, so its rim zigzags before it is carried on to the wall."""
    assert_polygon(mid_surfaces.round_plate(sides=40).mesh, 40, 0.002)


@pytest.mark.parametrize("sides, t", ((12, 0.005), (8, 0.002), (6, 0.002), (3, 0.002)))
def test_plates_thinner_than_samples_are_apart_reach_their_walls(sides, t):
    """The rim of their axis is one closed line, which was drawn together in a point."""
    assert_polygon(mid_surfaces.round_plate(sides, t).mesh, sides, 0.005)


@pytest.mark.slow
def test_a_shell_with_two_holes_has_its_area():
    """A zone of a sphere: what lies between 25 and 155 degrees of the pole."""
    known = mid_surfaces.holed_shell()
    found = sheets_of(known.mesh)
    triangles = found.triangles
    assert found.sheets == topology.components(triangles) == 1 and topology.euler(triangles) == 0
    assert area(found) == pytest.approx(4 * np.pi * np.cos(np.radians(25)), rel=0.01)
    np.testing.assert_allclose(found.thickness, known.t, rtol=0.005)
    assert found.share == pytest.approx(1.0, abs=0.01)


def test_a_leaf_tapers_to_its_edge():
    """Its middle is a disc; the caps are so flat that the thickness falls with the square of the radius."""
    known = mid_surfaces.leaf()
    found = sheets_of(known.mesh)
    assert found.sheets == 1 and np.abs(found.vertices[:, 2]).max() < 0.01 * known.t
    assert area(found) == pytest.approx(np.pi, rel=0.005)
    away = np.linalg.norm(found.vertices[:, :2], axis=1)
    assert (found.of_vertices[away > 0.9999] < 1e-6 * known.t).all()
    assert_falls_with_the_square(found, known.t, 0.005, 0.005)
    assert found.share == pytest.approx(1.0, abs=0.01)


def assert_falls_with_the_square(found, t, rim, face):
    """The thickness at vertices, and at the middle of each face, by area."""
    sizes = np.linalg.norm(topology.vector_areas(found.vertices, found.triangles), axis=1)
    sums = np.zeros((len(found.part), 3))
    middles = found.vertices[found.triangles].mean(axis=1)
    np.add.at(sums, found.face_of_triangles, sizes[:, None] * middles)
    middles = sums / np.bincount(found.face_of_triangles, sizes)[:, None]
    for lengths, places, bar in (
        (found.of_vertices, found.vertices, rim),
        (found.thickness, middles, face),
    ):
        exact = t * (1 - (places[:, :2] ** 2).sum(axis=1))
        np.testing.assert_allclose(lengths, exact, atol=bar * t)


@pytest.mark.parametrize("t, rim, face", [(0.05, 0.005, 0.005), (0.03, 0.02, 0.01)])
def test_a_lens_with_a_flat_rim_keeps_its_thickness_there(t, rim, face):
    """Its rim is a wall of half of the thickness in the middle. Faces beside slivers had 1.25 of their thickness."""
    radius = 0.5**0.5
    x = np.linspace(0.0, radius, 18)
    height = 0.5 * t * (1.0 - x**2)
    profile = [*zip(x, -height, strict=True), *zip(x[::-1], height[::-1], strict=True)]
    found = sheets_of(lathe(profile, 96))
    away = np.linalg.norm(found.vertices[:, :2], axis=1)
    assert found.sheets == 1 and away.max() == pytest.approx(radius, rel=1e-3)
    assert_falls_with_the_square(found, t, rim, face)


@pytest.mark.parametrize("inner, away", [(0.7, 0.5), (0.6, 0.6)])
def test_a_bowl_that_thins_to_its_brim_keeps_its_volume(inner, away):
    """Between two spheres. Edges as long as its bottom is thick took away up to two thirds of it."""
    brim = (1 + away**2 - inner**2) / (2 * away)
    outside = np.linspace(-np.pi / 2, np.arcsin(brim), 30)
    inside = np.linspace(np.arcsin((brim - away) / inner), -np.pi / 2, 30)[1:]
    radius = np.append(np.cos(outside), inner * np.cos(inside))
    radius[[0, -1]] = 0.0
    height = np.append(np.sin(outside), away + inner * np.sin(inside))
    found = sheets_of(lathe(np.column_stack((radius, height)).tolist(), 48))
    assert found.sheets == 1 and 0.85 < found.share < 1.1


@pytest.mark.parametrize(
    "mesh, samples", [(block(1.0, 0.9, 0.8), 4000), (pipe(32, 1.0, 1.0, 0.5, 0.5), 2000)]
)
def test_what_is_as_thick_as_it_is_long_has_no_thin_wall(mesh, samples):
    with pytest.raises(InvalidInputError, match="found none"):
        sheets_of(mesh, Settings(samples=samples))


# Two fins on opposite sides of a block, which is no wall.
FINS = union(
    ((-0.2, 0, -0.2), (0.2, 0.4, 0.2)),
    ((-0.8, 0, -0.01), (0, 0.4, 0.01)),
    ((0, 0, -0.01), (0.8, 0.4, 0.01)),
)


def test_sheets_that_a_thick_part_joins_are_told():
    """There are two pieces of one solid."""
    found = sheets_of(FINS)
    assert found.sheets == topology.components(found.triangles) == 2
    said = [text for text in found.warnings if "2 pieces and the solid 1" in text]
    assert len(said) == 1 and "what joins them is not thin" in said[0]


def test_thick_parts_are_kept_by_choice(tmp_path, capsys):
    """Faces of a block stay, and those of the two fins on it do not."""
    assert sheets_of(FINS).thick is None
    found = sheets_of(FINS, keep_thick=True)
    assert np.abs(found.thick.vertices).max() < 0.401
    assert area(found.thick) == pytest.approx(6 * 0.4 * 0.4 - 2 * 0.4 * 0.02, rel=1e-9)
    source = write_off(tmp_path / "part.off", FINS)
    assert run(source, tmp_path / "part.obj", "--keep-thick") == cli.DONE
    assert (tmp_path / "part_thick.stl").stat().st_size == 84 + 50 * len(found.thick.triangles)


def test_a_thin_solid_has_no_thick_parts():
    for name in ("profile_i", "bent_sheet"):
        assert not len(sheets_of(mid_surfaces.ALL[name]().mesh, keep_thick=True).thick.triangles)


def test_sheets_that_should_meet_and_do_not_are_told(monkeypatch):
    """The web of a T without the facets at half of its height, as if they had been taken for frayed ones."""
    known, chosen = mid_surfaces.profile_t(), middle.thin_sheets

    def without_some(axis, *others):
        thin = chosen(axis, *others)
        heights = thin.vertices[thin.triangles][:, :, 2]
        some = thin.facet[(heights.min(axis=1) < 0.25) & (heights.max(axis=1) > 0.15)]
        kept = ~np.isin(thin.facet, some)
        of_triangles = ("triangles", "part", "facet", "facing", "sliver", "normals", "slopes")
        return replace(thin, **{name: getattr(thin, name)[kept] for name in of_triangles})

    monkeypatch.setattr(middle, "thin_sheets", without_some)
    said = sheets_of(known.mesh).warnings
    assert any("2 pieces and the solid 1: sheets that should meet do not" in text for text in said)


def test_sheets_with_other_loops_than_the_axis_say_so(monkeypatch):
    def pierced(sheets):
        made = few_faces.few_faces(sheets, len(sheets.vertices), None)
        return replace(
            made, offsets=made.offsets[:-1], corners=made.corners[:-3], part=made.part[:-1]
        )

    monkeypatch.setattr(middle, "_simplified", lambda sheets, *_: pierced(sheets))
    said = sheets_of(mid_surfaces.holed_shell(around=32, rings=16).mesh).warnings
    assert any("the sheets have other loops" in text for text in said)


def test_sheets_that_leave_the_solid_say_so():
    shape = Shape(*mid_surfaces.plate(0.1).mesh)
    high = shape.points.max(axis=0)
    places = np.array([0.5 * high, high + 0.01, high + np.array((0.0, 0.0, 0.2))])
    assert not middle._outside(places[:2], 0.1, shape)
    (words,) = middle._outside(places, 0.1, shape)
    assert words.startswith("the sheets leave the solid by up to 0.2, ")


def test_vertices_at_one_place_stay_two_where_uniting_them_closes_a_hole():
    """An edge of a hole with three corners has no length."""
    turn = np.radians((0, 120, 240, 180, 180, 0))
    points = np.column_stack((np.cos(turn), np.sin(turn), 0 * turn)) * np.repeat((4, 1), 3)[:, None]
    ring = ((0, 1, 5), (1, 3, 5), (1, 2, 3), (2, 4, 3), (2, 0, 4), (0, 5, 4))
    triangles = np.array(ring, np.int32)
    sheets = CarriedSheets(points, triangles, np.zeros(6, np.int32), np.ones((6, 3)))
    assert topology.euler(middle._welded(sheets).triangles) == topology.euler(triangles) == 0


def pot(around, wall):
    return lathe(
        [(0, 0), (0.35, 0), (0.5, 0.55), (0.5 - wall, 0.55), (0.35 - wall, wall), (0, wall)], around
    )


def test_a_vertex_between_sheets_stays_between_them():
    """The balls between them were as large as the thicker wall, and slabs next to these slanted."""
    found = sheets_of(pot(14, 0.08), Settings(samples=16000))
    assert not found.warnings and found.sheets == 2
    # A chord bulges, and the corner counts twice.
    assert found.share == pytest.approx(1.03, abs=0.02)


def test_sheets_of_a_pot_with_flat_sides_are_polygons():
    """Sheets of two thicknesses meet round its bottom."""
    found = sheets_of(pot(8, 0.05))
    assert (found.sheets, len(found.part), len(found.vertices)) == (9, 9, 16)
    bottom, *sides = found.thickness
    assert bottom == pytest.approx(0.05) and sides == pytest.approx(8 * [0.050648], abs=1e-6)


@pytest.mark.parametrize("name", ["profile_t", "bent_sheet"])
def test_triangles_of_a_size_are_even(name):
    """Where the bend begins, its short edges lie beside a flat side; triangles there must be no slivers."""
    known = mid_surfaces.ALL[name]()
    found = sheets_of(known.mesh, Settings(samples=5000), size=0.05)
    corners = found.vertices[found.triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(sides, axis=2)
    assert lengths.max() < 0.05 * 1.5 and np.median(lengths) == pytest.approx(0.05, rel=0.15)
    cosines = -(sides * np.roll(sides, 1, axis=1)).sum(2) / (lengths * np.roll(lengths, 1, axis=1))
    least = np.degrees(np.arccos(cosines.max(axis=1)))
    assert least.min() > 10 and np.quantile(least, 0.01) > 20 and found.sheets in (1, 3)
    assert_as_without_a_size(found, known.mesh)


def assert_as_without_a_size(found, mesh):
    whole = sheets_of(mesh)
    assert topology.euler(found.triangles) == topology.euler(whole.triangles)
    assert area(found) == pytest.approx(area(whole), rel=2e-3)  # chords of the bend
    assert (topology.edges(found.triangles)[1] == 3).any() == (found.sheets > 1)


@pytest.mark.parametrize("name", ["profile_t", "ribbed_plate", "bent_sheet"])
def test_quads_of_a_size_are_even(name):
    """A grid in each rectangle; elsewhere nine of ten faces at least are pairs of triangles."""
    known = mid_surfaces.ALL[name]()
    found = sheets_of(known.mesh, size=0.05, quads=True)
    sizes = np.diff(found.face_offsets)
    assert set(sizes) <= {3, 4} and (sizes == 4).mean() > (0.9 if name == "bent_sheet" else 0.95)
    four = found.face_vertices[found.face_offsets[:-1][sizes == 4, None] + np.arange(4)]
    sines = least_sines(found.vertices[four])
    assert sines.min() > 0.49 and (name != "profile_t" or sines.min() > 0.999)
    sides = np.linalg.norm(found.vertices[four] - found.vertices[np.roll(four, 1, axis=1)], axis=2)
    assert sides.max() < 0.05 * 1.75 and np.median(sides) == pytest.approx(0.05, rel=0.15)
    assert_as_without_a_size(found, known.mesh)
    assert topology.components(found.triangles) == 1
    turns = topology.vector_areas(found.vertices, four[:, :3])
    for sheet in range(found.sheets if name != "bent_sheet" else 0):
        mine = turns[found.part[sizes == 4] == sheet]
        assert (mine @ mine.sum(axis=0)).min() > 0.0, "faces of a sheet turn the same way"


def test_single_triangles_are_exchanged_for_pairs():
    """Six triangles in a row: the best pair, in the middle of it, leaves two single ones that no pair joins."""
    pairs = np.column_stack((np.arange(5), np.arange(1, 6)))
    for best in range(5):
        value = np.where(np.arange(5) == best, 1.0, 0.6)
        partner = quad_pairs._matched(6, pairs, value)
        assert (partner >= 0).all() and (partner[partner] == np.arange(6)).all()
    partner = quad_pairs._matched(5, pairs[:4], np.full(4, 0.6))
    assert (partner < 0).sum() == 1


def test_a_grid_keeps_the_edges_round_it():
    """A rectangle of 3 by 2 with an uneven side; another number of edges on the side opposite makes no grid."""
    ring = [(0, 0), (1, 0), (2.5, 0), (3, 0), (3, 1), (3, 2), (2, 2), (1, 2), (0, 2), (0, 1)]
    ring = np.column_stack((ring, np.zeros(10))).astype(float)
    places, quads = even_quads._grid(np.roll(ring, 3, axis=0))
    assert quads.shape == (6, 4) and least_sines(places[quads]).min() > 0.8
    found = {tuple(place) for place in places.tolist()}
    assert found >= {tuple(place) for place in ring.tolist()}
    assert even_quads._grid(np.delete(ring, 1, axis=0)) is None


@pytest.mark.parametrize("halves", (1, 2))
def test_bent_sheets_have_few_faces_and_none_is_lost_however_few_are_wanted(halves):
    """A saddle, whole or as two sheets that meet along a line with two nodes."""
    places, _, triangles, _ = grid(17, 17)
    places[:, 2] = 0.2 * (places[:, 0] - 3) * (places[:, 1] - 2)
    part = (halves * places[triangles].mean(axis=1)[:, 0] // 6.001).astype(np.int32)
    sheets = CarriedSheets(places, triangles, part, np.full(triangles.shape, 0.5))
    found = few_faces.few_faces(sheets, 1, None)
    assert set(found.part) == set(range(halves)) and len(found.part) <= 6 * halves


@pytest.mark.parametrize("past", (8.2, 9.5))
def test_only_around_a_border_that_crosses_itself_triangles_stay(past):
    """A square of 12 by 12 with a slit, of which one side reaches across the other one."""
    places = np.stack(np.meshgrid(range(13), range(13), [0], indexing="ij"), axis=-1)
    places = places.reshape(-1, 3).astype(float)
    at, solid = np.arange(169).reshape(13, 13), np.ones((12, 12), bool)
    solid[6, :8] = False
    places[at[6, 2], 0] = past
    a, b, c, d = (each[solid] for each in (at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]))
    triangles = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    triangles, part = triangles.astype(np.int32), np.zeros(len(triangles), np.int32)
    sheets = CarriedSheets(places, triangles, part, np.full(triangles.shape, 0.5))
    found = few_faces.few_faces(sheets, len(places), None)
    assert 3 < len(found.part) < 60 and not len(crossings(found)[0])
    meshes = (places, triangles), (found.vertices, found.triangles)
    whole, left = (topology.vector_areas(*mesh).sum(axis=0) for mesh in meshes)
    np.testing.assert_allclose(left, whole, atol=0.5e-9)
    assert topology.euler(found.triangles) == 1 and topology.edges(found.triangles)[1].max() == 2
    largest = found.ring(int(np.diff(found.offsets).argmax()))
    assert np.ptp(largest, axis=0)[:2].min() == 12.0


def test_a_polygon_that_crosses_itself_is_no_face():
    """Three squares in a row, of which the rim of the last has a loop in it: its triangles overlap.

    So it keeps those that it had, as does the one beside it. The first one, which is apart, is a polygon.
    """
    looped = [(0, 0), (4, 0), (4, 4), (2, 4), (2, -1), (1, -1), (1, 4), (0, 4)]
    beside = [(-4, 0), (0, 0), (0, 4), (-4, 4)]
    apart = [(-9, 0), (-5, 0), (-5, 4), (-9, 4)]
    places = np.insert(np.array([*apart, *beside, *looped], float), 2, 0.0, axis=1)
    offsets, part = np.array((0, 4, 8, 16), np.int32), np.arange(3, dtype=np.int32)
    faces = SheetFaces(places, offsets, np.arange(16, dtype=np.int32), part)
    own = np.insert(np.array([*apart, *beside, (4, 0), (4, 4)], float), 2, 0.0, axis=1)
    triangles = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7), (5, 8, 9), (5, 9, 6)]
    triangles = np.array(triangles, np.int32)
    sheets = CarriedSheets(own, triangles, np.repeat(part, 2), np.ones((6, 3)))
    found = few_faces._without_crossings(faces, sheets)
    assert found.part.tolist() == [0, 1, 1, 2, 2]
    assert np.diff(found.offsets).tolist() == [4, 3, 3, 3, 3]
    np.testing.assert_array_equal(found.ring(0), places[:4])
    np.testing.assert_array_equal(found.ring(3), sheets.vertices[[5, 8, 9]])
    simple = SheetFaces(places, offsets[:3], faces.corners[:8], part[:2])
    assert few_faces._without_crossings(simple, sheets) is simple


@pytest.mark.parametrize("quads, least", ((False, "0.00076"), (True, "0.0005")))
def test_a_size_that_makes_too_many_faces_is_refused(quads, least):
    """A plate of 1 by 0.5; the size is far too small to be squared."""
    words = f"at most 2,000,000 faces, found 1e-200, which makes about inf; choose {least}"
    with pytest.raises(InvalidInputError, match=words):
        sheets_of(block(1.0, 0.5, 0.02), Settings(samples=1000), size=1e-200, quads=quads)


def star(tips, thickness):
    """A plate of the shape of a star, from the middle to 0.5."""
    angle = np.pi * np.arange(2 * tips) / tips
    rim = np.column_stack((np.cos(angle), np.sin(angle))) * np.tile((0.5, 0.25), tips)[:, None]
    return mid_surfaces.fanned_plate(rim, thickness)


@pytest.mark.parametrize(
    "around, low, high, wall, length",
    [(64, 1.0, 1.0, 0.05, 0.4), (16, 1.0, 1.0, 0.1, 1.5), (24, 0.6, 1.0, 0.1, 1.0)],
)
def test_the_middle_of_a_pipe_is_round(around, low, high, wall, length):
    found = sheets_of(pipe(around, low, high, wall, length), Settings(samples=3000))
    slant = np.hypot(high - low, length)
    polygon = around * np.sin(np.pi / around)  # half of the circumference of radius 1
    assert area(found) == pytest.approx(polygon * (low + high - wall) * slant, rel=0.015)
    across = wall * length / slant
    assert np.average(found.thickness) == pytest.approx(across, rel=0.03)
    assert 0.95 < found.share < 1.05 and np.ptp(found.vertices[:, 2]) > 0.95 * length


@pytest.mark.parametrize("around", [48, 64])
def test_a_pipe_is_as_thick_at_its_ends_as_between_them(around):
    """Facets that reach from the wall to an edge of its end read 0.42 to 1.16 of the wall there."""
    found = sheets_of(pipe(around, 1.0, 1.0, 0.05, 1.0), Settings(samples=2000))
    for thickness in (found.thickness, found.of_vertices):
        np.testing.assert_allclose(thickness, 0.05, rtol=0.003)


@pytest.mark.parametrize("digits", [5, 7, 10])
def test_a_thin_pipe_of_few_sides_is_flat_sheets(digits):
    """Samples lie on its flat faces, so its edges of 30 degrees are sharp; facets across them read 0.93 to 0.96.

    Where its sides are flat only up to rounding, facets at its edges have two edges in common.
    """
    points, triangles = pipe(12, 1.0, 1.0, 0.05, 1.0)
    found = sheets_of((points.round(digits), triangles), Settings())
    assert found.sheets == len(found.part) == 12
    np.testing.assert_allclose(found.thickness, 0.05 * np.cos(np.pi / 12), atol=10.0**-digits)


def test_a_pipe_takes_no_more_samples_than_its_sheet_needs():
    """They were four times as many, as close as the whole axis needs, and the sheet took 20 s."""
    found = sheets_of(pipe(24, 5.0, 5.0, 0.8, 60.0), Settings())
    assert len(found.chosen.samples.points) < 20_000 and not found.warnings
    assert area(found) == pytest.approx(2 * np.pi * 4.6 * 60, rel=0.005)
    np.testing.assert_allclose(found.thickness, 0.8, rtol=0.002)


@pytest.mark.parametrize("around, low, wall", [(32, 0.7, 0.05), (48, 0.6, 0.035)])
def test_the_sheets_of_a_pot_stay_in_it(around, low, wall):
    """Its rim left it by a tenth of the wall; what is left is how far its smooth surface leaves its faces."""
    profile = [(0, 0), (low, 0), (1, 1.2), (1 - wall, 1.2), (low - wall, wall), (0, wall)]
    mesh = lathe(profile, around)
    found = sheets_of(mesh, Settings())
    outside = distance.to_triangles(found.vertices, mesh[0][mesh[1]])
    outside[reference.winding_number(found.vertices, *mesh) > 0.5] = 0.0
    assert found.sheets == 2 and outside.max() < 0.03 * wall
    assert found.share == pytest.approx(1.0, abs=0.02)


def test_a_sheet_without_thickness_is_none():
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    made = SheetFaces(
        np.concatenate((square, square + 2)),
        np.array([0, 4, 7, 10], np.int32),
        np.array([4, 5, 6, 7, 0, 1, 2, 0, 2, 3], np.int32),
        np.array([0, 1, 1], np.int32),
    )
    left = middle._with_volume(made, np.array([0.0, 0.0, 0.1]))
    np.testing.assert_array_equal(left.vertices, square)
    assert left.corners.tolist() == [0, 1, 2, 0, 2, 3] and left.offsets.tolist() == [0, 3, 6]
    assert left.part.tolist() == [1, 1]
    assert middle._with_volume(made, np.array([0.1, 0.0, 0.1])) is made


def test_more_volume_than_the_solid_has_and_less_are_told():
    (said,) = middle._left_out(1.06, 0.1, 0.01)
    assert "106 % of the volume" in said
    assert middle._left_out(1.04, 0.1, 0.01) == ()
    # All of it is thin, so what is missing is not said to be thick.
    (said,) = middle._left_out(0.9, 0.005, 0.03)
    assert "tips that are narrower than samples are apart, 0.03" in said


def test_tips_that_are_narrower_than_samples_are_apart_are_reached():
    found = sheets_of(star(12, 0.005), Settings(samples=1000))
    assert found.share == pytest.approx(1.0) and np.median(found.thickness) == pytest.approx(0.005)


def test_a_sheet_that_touches_itself_is_divided():
    """Three triangles of one sheet at an edge, which no library remeshes, beside a square that is remeshed."""
    places = [(0, 0, 0), (0, 4, 0), (3, 2, 0), (-3, 2, 1), (-3, 2, -1)]
    square = [(9, 0, 0), (13, 0, 0), (13, 4, 0), (9, 4, 0)]
    triangles = np.array([(0, 1, 2), (1, 0, 3), (1, 0, 4), (5, 6, 7), (5, 7, 8)], np.int32)
    part = np.array((0, 0, 0, 1, 1), np.int32)
    points, found, of = even_triangles(np.array(places + square, float), triangles, part, 0.5)
    _, uses = topology.edges(found[of == 0])
    assert (uses == 3).sum() == 8 and (points[found[of == 1]].min(axis=(0, 1)) == (9, 0, 0)).all()
    turns = topology.vector_areas(points, found[of == 1])
    assert turns.sum(axis=0) == pytest.approx((0, 0, 16)) and turns[:, 2].min() > 0


def test_divided_triangles_still_share_edges():
    points = np.array([(0, 0, 0), (4, 0, 0), (4, 1, 0), (0, 1, 0), (2, 0.5, 3)], float)
    triangles = np.array([(0, 1, 2), (0, 2, 3), (0, 2, 4)], np.int32)
    places, pieces, of = divided(points, triangles, 0.3)
    sides = places[pieces] - places[np.roll(pieces, -1, axis=1)]
    assert np.linalg.norm(sides, axis=2).max() <= 0.3
    _, uses = topology.edges(pieces)
    along = np.linalg.norm(points[2] - points[0])
    assert (uses == 3).sum() >= along / 0.3, "all three sheets have the edges of their seam"
    for row, whole in enumerate(topology.vector_areas(points, triangles)):
        found = topology.vector_areas(places, pieces[of == row]).sum(axis=0)
        np.testing.assert_allclose(found, whole, atol=0.5e-12)


def cantilever(tmp_path):
    """A plate of 100 by 100 by 2 as a file."""
    return write_off(tmp_path / "plate.off", block(100.0, 100.0, 2.0))


def run(*words):
    return cli.main(["midsurface", *map(str, words), "--quiet", "--samples", "4000"])


def test_files_and_figures(tmp_path, capsys):
    source = cantilever(tmp_path)
    for name in ("plate.obj", "plate.ply", "plate.stl"):
        assert run(source, tmp_path / name, "--json") == cli.DONE
    said = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert said["sheets"] == 1 and said["share_of_volume"] == pytest.approx(1.0, rel=0.005)
    lengths = np.loadtxt(tmp_path / "plate.csv", delimiter=",", skiprows=1)[:, 5]
    np.testing.assert_allclose(lengths, 2.0, rtol=1e-6)
    assert "g sheet1" in (tmp_path / "plate.obj").read_text()
    thick = write_off(tmp_path / "block.off", block(1.0, 0.9, 0.8))
    assert run(thick, tmp_path / "block.inp") == cli.INPUT


def test_triangles_that_two_facets_cut_off_alike_enclose_nothing():
    triangles = np.array(((0, 1, 2), (0, 2, 3), (2, 1, 0), (2, 0, 4)))
    assert thin_sheets._are_single(triangles).tolist() == [False, True, False, True]


def test_borders_of_many_pieces_are_their_own():
    """The numbers of the pairs of edge and piece do not fit into 32 bits here."""
    corner = np.arange(200 * 200).reshape(200, 200)[:-1, :-1].ravel()
    axis = SimpleNamespace(
        vertices=np.stack(np.divmod(np.arange(200 * 200), 200), axis=1).astype(float)
        @ np.eye(2, 3),
        face_offsets=np.arange(0, 4 * len(corner) + 1, 4, dtype=np.int32),
        face_vertices=np.add.outer(corner, (0, 1, 201, 200)).astype(np.int32).ravel(),
    )
    lengths = thin_sheets._borders(axis, np.arange(len(corner)), len(corner))
    np.testing.assert_array_equal(lengths, 4.0)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize("words, kind", (((), "S6"), (("--quads",), "S8R")))
def test_calculix_bends_a_plate_as_the_textbook_says(tmp_path, words, kind):
    """A cantilever beam: the end sinks by F l^3 / (3 E I); without a Poisson's ratio a plate is a beam."""
    assert run(cantilever(tmp_path), tmp_path / "plate.inp", "--size", "12", *words) == cli.DONE
    text = (tmp_path / "plate.inp").read_text().replace("210000., 0.3", "210000., 0.0")
    assert f"TYPE={kind}," in text and text.count("TYPE=") == 1
    rows = text[text.index("*NODE, NSET=NALL\n") : text.index("*ELEMENT")].splitlines()[1:]
    nodes = np.loadtxt(rows, delimiter=",")
    fixed = nodes[nodes[:, 1] < -49.999, 0].astype(int)
    end = nodes[nodes[:, 1] > 49.999]
    end = end[np.argsort(end[:, 2])]
    width = np.diff(end[:, 2])
    load = np.zeros(len(end))
    for at in range(0, len(end) - 1, 2):  # corner, middle, corner: as Simpson's rule
        load[at : at + 3] += np.array((1, 4, 1)) / 6 * width[at : at + 2].sum() / 100.0
    lines = ["*NSET, NSET=END", *(f"{int(node)}," for node in end[:, 0]), "*BOUNDARY"]
    lines += [f"{node}, 1, 6" for node in fixed]
    lines += ["*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{int(node)}, 3, {part:.12g}" for node, part in zip(end[:, 0], load, strict=True)]
    lines += ["*NODE PRINT, NSET=END", "U", "*END STEP", ""]
    (tmp_path / "job.inp").write_text(text + "\n".join(lines))
    subprocess.run(["ccx", "job"], cwd=tmp_path, check=True, capture_output=True, timeout=120)
    rows = [row.split() for row in (tmp_path / "job.dat").read_text().splitlines()]
    sunk = [float(row[3]) for row in rows if len(row) == 4 and row[0].isdigit()]
    assert np.mean(sunk) == pytest.approx(100.0**3 / (3 * 210000.0 * 100.0 * 2.0**3 / 12), rel=0.02)
