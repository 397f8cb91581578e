# SPDX-License-Identifier: GPL-3.0-or-later
"""Inside Decided By Wrap: faces that bound nothing get a closed surface, and radii are those up to the faces."""

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.axis.compute import compute, refilter
from medial_axis.core.settings import Between, SamplingMode, Settings, SidesFrom, ThicknessSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.thickness.thickness import measure_thickness
from support import topology
from support.meshes import icosphere, join, write_off
from support.thick_meshes import block

# Walls 0.05 apart.
WIDTHS = [
    (Between.WALL, block(1.0, 0.7, 0.05)),
    (Between.GAP, join(block(1.0, 0.7, 0.4), block(1.0, 0.7, 0.4, (0.0, 0.0, 0.45)))),
]


def settings(samples=3000, sides=SidesFrom.WRAP, **others):
    return Settings(sides=sides, samples=samples, sampling=SamplingMode.SURFACE, **others)


def torn(share=0.85, seed=3):
    """Some faces of a ball of radius 1, each apart, a bit out of place, and turned at random."""
    points, triangles = icosphere(3)
    random = np.random.default_rng(seed)
    kept = triangles[random.random(len(triangles)) < share]
    corners = points[kept] + random.normal(scale=0.01, size=(len(kept), 1, 3))
    turned = random.random(len(kept)) < 0.5
    corners[turned] = corners[turned][:, ::-1]
    return corners.reshape(-1, 3), np.arange(3 * len(kept)).reshape(-1, 3).astype(np.int32)


def test_the_wrap_is_closed_outward_and_at_its_distance(medial):
    points, triangles = torn()
    wrapped, faces = medial.wrap(points, triangles, 0.1, 0.005)
    assert medial.open_edges(wrapped, faces) == 0
    assert medial.solid_betti(wrapped, faces) == (1, 0, 0)
    assert topology.volume(wrapped, faces) > 4.0
    diagonal = np.linalg.norm(np.ptp(points, axis=0))
    away = medial.TriangleTree(points, triangles).distances(wrapped)
    assert np.median(away) == pytest.approx(0.005 * diagonal, rel=0.05)
    assert away.min() > 0.0045 * diagonal, "no face sticks out"


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e12])
def test_a_scale_changes_nothing_but_the_scale(medial, scale):
    points, triangles = torn()
    wrapped, faces = medial.wrap(points, triangles, 0.1, 0.005)
    other, same = medial.wrap(points * scale, triangles, 0.1, 0.005)
    assert len(same) == pytest.approx(len(faces), rel=0.05)
    assert np.ptp(other, axis=0) == pytest.approx(scale * np.ptp(wrapped, axis=0), rel=1e-3)


def test_a_soup_has_the_axis_of_its_ball():
    found = compute(*torn(), settings(wrap_opening=8.0))
    assert found.axis.level.betti == (1, 0, 0)
    assert found.settings.sides is SidesFrom.WRAP
    for words in ("a wrap of the faces", "closes openings of less than"):
        assert words in str(found.sides)
    largest = found.axis.radius.max()
    assert 0.9 < largest < 1.0, "up to the faces and not to the wrap"


def test_radii_are_those_up_to_the_faces():
    """A block, which needs no wrap: its largest ball has half its least extent, now and for other thresholds."""
    found = compute(*block(1.0, 0.7, 0.4), settings())
    assert found.axis.radius.max() == pytest.approx(0.2, rel=1e-3)
    again = refilter(found.key, settings(theta=0.7))
    assert again.radius.max() == pytest.approx(0.2, rel=1e-3)
    assert found.axis.structure.part_least_radius.max() <= found.axis.radius.max()


def test_the_same_faces_without_a_wrap_have_their_own_analysis():
    wrapped, plain = (
        compute(*block(1.0, 0.7, 0.4), settings(sides=sides))
        for sides in (SidesFrom.WRAP, SidesFrom.AUTOMATIC)
    )
    assert wrapped.key != plain.key and plain.axis.radius.max() == pytest.approx(0.2, rel=1e-9)


def test_the_command_line_wraps(tmp_path, capsys):
    source = write_off(tmp_path / "torn.off", torn())
    words = [str(source), str(tmp_path / "torn.ply"), "--sides", "wrap", "--wrap-opening", "8"]
    assert cli.main([*words, "--samples", "3000", "--sampling", "surface", "--json"]) == cli.DONE
    assert "a wrap of the faces" in (tmp_path / "torn.ply.json").read_text(encoding="utf-8")


@pytest.mark.parametrize("direction", [(0.0, 0.0, 0.7), (0.27, 0.33, -0.26)])
def test_faces_on_a_line_are_refused(medial, direction):
    """CGAL ends the process where no face has an area, and may never end where rounding alone gives one."""
    points = np.outer(np.sqrt(np.arange(6.0)), direction)
    with pytest.raises(medial.InvalidInputError, match="found none with an area"):
        medial.wrap(points, np.arange(6, dtype=np.int32).reshape(2, 3), 0.5, 0.025)


@pytest.mark.parametrize("seed", range(8))
def test_thin_soups_are_wrapped_or_refused(medial, seed):
    """Needles, flat and doubled faces, far apart or of one size, with numbers that are not round."""
    random = np.random.default_rng(seed)
    for _ in range(8):
        thin = 10.0 ** random.choice([-300, -30, -17, -9, -3, 0], size=3)
        points = random.normal(size=(12, 3)) * thin + random.choice([0.0, 1.0, 1e9])
        triangles = random.integers(0, len(points), size=(6, 3), dtype=np.int32)
        try:
            wrapped, faces = medial.wrap(points, triangles, 0.3, 0.015)
        except medial.InvalidInputError as refused:
            assert "found none with an area" in str(refused)
        else:
            assert np.isfinite(wrapped).all() and medial.open_edges(wrapped, faces) == 0


@pytest.mark.parametrize(("between", "mesh"), WIDTHS)
def test_lengths_are_those_between_the_faces(between, mesh):
    found = measure_thickness(Shape(*mesh), settings(4000), ThicknessSettings(between=between))
    facing = np.isfinite(found.lengths)
    assert facing.sum() > 200
    assert np.median(found.lengths[facing]) == pytest.approx(0.05, rel=5e-3)
    assert found.shape.offset > 0.01 * 0.05, "the walls of the wrap are elsewhere"
    assert sum("walls of the wrap" in sentence for sentence in found.warnings) == 1
