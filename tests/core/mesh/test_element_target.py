"""Targets of elements: their checks, and the meshes that carry them."""

import copy

import numpy as np
import pytest

from hexmend import MeshError, Target, gallery


@pytest.fixture
def mesh():
    return gallery.make("cube", size=8)


@pytest.mark.parametrize(
    ("lengths", "message"),
    [
        (np.ones(3), "shape"),
        (np.ones((2, 2)), "shape"),
        (np.zeros((2, 3)), "is 0 at hex 0"),
        ([[1, 1, 1], [1, np.nan, 1]], "is nan at hex 1, direction 1"),
        ([[1, 1, np.inf]], "positive finite"),
        ([[1, 1, -1]], "is -1 at hex 0, direction 2"),
        ([[1, 1e300, 1]], r"is 1e\+300 at hex 0, direction 1 .*: expected positive .* from 1e-100 to 1e\+100"),
        ([[1e-300, 1, 1]], "is 1e-300 at hex 0, direction 0"),
        (np.ones((2, 3), bool), "type bool"),
    ],
)
def test_impossible_lengths_are_named(lengths, message):
    with pytest.raises(MeshError, match=message):
        Target(lengths)


@pytest.mark.parametrize("weight", [-1, np.nan, np.inf])
def test_impossible_weights_are_named(weight):
    with pytest.raises(MeshError, match="weight of the size"):
        Target(np.ones((1, 3)), weight)


def test_lengths_are_read_only_and_independent_of_the_callers():
    lengths = np.ones((2, 3))
    target = Target(lengths)
    lengths[:] = 2
    assert (target.lengths == 1).all()
    assert not target.lengths.flags.writeable


def test_derived_meshes_keep_the_target(mesh):
    target = Target(np.ones((mesh.n_hexes, 3)), 0.5, "given")
    aimed = mesh.with_element_target(target)
    derived = {
        "points": aimed.with_points(mesh.points + 1),
        "fixed": aimed.with_fixed(mesh.fixed),
        "surface": aimed.keeping_surface(),
        "field": aimed.replace(name="other"),
        "deep copy": copy.deepcopy(aimed),
    }
    assert {name for name, one in derived.items() if one.element_target is not target} == set()
    assert mesh.element_target is None
    assert aimed.topology is mesh.topology


def test_a_target_of_other_hexes_is_refused(mesh):
    with pytest.raises(MeshError, match="target is for 1 hex: the mesh has 8"):
        mesh.with_element_target(Target(np.ones((1, 3))))
