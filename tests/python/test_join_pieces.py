# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of a skeleton are joined where the gap between them lies in the solid, and nowhere else."""

import medial_axis
import numpy as np
import pytest
from medial_axis.core.curves.net import Net
from medial_axis.core.settings import SamplingMode, Settings, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.compute import compute_skeleton
from medial_axis.core.skeleton.join_pieces import join_pieces, no_joins
from medial_axis.core.skeleton.write_skeleton import export_skeleton
from support import meshes, swept
from support.thick_meshes import block


def joined(medial, mesh, net):
    """How many pieces are, by distances from all faces, also those inside."""
    depth = lambda places: medial.TriangleTree(*mesh).distances(places)
    return join_pieces(net, depth, Shape(*mesh))[0]


def net_of(points, wires, singles):
    wires, singles = np.array(wires, np.int32).reshape(-1, 2), np.array(singles, np.int32)
    ones = np.ones(len(points))
    return Net(np.array(points, float), 0.3 * ones, wires, singles, ones)


def test_pieces_along_a_rod_become_one_branch(medial):
    heights = (0.0, 0.5, 1.0, 1.5, 2.5, 3.0, 3.5, 4.0, 2.0)
    points = [*((0, 0, z) for z in heights), (0.1, 0, 3.2)]
    wires = [(0, 1), (1, 2), (2, 3), (4, 5), (5, 6), (6, 7)]
    net = net_of(points, wires, [8, 9])
    assert joined(medial, swept.capsule(4.0, 0.3, 48), net) == 3
    (chain,) = net.branches.values()
    assert sorted(chain) == list(range(9)) and sorted(net.at) == [0, 7]
    assert net.stands_for()[9] == 5 and net.load[9] == 0.0 and net.load.sum() == 10.0


def test_a_piece_is_joined_within_a_branch(medial):
    cross = meshes.join(block(4.0, 1.0, 1.0), block(1.0, 4.0, 1.0))
    points = [(-1.5, 0, 0), (0, 0, 0), (1.5, 0, 0), (0, 1.2, 0), (0, 1.7, 0)]
    net = net_of(points, [(0, 1), (1, 2), (3, 4)], [])
    assert joined(medial, cross, net) == 1  # over faces that lie inside
    assert len(net.at[1]) == 3 and len(net.branches) == 3


def test_bodies_apart_stay_apart(medial):
    for gap in (1.0, 0.01, 0.001):
        mesh = meshes.join(block(1.0, 1.0, 1.0), block(1.0, 1.0, 1.0, (1.0 + gap, 0, 0)))
        net = net_of([(0, 0, 0), (1.0 + gap, 0, 0)], [], [0, 1])
        assert joined(medial, mesh, net) == 0 and len(net.at) == 2


def chain_of_tubes(count, radius, seed):
    """Open hexagonal tubes that overlap, as a traced cell has them."""
    random = np.random.default_rng(seed)
    place, along = np.zeros(3), np.array([0.0, 0.0, 1.0])
    turn = 2 * np.pi * np.arange(6) / 6
    i, tubes = np.arange(6), []
    j = (i + 1) % 6
    for _ in range(count):
        along = along + 0.3 * random.normal(size=3)
        along /= np.linalg.norm(along)
        x = np.cross(along, (0.3, 0.5, 0.81))
        x /= np.linalg.norm(x)
        ring = np.cos(turn)[:, None] * x + np.sin(turn)[:, None] * np.cross(along, x)
        ring = ring * radius * random.uniform(0.5, 1.5)
        triangles = np.concatenate((np.c_[i, j, 6 + j], np.c_[i, 6 + j, 6 + i]))
        tubes.append((np.concatenate((place + ring, place + along + ring)), triangles))
        place = place + (1.0 - 0.5 * radius) * along
    return meshes.join(*tubes)


def test_a_torn_chain_of_open_tubes_is_joined_and_told(monkeypatch, tmp_path):
    shape = Shape(*chain_of_tubes(20, 0.1, 5))
    settings = Settings(samples=500, sampling=SamplingMode.SURFACE)
    found = compute_skeleton(shape, settings, SkeletonSettings())
    work = medial_axis.core.skeleton.compute
    monkeypatch.setattr(work, "join_pieces", lambda *_: (0, no_joins()))
    torn = compute_skeleton(shape, settings, SkeletonSettings())
    assert found.skeleton.pieces < torn.skeleton.pieces
    assert any("were joined to others across gaps" in sentence for sentence in found.warnings)
    whole, path = found.skeleton, tmp_path / "chain.swc"
    assert len(whole.gaps) and (whole.gaps > 0.0).all() and not len(torn.skeleton.gaps)
    assert torn.skeleton.pieces - whole.pieces >= len(whole.gaps)
    export_skeleton(whole, found.parts, path)
    text = path.read_text().splitlines()
    rows = {line.split()[0]: line.split() for line in text}
    lines = [line for line in text if line.startswith("# joins pieces across a gap: ")]
    assert len(lines) == len(whole.gaps)
    for line, gap in zip(lines, whole.gaps, strict=True):
        a, b, length = line.split(": ")[1].split()
        ends = np.array([[float(x) for x in rows[end][2:5]] for end in (a, b)])
        assert float(length) == gap == pytest.approx(np.linalg.norm(ends[1] - ends[0]))
    assert any("the surface is open" in sentence for sentence in found.warnings)
