# SPDX-License-Identifier: GPL-3.0-or-later
"""Small matrices against LAPACK's answers, and the cosine against the C library's."""

import numpy as np
import pytest
from medial_axis.core.portable_angle import cosine
from medial_axis.core.small_matrices import (
    determinant,
    dot,
    inverse,
    length_of,
    shortest_solutions,
    stretches,
    times,
)

EPSILON = np.finfo(float).eps


@pytest.fixture(params=[1.0, 1e-140, 1e140], ids="{:g}".format)
def scale(request):
    return request.param


def matrices(rows=3):
    rng = np.random.default_rng(5)
    for k in range(60):
        matrix = rng.normal(size=(rows, 3)) * 10.0 ** rng.uniform(-6, 0, 3)
        if k % 5 == 0:
            matrix[:, 1] = 2.0 * matrix[:, 0]
        yield matrix


def test_products_are_those_of_blas():
    rng = np.random.default_rng(1)
    points, matrix = rng.normal(size=(50, 3)), rng.normal(size=(2, 3))
    assert np.allclose(times(points, matrix), points @ matrix.T, rtol=0, atol=8 * EPSILON)
    assert np.allclose(dot(points, points), (points**2) @ np.ones(3))
    assert length_of(points[0]) == pytest.approx(np.linalg.norm(points[0]), rel=4 * EPSILON)


def test_determinants_and_inverses():
    for matrix in np.random.default_rng(2).normal(size=(50, 3, 3)):
        assert determinant(matrix) == pytest.approx(np.linalg.det(matrix), rel=1e-11)
        assert np.allclose(inverse(matrix) @ matrix, np.identity(3), atol=1e-10)


@pytest.mark.parametrize("rows", [1, 3, 40])
def test_stretches_are_the_singular_values(rows, scale):
    for matrix in matrices(rows):
        size, direction, image = stretches(scale * matrix)
        exact = np.zeros(3)
        exact[: min(rows, 3)] = np.linalg.svd(matrix, compute_uv=False)
        assert np.allclose(size / scale, exact, rtol=0, atol=32 * EPSILON * exact[0])
        assert np.allclose(direction @ direction.T, np.identity(3), atol=32 * EPSILON)
        near = {"rtol": 0, "atol": 64 * EPSILON * exact[0]}
        assert np.allclose(image / scale, (matrix @ direction.T).T, **near)


def test_stretches_of_nothing_are_zero():
    size, direction, _ = stretches(np.zeros((3, 3)))
    assert not size.any()
    assert np.array_equal(direction, np.identity(3))


@pytest.mark.parametrize("planes", [1, 2, 4])
def test_shortest_solutions_are_those_of_the_pseudo_inverse(planes, scale):
    normals = np.random.default_rng(planes).normal(size=(500, planes, 3))
    normals /= np.linalg.norm(normals, axis=2)[:, :, None]
    squares = np.einsum("nij,nik->njk", normals, normals)
    squares[-1] = 0.0
    wanted = normals.sum(axis=1)
    exact = np.einsum("nij,nj->ni", np.linalg.pinv(squares, 0.02, hermitian=True), wanted)
    found = shortest_solutions(scale * squares, scale * wanted, 0.02)
    assert np.allclose(found, exact, rtol=0, atol=1e-12)
    assert not found[-1].any()


def test_cosine():
    angles = np.linspace(-20.0, 20.0, 10_001)
    assert np.abs(cosine(angles) - np.cos(angles)).max() < 1e-14
    assert cosine(0.0) == 1.0
    assert isinstance(cosine(1.0), float)
