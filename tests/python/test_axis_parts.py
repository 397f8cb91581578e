# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets, seams, rims, junctions and corners of medial axes: counts that can be made by hand, and files."""

import csv

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.axis.structure import FIELDS
from medial_axis.core.axis.structure_table import counts_of, rows_of, summary_of
from medial_axis.core.axis.turning import with_facets_turned
from medial_axis.core.errors import ExportError
from medial_axis.core.files.load_axis import load_axis
from medial_axis.core.files.write import export_axis
from medial_axis.core.settings import Form, SamplingMode, Settings
from support import measure, meshes, plates

FLAT_TORUS = meshes.moved(meshes.torus(2.0, 0.7, 96, 48), scale=(1.0, 1.0, 0.5))
ELLIPSOID = meshes.moved(meshes.icosphere(4), scale=(3.0, 2.0, 1.0))
# sheets, seams, rims, creases, junctions, corners
SHAPES = {
    "box": (plates.box(), (13, 12, 0, 12, 4, 8)),
    "wedge": (plates.wedge(), (9, 7, 0, 9, 2, 6)),
    "holed plate": (plates.holed_plate(), (15, 13, 0, 14, 4, 8)),
    "bracket": (plates.bracket(), (16, 15, 0, 15, 5, 10)),
    "T": (plates.t_plate(), (21, 22, 0, 18, 8, 12)),
    "torus": (FLAT_TORUS, (1, 0, 2, 0, 0, 0)),
    "ellipsoid": (ELLIPSOID, (1, 0, 1, 0, 0, 0)),
}


def axis_of(mesh, count=4000, seed=0, **more):
    settings = Settings(sampling=SamplingMode.SURFACE, samples=count, seed=seed, **more)
    return compute(*mesh, settings).axis


@pytest.fixture(scope="module")
def boxed():
    return axis_of(plates.box())


@pytest.mark.oracle
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", [4000, 10000])
@pytest.mark.parametrize("name", SHAPES)
def test_counts_are_those_of_the_shape(name, count, seed):
    mesh, expected = SHAPES[name]
    assert tuple(counts_of(axis_of(mesh, count, seed).structure).values()) == expected


@pytest.mark.parametrize("seed", range(8))
def test_a_box_has_no_junction_too_many(seed):
    counts = counts_of(axis_of(plates.box(), 5000, seed).structure)
    assert tuple(counts.values()) == SHAPES["box"][1]


@pytest.mark.parametrize(("name", "room"), [("box", 1e-9), ("holed plate", 2e-2)])
def test_numbers_do_not_depend_on_the_samples(name, room):
    """The same number is the same sheet; its area is exact on flat faces, and chords of curved sheets miss a little."""
    first, *others = (
        rows_of(axis_of(SHAPES[name][0], count, seed).structure)
        for count, seed in ((4000, 0), (10000, 1), (7000, 2))
    )
    same = ("part", "patch_a", "patch_b", "neighbours", "seams", "rims", "creases")
    for other in others:
        for one, two in zip(first, other, strict=True):
            assert [one[name] for name in same] == [two[name] for name in same]
            assert one["area"] == pytest.approx(two["area"], rel=room)


def test_sheets_cover_the_axis_and_agree_with_their_patches(boxed):
    structure = boxed.structure
    assert set(structure.part.tolist()) == set(range(13))
    low, high = structure.part_patches.T
    assert (low < high).all() and len(set(zip(low.tolist(), high.tolist(), strict=True))) == 13
    assert np.array_equal(np.lexsort((high, low)), np.arange(13))


def test_edges_are_seams_where_their_facets_differ(boxed):
    structure, parts = boxed.structure, {}
    for part, ring in zip(structure.part.tolist(), measure.polygons(boxed), strict=True):
        for a, b in zip(ring.tolist(), np.roll(ring, -1).tolist(), strict=True):
            parts.setdefault((min(a, b), max(a, b)), []).append(part)
    assert sum(map(len, parts.values())) == len(boxed.face_vertices)
    assert [tuple(edge) for edge in structure.facet_edges.tolist()] == sorted(parts)
    for edge, seam in zip(sorted(parts), structure.seam.tolist(), strict=True):
        found = parts[edge]
        if len(found) == 1:
            assert seam in (2, 3)
        elif len(set(found)) > 1:
            assert seam == 1
        elif len(found) == 2:
            assert seam == 0


def test_turned_facets_agree_along_their_sheets(boxed):
    axis = with_facets_turned(boxed, boxed.structure.turned)
    used = {}
    for part, ring in zip(axis.structure.part.tolist(), measure.polygons(axis), strict=True):
        for edge in zip(ring.tolist(), np.roll(ring, -1).tolist(), strict=True):
            used.setdefault((part, edge), []).append(ring)
    assert all(len(found) == 1 for found in used.values())
    back = with_facets_turned(axis, boxed.structure.turned)
    assert np.array_equal(back.face_vertices, boxed.face_vertices)
    assert np.array_equal(back.generators, boxed.generators)


def squares(spacing):
    """Nine squares in a row between two patches, the middle one between the first and a third."""
    corners = 2 * np.arange(9)[:, None] + (0, 2, 3, 1)
    patches = np.tile(np.array([(0, -1), (1, -1)], np.int32), (9, 1))
    patches[9, 0] = 2
    return {
        "vertices": np.array([(x, y, 0.0) for x in range(10) for y in (0, 1)]),
        "radius": np.full(20, 10.0),
        "face_offsets": np.arange(0, 37, 4, dtype=np.int32),
        "face_vertices": corners.astype(np.int32).ravel(),
        "generators": np.arange(18, dtype=np.int32).reshape(-1, 2),
        "wires": np.empty((0, 2), np.int32),
        "patches": patches,
        "spacing": np.full(18, spacing),
    }


def test_crumbs_go_to_their_neighbours(medial):
    """One square is less than two squared spacings of 0.75."""
    assert medial.structure(**squares(0.5)).part_area.tolist() == [4.0, 4.0, 1.0]
    found = medial.structure(**squares(0.75))
    assert found.part_area.tolist() == [9.0] and not (found.seam == 1).any()
    rows = squares(0.5)["generators"]
    for wrong in (rows[:-1], np.where(rows == 1, 99, rows)):
        with pytest.raises(medial.InvalidInputError):
            medial.structure(**squares(0.5) | {"generators": wrong})


def test_patches_pass_reflex_edges_and_end_at_convex_ones(medial):
    points, triangles = plates.bracket()
    of_triangles, of_vertices = medial.surface_patches(points, triangles)
    assert of_triangles.max() == 6  # eight faces, two of which meet at the reflex edge
    assert len(np.unique(of_triangles)) == 7
    assert (of_vertices[3] >= 0).sum() == 2  # at the reflex edge, one side patch and a cap
    assert (of_vertices[0] == -1).all()  # a corner of three


def test_marked_edges_divide_and_a_larger_angle_unites(medial):
    points, triangles = plates.box()
    assert medial.surface_patches(points, triangles, sharp_angle=3.0)[0].max() == 0
    marked = np.array([(0, 1), (1, 2), (2, 3), (3, 0)], np.int32)
    divided, _ = medial.surface_patches(points, triangles, sharp_angle=3.0, sharp_edges=marked)
    assert divided.max() == 1


def test_only_clean_forms_have_a_structure():
    for form in (Form.PUBLISHED, Form.CURVE):
        assert axis_of(plates.box(), form=form).structure is None


def test_vertices_as_samples_have_patches():
    found = compute(*ELLIPSOID, Settings(sampling=SamplingMode.VERTICES))
    assert found.axis.structure.parts == 1
    assert found.chosen.samples.patches.max() == 0


def test_a_cloud_is_one_smooth_body():
    found = compute(ELLIPSOID[0], np.empty((0, 3), np.int32), Settings())
    assert tuple(counts_of(found.axis.structure).values()) == (1, 0, 1, 0, 0, 0)


# --- files


def test_npz_holds_the_structure(boxed, tmp_path):
    again = load_axis(export_axis(boxed, tmp_path / "a.npz"))
    for name in FIELDS:
        assert np.array_equal(getattr(again.structure, name), getattr(boxed.structure, name))


def test_csv_has_a_row_for_each_part(boxed, tmp_path):
    path = export_axis(boxed, tmp_path / "parts.csv", 2.0 * np.eye(4)[:3])
    with open(path, encoding="ascii", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [int(row["part"]) for row in rows] == list(range(13))
    areas = np.array([float(row["area"]) for row in rows])
    np.testing.assert_allclose(areas, 4.0 * boxed.structure.part_area, rtol=1e-15)
    assert rows[12]["neighbours"] == "2 3 5 6 8 9 10 11" and rows[12]["creases"] == ""


def test_an_axis_without_parts_has_no_table(tmp_path):
    with pytest.raises(ExportError, match="found one without"):
        export_axis(axis_of(plates.box(), form=Form.PUBLISHED), tmp_path / "parts.csv")
    assert not list(tmp_path.iterdir())


def test_ply_has_parts_and_kinds(boxed, tmp_path):
    content = export_axis(boxed, tmp_path / "a.ply").read_bytes()
    header, body = content.split(b"end_header\n", 1)
    assert b"property int part\n" in header and b"property int kind\n" in header
    vertex = [("at", "<f8", 3), ("radius", "<f8"), ("kind", "<i4"), ("place", "<i4")]
    rows = np.frombuffer(body, vertex, len(boxed.vertices))
    assert np.array_equal(rows["kind"], boxed.structure.kind)


def test_the_summary_names_curves_and_nodes(boxed):
    found = summary_of(boxed.structure)
    assert [curve["kind"] for curve in found["curves"]] == ["seam"] * 12 + ["crease"] * 12
    assert [node["kind"] for node in found["nodes"]] == ["junction"] * 4 + ["corner"] * 8
    assert all(len(node["curves"]) == 4 for node in found["nodes"])
    places = boxed.vertices[[node["vertex"] for node in found["nodes"][:4]]]
    exact = [(x, y, 0.5) for x in (0.5, 2.5) for y in (0.5, 1.5)]
    assert all(np.linalg.norm(places - place, axis=1).min() < 0.05 for place in exact)
