# SPDX-License-Identifier: GPL-3.0-or-later
"""10,000 small inputs, most of them degenerate: no crash, no broken invariant, errors only where they belong.

And 10,000 for Tight Cocone, of which a run without --slow takes 2,000.
"""

import numpy as np
import pytest
from support import inputs
from support.shapes import SHAPES
from test_invariants import assert_invariants
from test_tight_cocone import assert_between_inner_and_outer_cells, assert_watertight

pytestmark = pytest.mark.oracle

BATCHES, BATCH = 50, 200


def random_points(rng):
    """4 to 30 points of one of a dozen kinds of trouble."""
    n, kind = int(rng.integers(4, 31)), int(rng.integers(0, 12))
    if kind == 0:
        return rng.random((n, 3))
    if kind == 1:
        return rng.integers(0, 3, (n, 3)).astype(float)
    if kind == 2:
        return rng.integers(0, 6, (n, 3)).astype(float)
    if kind == 3:  # two or three coplanar layers
        return np.column_stack((rng.random((n, 2)), rng.integers(0, 1 + n % 3, n)))
    if kind == 4:  # repeated rows
        return rng.random((max(2, n // 2), 3))[rng.integers(0, max(2, n // 2), n)]
    if kind == 5:  # cospherical
        points = rng.normal(size=(n, 3))
        return points / np.linalg.norm(points, axis=1)[:, None]
    if kind == 6:  # cocircular rings
        turn = rng.integers(0, 12, n) * np.pi / 6
        return np.column_stack((np.cos(turn), np.sin(turn), rng.integers(0, 4, n) * 0.25))
    if kind == 7:  # a turned integer grid
        return rng.integers(0, 4, (n, 3)) @ inputs.rotation(int(rng.integers(100))).T
    if kind == 8:  # wild sizes
        return rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-12, 12, (n, 1))
    if kind == 9:  # nearly flat, nearly straight
        return rng.normal(size=(n, 3)) * (1.0, *10.0 ** rng.uniform(-15, 0, 2))
    if kind == 10:  # a grid far away, rounded
        grid = rng.integers(0, 3, (n, 3)) * 0.1 + 1e6 * rng.integers(-1, 2)
        return grid.astype(np.float32).astype(float)
    points = rng.random((n, 3))  # clusters one rounding apart
    return points[rng.integers(0, 4, n)] + rng.integers(0, 3, (n, 3)) * np.spacing(1.0)


def spans_volume(points):
    """Whether integer points span a volume; None for others, where rounding decides."""
    if not np.array_equal(points, np.round(points)) or np.abs(points).max() > 1e6:
        return None
    return np.linalg.matrix_rank(points - points[0]) == 3


def random_sides(medial, rng, points, seed):
    """The source of inside and outside: every source in turn."""
    if seed % 4 == 0:
        n = len(points)
        triangles = rng.integers(0, n, (int(rng.integers(0, 2 * n)), 3)).astype(np.int32)
        is_open = medial.open_edges(points, triangles) > 0  # else perhaps no triangle has an area
        sides = medial.SidesFrom.SURFACE if is_open else medial.SidesFrom.AUTOMATIC
        return {"triangles": triangles, "sides": sides}
    if seed % 4 == 1:
        return {"normals": rng.integers(-2, 3, points.shape).astype(float)}
    return {"sides": medial.SidesFrom.TIGHT_COCONE if seed % 4 == 2 else medial.SidesFrom.NONE}


@pytest.mark.parametrize("batch", range(BATCHES))
def test_small_inputs(medial, batch):
    degenerate = 0
    for seed in range(batch * BATCH, (batch + 1) * BATCH):
        rng = np.random.default_rng(seed)
        points = random_points(rng)
        try:
            options = {"bounding_sphere": seed % 5 == 0, "threads": 1 + seed % 2}
            options |= random_sides(medial, rng, points, seed)
            analysis = medial.MedialAnalysis(points, **options)
        except medial.DegenerateInputError:
            degenerate += 1
            assert spans_volume(points) is not True, seed
            continue
        assert spans_volume(points) is not False, seed
        assert_sound(medial, analysis, points, rng, seed)
    assert degenerate < BATCH / 2


def assert_sound(medial, analysis, points, rng, seed):
    edges = analysis.edges.astype(np.int64)
    assert len(edges) == 0 or (np.diff(edges[:, 0] * 2**32 + edges[:, 1]) > 0).all(), seed
    assert np.isin(edges, analysis.samples).all(), seed
    for name in ("theta", "rho", "theta_both", "rho_both"):
        assert np.isfinite(getattr(analysis, name)).all(), (seed, name)
    thresholds = {"theta": rng.uniform(0, 1.0), "rho": rng.uniform(0, 10)}
    thresholds["limit_set"] = bool(seed % 2)
    mesh, chosen = analysis.extract(**thresholds), analysis.select(**thresholds)
    assert len(mesh.generators) + mesh.unbounded + mesh.zero_area == len(chosen), seed
    try:
        assert_invariants(points, mesh)
    except AssertionError as error:
        raise AssertionError(f"seed {seed}: {error}") from error


# ---- Tight Cocone


def random_cloud(rng):
    """The same trouble, and clouds of up to 300 points that enclose something."""
    kind = int(rng.integers(0, 8))
    if kind < 3:
        return random_points(rng)
    n = int(rng.integers(20, 301))
    name = str(rng.choice(["ellipsoid", "torus", "box", "shell"]))
    points = SHAPES[name].random_sample(n, int(rng.integers(2**31)))
    if kind == 3:  # noise
        return points + rng.normal(size=points.shape) * 10.0 ** rng.uniform(-4, 0)
    if kind == 4:  # two far clusters, one of them small
        far = points * 10.0 ** rng.uniform(-6, 0) + 10.0 ** rng.uniform(0, 8)
        return np.concatenate((points, far))
    if kind == 5:  # outliers, and rows twice
        far = rng.normal(size=(9, 3)) * 10.0 ** rng.uniform(-1, 3)
        return np.concatenate((points, far, points[:9]))
    if kind == 6:  # coplanar layers
        return np.column_stack((points[:, :2], np.round(points[:, 2] * 2)))
    return points * 10.0 ** rng.uniform(-45, 45)  # tiny and huge


def random_options(medial, rng, seed):
    if seed % 3:
        return None
    return medial.CoconeOptions(
        cocone_angle=rng.uniform(0.01, 1.5),
        flatness_ratio=10.0 ** rng.uniform(-3, 3),
        flatness_angle=rng.uniform(0.01, 1.5),
        sharp_angle=rng.uniform(0.01, 3.1),
    )


ARRAYS = ("triangles", "cell_side", "samples", "flat", "good", "on_surface")
COUNTS = ("nonmanifold_edges", "nonmanifold_vertices", "cavities", "inner_cells", "duplicates")


def assert_same(a, b):
    for name in ARRAYS:
        assert getattr(a, name).tobytes() == getattr(b, name).tobytes(), name
    assert [getattr(a, name) for name in COUNTS] == [getattr(b, name) for name in COUNTS]


@pytest.mark.parametrize(
    "batch", [*range(10), *(pytest.param(i, marks=pytest.mark.slow) for i in range(10, 50))]
)
def test_tight_cocone(medial, study, batch):
    """Watertight, whatever comes; and the same for one thread and for two."""
    enclosing = 0
    for seed in range(batch * BATCH, (batch + 1) * BATCH):
        rng = np.random.default_rng(seed)
        points, options = random_cloud(rng), random_options(medial, rng, seed)
        try:
            one, two = (medial.TightCocone(points, options=options, threads=n) for n in (1, 2))
        except medial.DegenerateInputError:
            assert spans_volume(points) is not True, seed
            continue
        try:
            assert_watertight(points, one)
            assert_between_inner_and_outer_cells(study, points, one)
            assert_same(one, two)
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}") from error
        enclosing += one.inner_cells > 0
    assert enclosing > 0.2 * BATCH
