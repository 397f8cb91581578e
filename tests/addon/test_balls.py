# SPDX-License-Identifier: GPL-3.0-or-later
"""Cover with Balls: the object that is made, its figures, undo, and files of it."""

import json

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, contents, evaluated, instances, positions, reports
from scene import compute, ellipsoid, export, press, refuse_export, select, torus


def balls_of(source):
    return addon("bridge.balls_object").balls_of(source)


def cover(*source, **options):
    """The balls of a source or of the selection, by its vertices if nothing else is said."""
    return press("medial_axis_balls", *source, **{"sampling": "VERTICES"} | options)


def spheres(thing):
    """How many spheres of 42 vertices the modifier makes."""
    return len(evaluated(thing).vertices) / 42


def test_balls_of_an_ellipsoid(capfd):
    source = ellipsoid()
    source.location, source.rotation_euler, source.scale = (3, 1, 2), (0.3, 0.2, 0.1), (2, 2, 2)
    reports(capfd)
    made = cover(source, count=20)
    text = reports(capfd)[-1][1]
    assert made == balls_of(source) and made.parent == source
    assert len(made.data.vertices) == 20 == spheres(made)
    assert "20 balls" in text and f"{100 * made['ma_balls_covered']:.1f} % of the volume" in text
    assert made["ma_balls_outside"] == 0.0 < made["ma_balls_farthest"]
    radii = attribute(made.data, "ma_radius")
    assert 0.9 < radii[0] < 1.01  # the middle of the ellipsoid, twice 0.5
    assert np.allclose(made.matrix_world @ made.data.vertices[0].co, source.location, atol=0.25)


def test_spheres_have_the_colours_of_their_radii():
    torus()
    made = cover(count=6)
    core, shown = addon("core.axis.colours"), evaluated(made)
    radius = attribute(made.data, "ma_radius").astype(float)
    expected = core.colours(radius, *core.radius_range(radius))
    away = np.linalg.norm(positions(shown)[:, None] - positions(made.data)[None], axis=2)
    own = np.argmin(np.abs(away - radius), axis=1)  # on whose sphere a vertex lies
    np.testing.assert_allclose(attribute(shown, "ma_color"), expected[own], atol=1e-5)


def test_it_is_updated_in_place():
    source = torus()
    made = cover(count=5)
    name, before = made.name, contents()
    made.modifiers[0].show_viewport = False
    assert cover(made, count=9).name == name, "the balls stand for their source"
    assert contents() == before
    assert len(balls_of(source).data.vertices) == 9 and not made.modifiers[0].show_viewport


def test_balls_are_written(tmp_path, capfd):
    source = torus()
    source.location = (1, 2, 3)
    made = cover(source, count=7)
    path = tmp_path / "torus.json"
    export(path)
    assert reports(capfd)[-1][1] == "Wrote 7 balls to 'torus.json'"
    known = json.loads(path.read_text())
    assert known["covered"] == made["ma_balls_covered"] and len(known["balls"]) == 7
    first = np.array(known["balls"][0]["centre"])
    assert np.allclose(first, made.matrix_world @ made.data.vertices[0].co)
    made.data.vertices[0].co.x += 1.0  # the figures are of other balls now
    export(path)
    known = json.loads(path.read_text())
    assert known["covered"] is known["outside"] is known["farthest"] is None
    assert known["balls"][0]["centre"][0] == pytest.approx(first[0] + 1.0)


def test_an_axis_is_written_as_balls(tmp_path):
    source, path = torus(), tmp_path / "torus.ma"
    axis = compute(side="INNER", select_result=False)
    export(path, balls=6, mode="AROUND")
    rows = np.loadtxt(path, skiprows=1, usecols=(1, 2, 3, 4))
    made = cover(count=6, mode="AROUND")
    world = positions(made.data) @ np.array(made.matrix_world)[:3, :3].T
    assert np.allclose(rows, np.column_stack([world, attribute(made.data, "ma_radius")]), atol=1e-5)
    select(axis)
    refuse_export(".mjcf or .xml, found 'a.ply'", tmp_path / "a.ply", balls=6)
    refuse_export("found 'a.json'", tmp_path / "a.json")
    bpy.data.objects.remove(source)
    refuse_export("found that it is gone", path, balls=6)


def test_the_spheres_are_the_balls():
    source = ellipsoid()
    made = cover(count=1)
    inputs = addon("bridge.nodes.inputs")
    inputs.set_inputs(made.modifiers[0], {"Subdivisions": 5, "Coloured": False})
    assert np.allclose(instances(made), [3 * [attribute(made.data, "ma_radius")[0]]], rtol=1e-5)
    assert source.data.users == 1


def test_capsules_are_edges_shown_as_tubes(capfd):
    source = torus()
    reports(capfd)
    made = cover(count=9, shapes="CAPSULES")
    count = len(made.data.edges)
    assert 3 <= count <= 9 and f"{count} capsules" in reports(capfd)[-1][1]
    radii = attribute(made.data, "ma_radius")
    ends = np.array([edge.vertices[:] for edge in made.data.edges])
    assert (radii[ends[:, 0]] == radii[ends[:, 1]]).all()
    assert made["ma_balls_outside"] == 0.0 < made["ma_balls_covered"]
    tube = positions(evaluated(made))
    middles = positions(made.data)
    wanted = (middles - radii[:, None]).min(axis=0), (middles + radii[:, None]).max(axis=0)
    assert np.allclose((tube.min(axis=0), tube.max(axis=0)), wanted, atol=0.02)  # whole spheres
    half = tube[:, None] - middles[ends].mean(axis=1)[None]
    assert (np.linalg.norm(half, axis=2).min(axis=0) < 1.05 * radii[ends[:, 0]]).all()
    again = cover(count=6)  # balls instead
    assert again == made == balls_of(source) and not len(made.data.edges)
    assert spheres(made) == 6
    assert cover(count=9, shapes="TAPERED") == made and len(made.data.edges) >= 3
    assert [m.name.startswith("Medial Axis Capsules") for m in made.modifiers] == [True]


def test_capsules_are_written(tmp_path, capfd):
    source = torus()
    source.location, source.scale = (1, 2, 3), (2, 2, 2)
    made = cover(source, count=9, shapes="CAPSULES")
    path = tmp_path / "torus.json"
    export(path)
    assert reports(capfd)[-1][1] == f"Wrote {len(made.data.edges)} capsules to 'torus.json'"
    known = json.loads(path.read_text())
    assert known["covered"] == made["ma_balls_covered"]
    first = [made.matrix_world @ made.data.vertices[v].co for v in made.data.edges[0].vertices]
    assert np.allclose(known["capsules"][0]["ends"], first, atol=1e-5)
    robot = tmp_path / "torus.urdf"
    export(robot)
    assert robot.read_text().count("<cylinder") == len(made.data.edges)
    cover(count=9, shapes="TAPERED")
    refuse_export("found tapered capsules; set Shapes to Capsules", tmp_path / "b.urdf")
    compute(source, side="INNER", select_result=False)
    arm = tmp_path / "arm.mjcf"
    export(arm, balls=9, shapes="CAPSULES")
    assert arm.read_text().count('type="capsule"') >= 3
