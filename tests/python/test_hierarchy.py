"""The hierarchy of the inner axis: one ordered collapse, all of whose levels have the topology of the solid."""

import math

import numpy as np
import pytest
from support import collapse_reference, meshes
from support.levels import Levels, betti_of_mesh

THRESHOLDS = [
    {},
    {"spacings": 1.0},
    {"spacings": 2.0, "limb": 0.0},
    {"sheet": 0.01},
    {"sheet": 0.05, "limb": math.inf},
    {"erosion": 0.002},
    {"erosion": 0.02, "limb": 0.01},
    {"sheet": 0.02, "erosion": 0.01, "limb": 0.1},
    {"sheet": math.inf},
    {"sheet": math.inf, "limb": 0.0},
    {"sheet": math.inf, "limb": math.inf},
]


def random_points(seed, count=None):
    """Anything: volumes, shells, grids with many cospherical cells, lines with one point aside."""
    r = np.random.default_rng(seed)
    n = count or int(r.integers(5, 60))
    kind = seed % 6
    if kind == 0:
        return r.uniform(-1, 1, (n, 3))
    if kind == 1:
        p = r.normal(size=(n, 3))
        return p / np.linalg.norm(p, axis=1)[:, None] * [1, 0.7, 0.4]
    if kind == 2:
        return np.unique(r.integers(0, 4, (n, 3)), axis=0).astype(float)
    if kind == 3:
        angle = 2 * math.pi * np.arange(8) / 8
        ring = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
        return np.concatenate([ring + [0, 0, z] for z in range(2 + seed % 5)])
    if kind == 4:
        p = r.normal(size=(n, 3))
        return p / np.linalg.norm(p, axis=1)[:, None]
    t = np.sort(r.uniform(0, 1, n))
    return np.column_stack((t, t**2, t**3))


def analysed(medial, points, seed=0):
    """Sides by normals that point outward from the middle for a while, so that anything can be inside."""
    normals = points - points.mean(axis=0)
    if seed % 2:
        normals = np.random.default_rng(seed).normal(size=points.shape)
    return medial.MedialAnalysis(points, normals=np.ascontiguousarray(normals))


def inputs(medial, seeds):
    for seed in seeds:
        points = random_points(seed)
        try:
            yield seed, points, analysed(medial, points, seed)
        except medial.DegenerateInputError:
            continue


def assert_levels_hold(hierarchy, analysis, thresholds=THRESHOLDS):
    levels = Levels(hierarchy, analysis)
    for chosen in thresholds:
        alive = levels.alive(**chosen)
        assert levels.is_closed(alive), chosen
        assert levels.betti(alive) == hierarchy.betti, chosen
        level = hierarchy.extract(**chosen)
        assert level.betti == hierarchy.betti, chosen
        if level.hidden == 0:
            pieces, euler = betti_of_mesh(level)
            b0, b1, b2 = hierarchy.betti
            assert (pieces, euler) == (b0, b0 - b1 + b2), chosen


def reference(medial, points, analysis, hierarchy):
    cells = medial.delaunay(points)[0]
    c = collapse_reference.inner_complex(
        points, cells, hierarchy.cells, hierarchy.vertices, hierarchy.generators, hierarchy.edges
    )
    row = {tuple(e): i for i, e in enumerate(analysis.edges.tolist())}
    own = [row[g] for g in c.generators]
    weight = np.maximum(analysis.theta / (math.pi / 8), analysis.rho / 8)[own]
    selected = np.isin(own, analysis.select())
    sample = {int(p): i for i, p in enumerate(analysis.samples)}
    spacing = [
        (analysis.spacing[sample[p]] + analysis.spacing[sample[q]]) / 2 for p, q in c.generators
    ]
    return c, collapse_reference.Collapse(c, weight, selected, points, hierarchy.diagonal), spacing


def same(found, expected):
    """Up to the rounding of float32, and of sums of doubles."""
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    stays = np.isinf(expected)
    if not np.array_equal(stays, np.isinf(found)):
        return False
    away = np.abs(found - expected, where=~stays, out=np.zeros(len(found)))
    return bool(np.all(away < 2e-6 * (1 + np.where(stays, 0, expected))))


@pytest.mark.parametrize("seed", [s for s in range(36) if s % 6 in (0, 1, 5)])
def test_values_are_those_of_the_definition(medial, seed):
    points = random_points(seed)
    analysis = analysed(medial, points, seed)
    hierarchy = analysis.hierarchy()
    c, collapse, spacing = reference(medial, points, analysis, hierarchy)
    assert hierarchy.betti == collapse_reference.betti(c)
    assert sorted(hierarchy.bubbles) == sorted(c.bubbles)
    values = {
        "erosion": collapse.erosion(),
        "sheet": collapse.sheet([hierarchy.diagonal] * len(spacing)),
        "spacings": collapse.sheet(spacing),
    }
    for name, expected in values.items():
        for kind, of_kind in zip(("facet", "edge", "vertex"), collapse.by_cell(expected), strict=True):
            assert same(getattr(hierarchy, f"{kind}_{name}"), of_kind), (kind, name)
    _, edge, vertex = collapse.by_cell(collapse.limb())
    assert same(hierarchy.edge_limb, edge)
    assert same(hierarchy.vertex_limb, vertex)


def test_all_levels_of_random_and_degenerate_inputs_have_the_topology_of_the_complex(medial):
    met = 0
    for _, _, analysis in inputs(medial, range(300)):
        hierarchy = analysis.hierarchy()
        met += hierarchy.betti != (1, 0, 0)
        assert_levels_hold(hierarchy, analysis)
    assert met > 20
