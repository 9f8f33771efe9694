"""Layered: the heights that its parameters name, on a cylinder, and layers that scrambling leaves near their places."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from hexmend import find_layers, summarise
from hexmend.gallery import make
from hexmend.target import given_lengths


@given(layers=st.integers(5, 30), first=st.floats(1e-5, 1e-3), growth=st.floats(1.05, 1.3))
@example(layers=5, first=0.0005, growth=1.05)
def test_heights_grow_from_the_first_by_the_ratio(layers, first, growth):
    mesh = make("layered", size=2000, layers=layers, first_height=first, growth=growth)
    radii = np.sort(np.hypot(*mesh.points[:, :2].T))
    radii = radii[np.diff(radii, prepend=0) > first / 2]  # one of those of each surface, which differ by rounding
    assert radii[0] == pytest.approx(0.5, rel=1e-14)
    np.testing.assert_allclose(np.diff(radii), first * growth ** np.arange(layers), atol=1e-14)
    assert mesh.n_hexes == pytest.approx(2000, rel=0.1)
    assert summarise(mesh).inverted == 0


def test_its_side_sets_are_the_wall_and_the_outside():
    mesh = make("layered", size=2000)
    for name, radius in (("cylinder", 0.5), ("outside", np.hypot(*mesh.points[:, :2].T).max())):
        sides = mesh.side_sets[name]
        nodes = np.unique(mesh.topology.boundary_faces[np.isin(_faces(mesh), sides @ [6, 1])])
        np.testing.assert_allclose(np.hypot(*mesh.points[nodes, :2].T), radius)
    assert [wall.name for wall in find_layers(mesh).walls] == ["cylinder"]


def _faces(mesh):
    """Numbers, 6 * hex + face, of the boundary faces."""
    hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
    return 6 * hexes + faces


@given(scramble=st.floats(0.1, 1), seed=st.integers(0, 100))
def test_scrambling_displaces_by_shares_of_the_gaps(scramble, seed):
    sound, mesh = make("layered", size=1000), make("layered", size=1000, scramble=scramble, seed=seed)
    moves = np.linalg.norm(mesh.points - sound.points, axis=1)
    lateral = given_lengths(sound)[:, 1:].max()
    assert moves.max() <= np.sqrt(3) * scramble * lateral
    assert not moves[mesh.fixed].any()
