# SPDX-License-Identifier: GPL-3.0-or-later
"""Every mesh has a defined outcome: an axis inside the solid, a warning that says what was assumed, or one sentence.

Whether a vertex of the axis is outside is judged by crossings of a ray, for meshes that are closed.
"""

import numpy as np
import pytest
from medial_axis.core.errors import DegenerateInputError, InvalidInputError
from medial_axis.core.settings import SamplingMode, SidesFrom
from support import crossings, distance, messy, resampled, spikes
from support.levels import facet_pieces

pytestmark = pytest.mark.oracle

SMALL = [name for name in (*messy.CLOSED, *messy.OPEN) if name not in messy.LARGE]
HUGE = [pytest.param(name, marks=pytest.mark.slow) for name in messy.CLOSED if name in messy.LARGE]
SOLID = (
    "soup of a torus",
    "doubled faces",
    "crossing boxes",
    "overlapping balls",
    "nested shell",
    "rocker arm, every face alone",
)
LONG, FEW = 0.5, 0.002  # of the radius where it begins; share of the vertices
LONGEST = 2.0
LEAST = {"human_woman.obj": 1000}  # facets; its skin has folds, where it crosses itself


@pytest.fixture(scope="module")
def computed(data_file):
    cache = {}

    def compute(name, **options):
        key = (name, *options.values())
        if key not in cache:
            mesh = messy.load(name, data_file)
            cache[key] = mesh, resampled.by_the_addon(mesh, **options)
        return cache[key]

    return compute


def faces_of(mesh, result):
    """The faces that were sampled: those of noisy faces, as a voxel scan has, are moved onto smooth surfaces."""
    if not any("their vertices were moved" in text for text in result.warnings):
        return mesh
    shape = result.chosen.samples.solid.shape
    assert (shape.triangles == mesh[1]).all()
    return shape.points, shape.triangles


def assert_inside(axis, mesh):
    """All vertices, but for those on the surface itself up to rounding."""
    outside = ~crossings.inside(axis.vertices, *mesh)
    if outside.any():
        away = distance.to_triangles(axis.vertices[outside], mesh[0][mesh[1]])
        assert (away <= 1e-6 * axis.radius[outside]).all(), (outside.sum(), away.max())


def assert_no_spike(result):
    """Single flakes at creases may lie apart; a spike is longer, or there are more of them."""
    samples = result.chosen.samples
    length = spikes.lengths(result.axis, samples.points)
    where = spikes.worst(result.axis, samples.points, samples.kinds, length)
    assert np.mean(length > LONG) < FEW and length.max() < LONGEST, where


def assert_sentences(result):
    assert all(len(text) > 20 and "\n" not in text for text in result.warnings)


@pytest.mark.parametrize("name", [*SMALL, *HUGE])
def test_files(medial, computed, name):
    mesh, result = computed(name)
    assert result.axis.facets > LEAST.get(name, 100)
    assert result.chosen.reason and result.sides.reason
    assert_sentences(result)
    if medial.open_edges(*mesh) == 0:
        assert result.sides.source is SidesFrom.SURFACE
        assert_inside(result.axis, faces_of(mesh, result))


@pytest.mark.parametrize("name", SOLID)
def test_closed_solids(medial, computed, name):
    mesh, result = computed(name)
    assert medial.open_edges(*mesh) == 0
    assert result.axis.facets > 100
    assert_inside(result.axis, mesh)
    assert_no_spike(result)
    assert_sentences(result)


@pytest.mark.parametrize(
    "name", ["mannequin.off", "spot_low.obj", "rocker-arm.off", "hand_closed.obj"]
)
def test_no_long_spike_on_smooth_meshes(computed, name):
    _, result = computed(name, sampling=SamplingMode.SURFACE)
    assert_no_spike(result)


def test_holes_in_the_mannequin(medial, computed):
    """Open at the holes, which is said; the axis stays near that of the whole head."""
    mesh, result = computed("mannequin with holes")
    whole, _ = computed("mannequin.off")
    assert medial.open_edges(*mesh) > 50
    assert result.axis.facets > 1000 and "open" in result.sides.reason + " ".join(result.warnings)
    outside = ~crossings.inside(result.axis.vertices, *whole)
    assert outside.mean() < 0.01


def test_an_elephant_with_holes_and_duplicates(medial, computed):
    mesh, result = computed("elephant-with-holes.off")
    assert len(np.unique(mesh[0], axis=0)) < len(mesh[0])
    assert medial.open_edges(*mesh) > 100 and result.axis.facets > 1000
    assert "open" in result.sides.reason + " ".join(result.warnings)


def test_loose_vertices_of_the_bunny_are_no_samples(computed):
    """They belong to no face; when faces are sampled they are left out, and that is said."""
    mesh, result = computed("stanford-bunny.obj", sampling=SamplingMode.SURFACE)
    loose = len(mesh[0]) - len(np.unique(mesh[1]))
    assert loose == 1113
    assert any(f"{loose:,}" in text for text in result.warnings)


def test_components_of_the_engine(computed):
    """The axis has a piece in each of the 7 parts that is large enough to be sampled."""
    assert facet_pieces(computed("engine_parts.ply")[1].axis) >= 4


def test_walls_inside_the_openscad_part_bound_nothing(computed):
    """Two solids run through each other; what is inside of both is no surface, and that is said."""
    mesh, result = computed("openscad-nonmanifold-crash.obj")
    assert result.axis.facets > 500
    assert_inside(result.axis, mesh)
    assert any("overlap" in text for text in result.warnings)


def test_a_box_in_a_box_is_not_seen(computed):
    """Winding number 2 is inside, too: only the outer box counts."""
    mesh, result = computed("box in a box", sampling=SamplingMode.SURFACE)
    _, alone = computed("crossing boxes", sampling=SamplingMode.SURFACE)
    points = result.chosen.samples.points
    assert (np.abs(points / (1.0, 0.7, 0.4)).max(axis=1) > 0.999).all()
    assert any("overlap" in text for text in result.warnings) and alone.axis.facets > 100
    assert_inside(result.axis, mesh)


def test_a_ball_on_a_ball_is_one(computed):
    _, twice = computed("ball on a ball", sampling=SamplingMode.SURFACE)
    assert_inside(twice.axis, messy.MADE["ball on a ball"]())


def test_a_thin_sheet(computed):
    """Its walls are a hundredth of the spacing apart: an axis between them, or one sentence; never one outside."""
    mesh, result = computed("thin sheet", sampling=SamplingMode.SURFACE)
    assert_inside(result.axis, mesh)
    assert result.axis.facets > 0 or result.warnings


@pytest.mark.parametrize("name", ["two grids", "open box"])
def test_open_meshes_say_so(medial, computed, name):
    mesh, result = computed(name, sampling=SamplingMode.SURFACE)
    assert medial.open_edges(*mesh) > 0
    assert "open" in result.sides.reason + " ".join(result.warnings)
    assert_sentences(result)


@pytest.mark.parametrize("name", ["some flipped", "inside out"])
def test_faces_that_look_inward_are_read_outward(medial, computed, name):
    """The axis is that of the faces as they should look, and a sentence says how many looked inward."""
    mesh, result = computed(name, sampling=SamplingMode.SURFACE)
    assert result.sides.source is SidesFrom.SURFACE
    assert result.sides.reason == "the faces are closed"
    assert result.axis.facets > 100
    assert any("looked inward" in text for text in result.warnings)
    assert_inside(result.axis, (mesh[0], medial.outward_faces(*mesh)[0]))


@pytest.mark.parametrize("name", ["sheet from both sides", "one triangle"])
def test_what_has_no_volume_is_refused_in_one_sentence(computed, name):
    with pytest.raises((DegenerateInputError, InvalidInputError)) as caught:
        computed(name)
    text = str(caught.value)
    assert len(text) > 30 and "\n" not in text and "Traceback" not in text
