"""Layers of wedges: they are found as those of hexes are, and keep their heights."""

import numpy as np
import pytest

import hexmend as hx
from hexmend import find_layers
from hexmend.layers.report import describe_layers
from tests.core.grids import scrambled
from tests.core.solid_lattices import prisms

FIRST, GROWTH, COUNT = 0.01, 1.5, 8
PLACES = np.concatenate([[0], FIRST * np.cumsum(GROWTH ** np.arange(COUNT))])


def stack(sets=False):
    """Wedges on a wall at z = 0, which grow in height."""
    mesh = prisms(COUNT)
    bottom = np.flatnonzero(mesh.points[:, 2] == 0)
    points = mesh.points.copy()
    points[:, 2] = PLACES[points[:, 2].astype(int)]
    return mesh.with_points(points).replace(node_sets={"plate": bottom} if sets else {})


def heights(mesh):
    return np.diff(mesh.points[:, 2].reshape(COUNT + 1, -1), axis=0)


def test_layers_of_wedges_are_found_with_their_figures():
    mesh = stack()
    (wall,) = find_layers(mesh).walls
    assert (wall.count, wall.depth) == (2 * COUNT**2, COUNT)
    (figures,) = describe_layers(find_layers(mesh), mesh)
    assert figures["first_height_mean"] == pytest.approx(FIRST)
    assert figures["growth"] == pytest.approx(GROWTH)
    assert figures["angle_max"] < 1e-5
    assert not find_layers(prisms(4))


@pytest.mark.parametrize("options", [{}, {"layers": "plate"}])
def test_smoothing_keeps_the_heights_of_wedges(options):
    mesh = stack(sets=True)
    result = hx.smooth(scrambled(mesh, 0.2 * FIRST, 1), "mend", **options)
    assert not result.after.invalid
    assert result.layers[0].change < 1.1
    np.testing.assert_allclose(heights(result.mesh), heights(mesh), rtol=0.2)  # that of the noise
    lost = hx.smooth(scrambled(mesh, 0.2 * FIRST, 1), "mend", layers="free").mesh
    assert heights(lost)[0].max() > 2 * FIRST
