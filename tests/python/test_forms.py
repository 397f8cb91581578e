# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms of the axis without Blender: which settings act, what is cached, what is said of the topology, files."""

import json
from dataclasses import replace
from types import SimpleNamespace

import medial_axis
import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.axis.axis_warnings import axis_warnings
from medial_axis.core.axis.compute import compute_axis, refilter, refiltered_topology
from medial_axis.core.axis.known_box import _CORNERS, _TRIANGLES
from medial_axis.core.axis.levels import hierarchy_of
from medial_axis.core.axis.topology import _why, betti_words
from medial_axis.core.machine.cache import CACHE, bytes_of
from medial_axis.core.samples.levels import Levels
from medial_axis.core.settings import (
    OPTIONS,
    Form,
    Rule,
    SamplingMode,
    Settings,
    Side,
    SidesFrom,
    applies_to_form,
)
from medial_axis.core.shape.shape import Shape
from support.meshes import flip, icosphere, join, moved, torus
from support.messy import soup
from support.same_axis import same_axis

NONE = np.zeros((0, 3), np.int32)


def mesh_of(*parts):
    """One shape of several meshes."""
    return Shape(*join(*parts))


def box(x=0.0, size=(1.0, 1.0, 1.0)):
    return moved((_CORNERS, _TRIANGLES), (x, 0, 0), size)


def computed(shape, **options):
    settings = {"sampling": SamplingMode.SURFACE, "samples": 4_000, "smooth": False} | options
    return compute_axis(shape, Settings(**settings))


BALL, TORUS = icosphere(4), torus()
SHAPES = {  # pieces, loops and cavities of the solid, and whether its faces say the same
    "box": (mesh_of(box()), (1, 0, 0), True),
    "ball": (mesh_of(BALL), (1, 0, 0), True),
    "torus": (mesh_of(TORUS), (1, 1, 0), True),
    "two boxes": (mesh_of(box(), box(3.0)), (2, 0, 0), True),
    "shell": (mesh_of(BALL, flip(moved(BALL, scale=0.5))), (1, 0, 1), True),
    "boxes that overlap": (mesh_of(box(), box(0.53, (1.0, 0.8, 0.7))), (1, 0, 0), False),
}


# --- topology


@pytest.mark.parametrize("form", [Form.CLEAN, Form.CURVE])
@pytest.mark.parametrize("name", SHAPES)
def test_topology_is_that_of_the_solid_and_said(name, form):
    shape, betti, agrees = SHAPES[name]
    found = computed(shape, form=form)
    assert found.axis.level.betti == betti
    judge = "as the solid" if agrees else "by the samples; by its faces it would be"
    assert found.topology.startswith(f"{betti_words(betti)}, {judge}")
    assert ("as the solid" in found.topology) is agrees
    if not agrees:
        assert found.topology.endswith("2 pieces, no loop, no cavity: its parts overlap")


def test_a_wall_thinner_than_the_spacing_is_said():
    """Two boxes a tenth of a spacing apart are one piece to the samples."""
    shape = mesh_of(box(), box(1.004))
    found = computed(shape, samples=2_000)
    assert found.axis.level.betti[0] == 1
    assert "by its faces it would be 2 pieces" in found.topology
    assert "thinner than the spacing" in found.topology


def test_words_of_the_topology():
    assert betti_words((1, 5, 0)) == "1 piece, 5 loops, no cavity"
    assert betti_words((2, 1, 1)) == "2 pieces, 1 loop, 1 cavity"
    assert betti_words((1234, 0, 7)) == "1,234 pieces, no loop, 7 cavities"


@pytest.mark.parametrize("name", SHAPES)
def test_betti_numbers_by_faces(medial, name):
    shape, betti, agrees = SHAPES[name]
    expected = betti if agrees else (2, 0, 0)
    assert medial.solid_betti(shape.points, shape.triangles) == expected
    order = np.random.default_rng(0).permutation(len(shape.triangles))
    alone = soup((shape.points, shape.triangles[order]))
    assert medial.solid_betti(*alone) == expected


def test_betti_numbers_need_faces_of_these_points(medial):
    """Open, pinched and flat surfaces, which have none: tests/native/solid_test.cpp."""
    points, triangles = BALL
    assert medial.solid_betti(points, NONE) is None
    with pytest.raises(medial.InvalidInputError, match="Expected triangle corners below"):
        medial.solid_betti(points, triangles + 1)


# --- what an axis is


def test_theta_rho_and_side_of_facets_are_those_of_the_analysis():
    for rule in Rule:
        found = computed(SHAPES["box"][0], rule=rule)
        axis, analysis = found.axis, found.chosen.samples.analysis
        rows = {tuple(edge): row for row, edge in enumerate(analysis.edges.tolist())}
        at = [rows[tuple(pair)] for pair in axis.generators.tolist()]
        theta = analysis.theta_both if rule is Rule.BOTH else analysis.theta
        assert np.array_equal(axis.theta, theta[at])
        assert (axis.side == 1).all() and axis.facets > 100


def test_published_is_what_the_module_extracts(medial):
    found = computed(SHAPES["box"][0], form=Form.PUBLISHED)
    mesh = found.chosen.samples.analysis.extract(side=medial.Side.INNER)
    for name in ("vertices", "radius", "face_offsets", "face_vertices", "theta", "generators"):
        assert np.array_equal(getattr(found.axis, name), getattr(mesh, name))
    assert found.axis.level is None and len(found.axis.edges) == 0 and found.topology == ""


# --- settings


def test_forms_of_one_computation_share_one_analysis_and_one_hierarchy():
    shape = SHAPES["box"][0]
    found = computed(shape)
    samples, before = found.chosen.samples, CACHE.analyses
    hierarchy = hierarchy_of(samples, found.settings, None)
    curve = medial_axis.extract(found, form="curve", limb=1.0)
    assert curve.facets == 0 and len(curve.edges) > 0
    assert hierarchy_of(samples, found.settings, None) is hierarchy
    again = computed(shape, erode=2.0)
    assert again.chosen.samples.kept is samples.kept and CACHE.analyses == before
    assert same_axis(again.axis, medial_axis.extract(found, erode=2.0))
    medial_axis.extract(found, theta=1.0, rho=20.0, limb=9.0)  # levels of the even mesh
    assert hierarchy_of(samples, found.settings, None) is hierarchy
    medial_axis.extract(found, theta=0.2)
    assert hierarchy_of(samples, found.settings, None) is not hierarchy


class Replaced(Levels):
    """Levels whose hierarchy another thread drops as soon as it has been read."""

    @property
    def _newest(self):
        newest, self._next = self._next, None
        return newest

    @_newest.setter
    def _newest(self, newest):
        self._next = newest


def test_a_hierarchy_is_returned_whatever_another_thread_does():
    found = computed(SHAPES["box"][0])
    analysis, levels = found.chosen.samples.analysis, Replaced()
    first = levels.hierarchy(analysis, found.settings, None)
    assert levels.hierarchy(analysis, found.settings, None) is first
    assert levels.bytes == 0
    levels.hierarchy(analysis, found.settings, None)
    assert levels.bytes == first.bytes


def test_the_cache_counts_the_hierarchy():
    CACHE.clear()  # else it may be full and drop others
    found = computed(mesh_of(box(0.0, (1.0, 0.9, 0.8))), form=Form.PUBLISHED)
    before, alone = CACHE.bytes, bytes_of(found.chosen.samples)
    axis = refilter(found.key, Settings(side=Side.INNER))
    grown = bytes_of(found.chosen.samples) - alone
    assert grown > 100_000 and CACHE.bytes == before + grown
    sentence = refiltered_topology(found.key, axis, Form.CLEAN)
    assert sentence == "1 piece, no loop, no cavity, as the solid"


@pytest.mark.parametrize("side", [Side.OUTER, Side.BOTH])
@pytest.mark.parametrize("form", [Form.CLEAN, Form.CURVE])
def test_other_sides_are_as_published_and_said(side, form):
    shape = SHAPES["torus"][0]
    found = computed(shape, side=side, form=form)
    published = computed(shape, side=side, form=Form.PUBLISHED)
    assert same_axis(found.axis, published.axis) and found.settings.form is Form.PUBLISHED
    name = OPTIONS["form"].items[form][0]
    assert found.topology == f"Form Raw: {name} is for the inner axis only"
    assert found.warnings == published.warnings


def test_what_applies_to_a_form():
    acts = {
        form: {name for name in ("simplify", "erode", "spike", "limb", "detail", "crisp", "limit_set", "theta")
               if applies_to_form(name, form)}
        for form in Form
    }  # fmt: skip
    assert acts[Form.CLEAN] == {"simplify", "erode", "spike", "limb", "crisp", "theta"}
    assert acts[Form.PUBLISHED] == {"limit_set", "theta"}
    assert acts[Form.CURVE] == {"limb", "detail", "crisp", "theta"}


@pytest.mark.parametrize(
    ("chosen", "possible", "of_faces"),
    [
        ({}, True, ("sharp_angle", "smooth")),
        ({"crisp": False}, True, ("sharp_angle",)),
        ({"form": Form.CURVE}, True, ("sharp_angle", "smooth")),
        ({"form": Form.CURVE, "crisp": False}, True, ()),
        ({"form": Form.PUBLISHED}, False, ()),
        ({"side": Side.OUTER}, False, ()),
        ({"sides": SidesFrom.SURFACE}, True, ("sharp_angle", "smooth")),
        ({"sides": SidesFrom.NORMALS}, False, ("sharp_angle",)),
        ({"sides": SidesFrom.TIGHT_COCONE}, False, ("sharp_angle",)),
        ({"sides": SidesFrom.POLES}, False, ("sharp_angle",)),
    ],
)
def test_where_crisp_matters(chosen, possible, of_faces):
    settings = Settings(**chosen)
    assert settings.crisp_is_possible == possible
    assert settings.options_of_faces == of_faces


@pytest.mark.parametrize("form", [Form.CLEAN, Form.CURVE])
def test_normals_that_decide_leave_nothing_crisp(form):
    points, faces = BALL
    shape = Shape(points * (3.0, 2.0, 1.0), faces, points * (1 / 3, 1 / 2, 1))
    settings = Settings(form=form, sides=SidesFrom.NORMALS, sampling=SamplingMode.VERTICES)
    on, off = (compute_axis(shape, replace(settings, crisp=x)).axis for x in (True, False))
    assert same_axis(on, off) and not on.level.place.any()


def test_crisp_switches_without_another_analysis():
    """The slider shows what a computation with these settings gives, whichever way it was switched before."""
    found = {crisp: computed(SHAPES["box"][0], crisp=crisp) for crisp in (True, False)}
    assert found[True].key == found[False].key
    assert found[True].axis.level.is_crisp.mean() > 0.99
    assert not found[False].axis.level.is_crisp.any()
    for crisp in (True, False, True):
        axis = refilter(found[True].key, replace(found[True].settings, crisp=crisp))
        assert same_axis(axis, found[crisp].axis), crisp
        assert same_axis(medial_axis.extract(found[not crisp], crisp=crisp), axis), crisp


@pytest.mark.parametrize(("share", "warned"), [(0.35, False), (0.45, True)])
def test_many_refused_places_are_a_warning(share, warned):
    found, shape = computed(SHAPES["box"][0]), SHAPES["box"][0]
    place = np.full(len(found.axis.vertices), 2, np.int32)
    place[: int(share * len(place))] = 1
    axis = replace(found.axis, level=replace(found.axis.level, place=place))
    said = list(axis_warnings(shape, found.settings, found.chosen, axis))
    assert any("45 % of the vertices no ball fits" in warning for warning in said) == warned
    assert len(said) == warned


@pytest.mark.parametrize("name", ["sharp_angle", "smooth"])
def test_vertices_are_computed_again_for_other_faces(name):
    """Crisp places of vertices depend on what the faces are; each computation has its own."""
    stretched = Shape(*moved(BALL, scale=(3.0, 2.0, 1.0)))
    others = {"sharp_angle": 0.05, "smooth": False}
    settings = Settings(sampling=SamplingMode.VERTICES, sides=SidesFrom.SURFACE)
    changed = replace(settings, **{name: others[name]})
    first, second = (compute_axis(stretched, wanted).axis for wanted in (settings, changed))
    assert not np.array_equal(first.vertices, second.vertices)
    CACHE.clear()
    assert same_axis(compute_axis(stretched, changed).axis, second)
    assert same_axis(compute_axis(stretched, settings).axis, first)


# --- command line


def test_words_of_the_command_line(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shape = mesh_of(TORUS)
    np.savez("ring.npz", points=shape.points, triangles=shape.triangles)
    words = ["ring.npz", "ring_axis.npz", "--sampling", "surface", "--samples", "4000", "--json"]
    reports = {}
    for form, more in {"clean": ["--limb", "2"], "published": [], "curve": []}.items():
        assert cli.main([*words, "--form", form, *more]) == cli.DONE
        reports[form] = json.loads(capsys.readouterr().out)
    assert [reports[form]["form"] for form in reports] == list(reports)
    assert reports["clean"]["betti"] == reports["curve"]["betti"] == [1, 1, 0]
    assert reports["clean"]["betti_by_faces"] == [1, 1, 0]
    assert reports["clean"]["places"] == "All balls end at the samples"  # a curve is fitted
    assert reports["clean"]["refused"] == 0 and reports["published"]["refused"] is None
    assert reports["clean"]["settings"]["crisp"] is True
    assert reports["published"]["betti"] is None and reports["published"]["topology"] == ""
    assert reports["clean"]["topology"] == "1 piece, 1 loop, no cavity, as the solid"
    assert reports["clean"]["edges"] > 0 == reports["clean"]["facets"]
    assert reports["published"]["facets"] > 0 == reports["published"]["edges"]
    assert reports["clean"]["settings"]["limb"] == 2.0
    assert len({report["stamp"] for report in reports.values()}) == 3
    assert len(medial_axis.read_axis("ring_axis.npz").edges) == reports["curve"]["edges"]


def test_an_axis_of_as_many_pieces_as_the_faces_is_not_torn():
    samples = SimpleNamespace(buried=0, solid=None)
    assert _why((1, 0, 0), (1, 1, 0), samples).startswith("walls or gaps are thinner")
    assert _why((2, 0, 0), (1, 0, 0), samples).startswith("some parts are thinner")


def test_a_single_body_is_not_said_to_overlap():
    shape = SimpleNamespace(is_folded=True, crossing=[])
    samples = SimpleNamespace(buried=3, solid=SimpleNamespace(shape=shape))
    assert _why((1, 3, 0), (1, 0, 0), samples).startswith("faces fold back on each other")
    shape.is_folded = False
    assert _why((1, 3, 0), (1, 0, 0), samples).startswith("walls or gaps are thinner")
    assert _why((1, 3, 0), (2, 0, 0), samples) == "its parts overlap"
    assert _why((3, 0, 0), (2, 0, 0), samples).startswith("its parts overlap, and some")
    shape.crossing = [(0, 1)]
    assert _why((1, 3, 0), (1, 0, 0), samples) == "faces pass through each other"
