"""Kershaw's map: the identity at eps = 1, planes that stay, and a lattice as the optimum with sliding planes."""

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.gallery.kershaw import kershaw_map
from hexmend.quality import summarise


def lattice(n):
    axes = np.linspace(0, 1, n + 1)
    return np.stack(np.meshgrid(axes, axes, axes, indexing="ij"), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize(("size", "n"), [(1, 6), (500, 6), (1728, 12), (3000, 12), (3500, 18), (13824, 24)])
def test_the_size_is_that_of_the_nearest_multiple_of_six(size, n):
    assert make("kershaw", size=size).n_hexes == n**3


@pytest.mark.parametrize("eps", [0.1, 0.3, 0.7])
def test_the_box_and_the_planes_of_x_stay_and_no_hex_is_inverted(eps):
    given = lattice(12)
    mapped = kershaw_map(given, eps)
    np.testing.assert_array_equal(mapped[:, 0], given[:, 0])
    for end in (0, 1):
        np.testing.assert_allclose(mapped[given == end], end, atol=1e-15)
    assert summarise(make("kershaw", size=1728, eps=eps)).inverted == 0


def test_the_first_layer_is_left_and_the_last_is_right():
    mapped = kershaw_map(np.array([[0, 0.5, 0.25], [1 / 6, 0.5, 0.25], [5 / 6, 0.5, 0.25], [1, 0.5, 0.25]]), 0.3)
    assert mapped[:, 1] == pytest.approx([0.15, 0.15, 0.85, 0.85])
    assert mapped[:, 2] == pytest.approx([0.075, 0.075, 0.425, 0.425])


def test_the_least_scaled_jacobian_is_the_published_one():
    assert summarise(make("kershaw", size=13824)).scaled_jacobian_min == pytest.approx(0.1660, abs=5e-5)
