"""Materials by sets and data, and the interfaces between them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.io import read
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.materials import STRUCTURED_BLOCKS
from tests.core.grids import grid

MESH = grid(4)
LOW = np.flatnonzero(MESH.points[MESH.hexes].mean(axis=1)[:, 0] < 2)
HIGH = np.setdiff1d(np.arange(MESH.n_hexes), LOW)
TWO = {"low": LOW, "high": HIGH}


def of(**fields):
    return MESH.replace(**fields).materials


@pytest.mark.parametrize(
    "sets",
    [
        TWO,
        {"all": np.arange(64), **TWO},
        {"some": LOW[:5], **TWO, "empty": np.empty(0, int)},
        {"across": np.array([0, 63]), "all": np.arange(64), "a few": HIGH[:2], **TWO},
        {"low": np.concatenate([LOW, LOW[:3]]), "high": HIGH},
    ],
)
def test_sets_that_divide_the_mesh_are_materials_whatever_others_there_are(sets):
    found = of(hex_sets=sets)
    assert set(found.names) == {"low", "high"}
    for k, name in enumerate(found.names):
        np.testing.assert_array_equal(np.flatnonzero(found.of_hex == k), TWO[name])


@pytest.mark.parametrize(
    "fields",
    [
        {},
        {"hex_sets": {"low": LOW}},
        {"hex_sets": {"all": np.arange(64)}},
        {"hex_sets": {"low": LOW, "more": np.append(HIGH, LOW[0])}},
        {"hex_data": {"pressure": np.arange(64) // 32, "id": np.arange(64)}},
        {"hex_data": {"MaterialIds": np.ones(64)}},
        {"hex_data": {"MaterialIds": np.linspace(0, 1, 64)}},
        {"hex_data": {"region": np.arange(64)}},
        {"hex_sets": TWO, "field_data": {STRUCTURED_BLOCKS: ["low", "high"]}},
    ],
)
def test_a_mesh_without_a_division_has_one_material_and_keeps_its_free_nodes(fields):
    mesh = MESH.replace(**fields)
    assert mesh.materials is None
    np.testing.assert_array_equal(mesh.free, MESH.free)


@pytest.mark.parametrize("name", ["MaterialIds", "material", "medit:ref", "Region Id", "block", "nastran:pid"])
def test_numbers_under_a_usual_name_are_materials(name):
    for as_type in (np.int8, np.float64):
        numbers = np.full(64, 7, as_type)
        numbers[HIGH] = 12
        found = of(hex_data={name: numbers})
        assert found.names == ("7", "12")
        np.testing.assert_array_equal(np.flatnonzero(found.of_hex), HIGH)


@given(st.integers(2, 5), st.integers(0, 10**6))
def test_interfaces_are_the_nodes_and_faces_of_hexes_of_different_material(count, seed):
    numbers = np.random.default_rng(seed).integers(0, count, MESH.n_hexes)
    numbers[:count] = np.arange(count)
    found = of(hex_data={"material": numbers})
    sets = [set(numbers[(MESH.hexes == node).any(axis=1)]) for node in range(MESH.n_nodes)]
    np.testing.assert_array_equal(found.interface_nodes, [len(one) > 1 for one in sets])
    across = MESH.topology.face_neighbours
    expected = sum(numbers[h] != numbers[o] for h in range(64) for o in across[h] if o > h)
    assert len(found.interface_sides) == expected
    for one, face, other, back in found.interface_sides:
        assert numbers[one] < numbers[other]
        assert across[one, face] == other
        assert set(MESH.hexes[one, FACES[face]]) == set(MESH.hexes[other, FACES[back]])


def test_the_ball_in_a_box_has_a_sphere_as_interface():
    mesh = make("materials", size=300, scramble=0.4)
    on = mesh.materials.interface_nodes
    assert mesh.materials.names == ("ball", "box")
    assert not mesh.free[on].any()
    np.testing.assert_allclose(np.linalg.norm(mesh.points[on], axis=1), 0.6)


def test_the_ten_grains(real_mesh):
    mesh = read(real_mesh("n10-id2_hex.msh"))
    inside = mesh.materials.interface_nodes & ~mesh.topology.boundary
    assert len(mesh.materials) == 10
    assert np.count_nonzero(inside) == 701
    assert not mesh.free[inside].any()
