# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms in Blender: loose edges and vertices, attributes, sliders, files that come back, words about the topology."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import analyses, attribute, loose_edges, positions
from scene import compute, export, link, press, select, suzanne
from test_export_blender import READERS, imported


def pair():
    """Two slabs with a rod between them: sheets at both ends, and a curve from one to the other."""
    rings = [(-2.0, 0.6), (-1.2, 0.6), (-1.0, 0.1), (1.0, 0.1), (1.2, 0.6), (2.0, 0.6)]
    turns = np.linspace(0, 2 * np.pi, 32, endpoint=False)
    points = [
        (x, a * np.cos(t), (0.25 if a > 0.5 else 1.0) * a * np.sin(t))
        for x, a in rings
        for t in turns
    ]
    starts = range(0, 32 * len(rings) - 32, 32)
    steps = [(j, (j + 1) % 32) for j in range(32)]
    sides = [(i + j, i + k, i + k + 32, i + j + 32) for i in starts for j, k in steps]
    caps = [tuple(reversed(range(32))), tuple(range(32 * len(rings) - 32, 32 * len(rings)))]
    return link("Pair", points, [*sides, *caps])


def clean(**settings):
    """The axis of a pair."""
    usual = {"form": "CLEAN", "sampling": "SURFACE", "samples": 6_000, "smooth": False}
    return compute(pair(), **usual | settings)


def test_attributes_of_faces_and_of_loose_edges():
    mesh = clean().data
    edges = loose_edges(mesh)
    assert len(mesh.polygons) > 50 and len(edges) > 5
    limb = attribute(mesh, "ma_limb")
    assert len(limb) == len(mesh.edges)
    assert (limb[: -len(edges)] == 0).all() and (limb[-len(edges) :] > 4.0).all()
    for name in ("ma_sheet", "ma_erosion"):
        values = attribute(mesh, name)
        assert len(values) == len(mesh.polygons) and (values > 0).all()
    assert (attribute(mesh, "ma_erosion") <= attribute(mesh, "ma_sheet")).all()
    moved = np.linalg.norm(attribute(mesh, "ma_exact") - positions(mesh), axis=1)
    assert moved.max() < 0.2 and len(attribute(mesh, "ma_exact_radius")) == len(mesh.vertices)
    assert mesh.validate() is False


def test_what_is_read_back_is_what_was_computed():
    result = clean()
    settings = addon("bridge.axis.axis_object").settings_of(result)
    axis = addon("core.axis.compute").refilter(result["ma_analysis"], settings)
    again = addon("bridge.axis.read_axis").read_axis(result)
    for name in ("face_offsets", "face_vertices", "generators", "edges", "side"):
        assert np.array_equal(getattr(again, name), getattr(axis, name)), name
    for name in ("exact", "exact_radius", "sheet", "erosion"):
        expected = getattr(axis.level, name).astype(np.float32)
        expected = np.minimum(expected, np.finfo(np.float32).max)
        assert np.array_equal(getattr(again.level, name).astype(np.float32), expected), name
    assert again.level.betti == axis.level.betti == (1, 0, 0)
    assert len(again.level.limb) == len(again.edges)


def test_form_and_its_sliders_act_at_once_without_another_analysis():
    result, panel, before = clean(), bpy.context.scene.medial_axis, analyses()
    facets = len(result.data.polygons)
    panel.erode = 1.0
    eroded = len(result.data.polygons)
    assert 0 < eroded != facets and result["ma_erode"] == 1.0
    panel.erode = 0.0
    assert len(result.data.polygons) == facets
    panel.simplify = 50.0
    assert len(result.data.polygons) == 0 and len(result.data.edges) > 0
    panel.simplify = 0.0
    panel.form = "CURVE"
    assert len(result.data.polygons) == 0 and tuple(result["ma_betti"]) == (1, 0, 0)
    curve = len(result.data.vertices)
    panel.limb = 60.0
    assert len(result.data.vertices) < curve
    panel.form = "PUBLISHED"
    assert "ma_sheet" not in result.data.attributes and "ma_betti" not in result
    assert result["ma_topology"] == "" and len(loose_edges(result.data)) == 0
    panel.form, panel.limb = "CLEAN", 4.0
    assert len(result.data.polygons) == facets and "as the solid" in result["ma_topology"]
    panel.theta = 1.0  # another hierarchy of the same analysis
    assert panel.note == "" and result["ma_theta"] == pytest.approx(1.0)
    assert analyses() == before


def test_detail_of_a_curve_acts_at_once():
    result, panel = clean(samples=2_000, smooth=True), bpy.context.scene.medial_axis
    before = analyses()
    panel.form, panel.limb = "CURVE", 0.0
    whole = positions(result.data)
    panel.detail = 0.0
    skeleton = positions(result.data)
    assert 2 < len(skeleton) < len(whole) / 2 and tuple(result["ma_betti"]) == (1, 0, 0)
    points = sum(len(spline.points) for spline in press("medial_axis_to_curve").data.splines)
    assert len(skeleton) <= points < len(whole) / 2, "what is seen is converted"
    select(bpy.data.objects["Pair"])
    panel.detail = 1.0
    assert np.array_equal(positions(result.data), whole) and analyses() == before
    del result["ma_detail"]  # as of a version without it
    assert addon("bridge.axis.axis_object").settings_of(result).detail == 1.0


# --- files


@pytest.mark.parametrize(("suffix", "operator", "options"), READERS)
def test_importers_of_blender_read_the_edges(tmp_path, suffix, operator, options):
    mesh, path = clean().data, tmp_path / f"axis{suffix}"
    export(path)
    again = imported(operator, path, **options).data
    assert (len(again.polygons), len(again.edges)) == (len(mesh.polygons), len(mesh.edges))
    ours, theirs = positions(mesh), positions(again)

    def ends(edges, where):
        rounded = np.round(where[edges], 4) + 0.0
        return sorted(tuple(sorted(map(tuple, pair))) for pair in rounded.tolist())

    assert ends(loose_edges(again), theirs) == ends(loose_edges(mesh), ours)


def test_a_sequence_plays_with_its_edges(tmp_path):
    mesh, path = clean().data, tmp_path / "Pair_0001.npz"
    export(path)
    write_sequence = addon("bridge.skeleton.sequence_objects").write_sequence
    (thing,) = write_sequence("Pair", {1: path}).objects
    assert len(loose_edges(thing.data)) == len(loose_edges(mesh)) > 0
    assert np.array_equal(positions(thing.data), positions(mesh))
    assert np.array_equal(attribute(thing.data, "ma_limb"), attribute(mesh, "ma_limb"))


@pytest.mark.parametrize("smooth", [False, True], ids=["flat", "smooth"])
@pytest.mark.parametrize("levels", [0, 2, pytest.param(3, marks=pytest.mark.slow)])
def test_suzanne_is_one_piece(levels, smooth):
    """One click; her eyes and their sockets are open, and have sharp rims where she is not subdivided."""
    suzanne(levels)
    if smooth:
        bpy.ops.object.shade_smooth()
    result = press("medial_axis")
    assert tuple(result["ma_betti"]) == (1, 0, 0)
    assert result["ma_topology"].startswith("1 piece, no loop, no cavity")
    mesh = result.data
    loose = set(range(len(mesh.vertices))) - {v for edge in mesh.edges for v in edge.vertices}
    assert not loose and len(mesh.polygons) > 2000
