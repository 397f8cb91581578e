# SPDX-License-Identifier: GPL-3.0-or-later
"""Hollow solids whose cavity is known in closed form, and what cannot be hollow."""

import json
import os
import signal
import time

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.errors import Cancelled, InvalidInputError
from medial_axis.core.hollow.drain_hole import drain_hole
from medial_axis.core.hollow.hollow import _step, hollow
from medial_axis.core.machine.progress import Progress
from medial_axis.core.products import hollow as hollow_work
from medial_axis.core.settings import HollowSettings
from medial_axis.core.shape.shape import Shape
from scipy.spatial import ConvexHull, HalfspaceIntersection
from support import topology
from support.crossing_triangles import crossing_pairs
from support.distance import to_triangle
from support.meshes import flip, hull, icosphere, join, moved, read, shape_of, torus, write_off
from support.thick_meshes import block
from support.thin_solids import turned, union


def hollowed(mesh, wall, **wanted):
    return hollow(shape_of(mesh), HollowSettings(wall=wall, **wanted))


def away(places, mesh):
    """(k,) exact distances of some of the places, (n, 3), from the faces, by all pairs."""
    corners = np.asarray(mesh[0])[mesh[1]]
    rows = np.linspace(0, len(places) - 1, 10 + 200_000 // len(corners)).astype(int)
    pairs = np.repeat(places[rows], len(corners), axis=0), np.tile(corners, (len(rows), 1, 1))
    return to_triangle(*pairs).reshape(len(rows), -1).min(axis=1)


def inner_volume(points, wall):
    """The volume of all places of a convex solid that are at least so far from its faces, by Qhull."""
    planes = ConvexHull(points).equations
    planes[:, 3] += wall
    return ConvexHull(HalfspaceIntersection(planes, points.mean(axis=0)).intersections).volume


def profile_l():
    """Two arms of length 2 and width 1 in a plane, 1 high."""
    return union(((0, 0, 0), (2, 1, 1)), ((0, 0, 0), (1, 2, 1)))


def of_l(wall):
    """Volume of the cavity; round the reflex edge its wall is a quarter of a cylinder."""
    arm, width = 2 - 2 * wall, 1 - 2 * wall
    return (2 * arm * width - width**2 + wall**2 * (1 - np.pi / 4)) * width


BLOCK = block(1.0, 0.9, 0.8)
BLOB = np.random.default_rng(5).normal(size=(40, 3))
CASES = {
    "block": (BLOCK, 0.1, 0.8 * 0.7 * 0.6),
    "turned": (turned(BLOCK, seed=3), 0.1, 0.8 * 0.7 * 0.6),
    "sphere": (icosphere(2), 0.3, inner_volume(icosphere(2)[0], 0.3)),
    "blob": ((BLOB, hull(BLOB)), 0.4, inner_volume(BLOB, 0.4)),
    "reflex": (profile_l(), 0.2, of_l(0.2)),
    "torus": (torus(1.0, 0.5, 96, 48), 0.2, 2 * np.pi**2 * 0.3**2),
}


@pytest.mark.parametrize("name", CASES)
def test_cavities_in_closed_form(name):
    mesh, wall, volume = CASES[name]
    found = hollowed(mesh, wall, voxel_size=wall / 2)
    inner = found.triangles[found.outer :]
    assert found.solid_volume - found.volume == pytest.approx(volume, rel=0.015)
    np.testing.assert_array_equal(found.triangles[: found.outer], mesh[1])
    _, uses = topology.edges(inner)
    assert (uses == 2).all()
    assert topology.euler(inner) == (0 if name == "torus" else 2) and found.cavities == 1
    np.testing.assert_allclose(away(found.cavity, mesh), wall, rtol=5e-4)
    inside = np.random.default_rng(0).dirichlet((1, 1, 1), len(inner))
    places = (found.vertices[inner] * inside[:, :, None]).sum(axis=1)
    assert away(places, mesh).min() >= found.least > 0.94 * wall
    assert not len(crossing_pairs(found.vertices, inner))


class Stops(Progress):
    """A progress that is cancelled as a call of the compiled module begins, the first or a later one."""

    def __init__(self, call):
        super().__init__()
        self.left = call

    def part(self, share=1.0):
        self.left -= 1
        if self.left == 0:
            self.cancel()
        return super().part(share)


def test_it_can_be_cancelled_at_every_call():
    shape, wanted = Shape(*BLOCK), HollowSettings(wall=0.2, voxel_size=0.1)
    whole = Stops(0)
    hollow(shape, wanted, whole)
    calls = -whole.left
    assert calls > 3
    for call in range(1, calls + 1):
        with pytest.raises(Cancelled):
            hollow(shape, wanted, Stops(call))


def test_a_cancelled_command_leaves_no_file(tmp_path, monkeypatch):
    source = write_off(tmp_path / "block.off", block(10.0, 9.0, 8.0))

    def interrupted(shape, wanted, progress):
        os.kill(os.getpid(), signal.SIGINT)
        until = time.monotonic() + 60
        while not progress.cancelled and time.monotonic() < until:
            time.sleep(0.005)
        return hollow(shape, wanted, progress)

    monkeypatch.setattr(hollow_work, "hollow", interrupted)
    assert run(source, tmp_path / "shell.stl", "--quiet") == cli.CANCELLED
    assert [path.name for path in tmp_path.iterdir()] == ["block.off"]


def test_two_rooms_are_told():
    """A dumb-bell whose bar is thinner than two walls."""
    mesh = union(((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1)), ((1, 0.4, 0.4), (2, 0.6, 0.6)))
    found = hollowed(mesh, 0.2, voxel_size=0.1)
    assert found.cavities == 2 and any("2 places" in text for text in found.warnings)


def test_a_wall_round_a_cavity_lies_loose_in_one_space():
    """A box in a box with a wall of 0.3: two walls of 0.1, and one space between them."""
    boxes = join(block(1.0, 1.0, 1.0), flip(block(0.4, 0.4, 0.4)))
    found = hollowed(boxes, 0.1, voxel_size=0.05)
    assert (found.cavities, found.loose) == (1, 1)
    (said,) = found.warnings
    assert "lie loose in the hollow, 1 in all" in said
    # Round the inner box the space has rounded edges.
    space = 0.8**3 - (0.4**3 + 6 * 0.16 * 0.1 + 3 * 0.4 * np.pi * 0.01 + 4 / 3 * np.pi * 1e-3)
    assert found.solid_volume - found.volume == pytest.approx(space, rel=0.01)


def test_a_wall_that_takes_minutes_is_refused_with_the_least_that_does_not():
    mesh = block(1.0, 0.7, 0.4)
    with pytest.raises(InvalidInputError, match="which takes minutes") as refused:
        hollowed(mesh, 0.005)
    least = float(str(refused.value).split("at least ")[1].split(" ")[0])
    assert 0.005 < least < 0.02
    shape = Shape(*mesh)
    step = _step(shape, HollowSettings(wall=least))
    assert shape.area / step**2 < 80_000
    assert _step(shape, HollowSettings(wall=0.005, voxel_size=0.0025)) == 0.0025


def test_without_a_length_the_wall_is_a_share_of_the_diagonal():
    found = hollowed(BLOCK, 0.0)
    assert found.wall == pytest.approx(0.03 * np.linalg.norm((1.0, 0.9, 0.8)))


@pytest.mark.parametrize(
    "mesh, wall, voxel, words",
    (
        (BLOCK, 0.45, 0.0, "thinner wall"),
        (BLOCK, 0.1, 1e-4, "larger voxels"),
        ((BLOCK[0], BLOCK[1][1:]), 0.1, 0.0, "closed faces"),
    ),
)
def test_what_cannot_be_hollow(mesh, wall, voxel, words):
    with pytest.raises(InvalidInputError, match=words):
        hollowed(mesh, wall, voxel_size=voxel)


def test_the_drain_hole_leads_from_the_lowest_place_through_the_wall():
    found = hollowed(BLOCK, 0.1)
    down = np.array((0.0, 0.0, -1.0))
    hole = drain_hole(found, 0.05, down)
    np.testing.assert_allclose(hole.start[:2], 0.0, atol=0.05)
    assert hole.end[2] < -0.4 and hole.start[2] > -0.3
    aside = drain_hole(found, 0.05, down, near=np.array((2.0, 0.0, 0.0)))
    assert aside.end[0] > 0.5 and np.abs(aside.end[1:]).max() < 0.1


def run(source, target, *words):
    return cli.main(["hollow", source, str(target), "--wall", "2", *words])


@pytest.mark.parametrize("offset, code", [(1e4, cli.DONE), (1e6, cli.FAILED)])
def test_stl_far_from_the_origin(tmp_path, capsys, offset, code):
    source = write_off(tmp_path / "far.off", moved(block(10.0, 9.0, 8.0), 3 * (offset,)))
    for name, expected in (("a.stl", code), ("a.ply", cli.DONE)):
        assert run(source, tmp_path / name, "--quiet") == expected
        assert (tmp_path / name).exists() == (expected == cli.DONE)
    said = capsys.readouterr().err
    assert ("Expected coordinates that fit the 32 bits of .stl" in said) == (code != cli.DONE)


def test_files_and_figures(tmp_path, capsys):
    source = write_off(tmp_path / "block.off", block(10.0, 9.0, 8.0))
    for name in ("a.stl", "a.ply", "a.obj", "a.off"):
        assert run(source, tmp_path / name, "--quiet", "--json") == cli.DONE
        if name != "a.stl":
            made = topology.volume(*read(tmp_path / name))
            assert made == pytest.approx(720 - 120, rel=0.01)
    said = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert said["volume"] == pytest.approx(720 - 120, rel=0.01)
    assert 1.95 < said["least_wall"] <= 2.0 and said["cavities"] == 1
    assert run(source, tmp_path / "c.stl") == cli.DONE
    assert "1 cavity, 83 % of the volume left, wall at least 1.9" in capsys.readouterr().out
    assert run(source, tmp_path / "b.stl", "--wall", "5", "--quiet") == cli.INPUT
