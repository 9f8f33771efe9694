"""Lengths recovered along dual sheets: as given where a mesh is sound, as meant where it is tangled."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.quality import measure
from hexmend.target import given_lengths, recovered_lengths
from tests.core.layers.stacks import renumbered, scrambled_in_layers, stack


def test_lengths_of_a_sound_mesh_are_as_given_to_the_last_bit():
    for mesh in (stack(), make("five-side", size=500), make("layered", size=2000)):
        np.testing.assert_array_equal(recovered_lengths(mesh), given_lengths(mesh))


@given(growth=st.floats(1.05, 1.6), first=st.floats(1e-4, 1e-2), seed=st.integers(0, 100))
def test_lengths_of_a_tangled_stack_are_those_before(growth, first, seed):
    mesh = stack(layers=6, first=first, growth=growth)
    tangled = scrambled_in_layers(mesh, 0.7, seed)
    assert measure(tangled.points, tangled.hexes).n_inverted > 100
    np.testing.assert_allclose(recovered_lengths(tangled), given_lengths(mesh), rtol=0.05)


@given(seed=st.integers(0, 100))
def test_recovered_lengths_follow_the_numbering_of_a_hex(seed):
    tangled = scrambled_in_layers(stack(6, 6, 5), 0.7, seed)
    turned, directions = renumbered(tangled, seed)
    expected = np.take_along_axis(recovered_lengths(tangled), directions, axis=1)
    np.testing.assert_allclose(recovered_lengths(turned), expected, rtol=1e-9)


def test_growth_is_preserved_across_layers():
    mesh = scrambled_in_layers(stack(8, 8, 10, first=1e-3, growth=1.4), 0.6)
    heights = recovered_lengths(mesh)[:, 2].reshape(10, -1)
    np.testing.assert_allclose(heights[1:] / heights[:-1], 1.4, rtol=0.05)


SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in ("pierrot_32735.mesh", "naca_viscous.cgns")]


@pytest.mark.parametrize("name", ["cub_fru.vtk", *SLOW])
def test_meshes_that_are_sound_keep_their_lengths(name, sample_mesh):
    mesh = sample_mesh(name)
    np.testing.assert_array_equal(recovered_lengths(mesh), given_lengths(mesh))


def test_a_badly_tangled_mesh_has_positive_lengths():
    lengths = recovered_lengths(make("cube", size=216, scramble=5.0))
    assert (lengths > 0).all()
    assert np.isfinite(lengths).all()
