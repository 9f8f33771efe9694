"""Interfaces between materials, which every registered method keeps, or lets slide on themselves."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import METHODS, Mesh, Outcome, smooth
from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.gallery import make
from hexmend.quality.material_volumes import material_volumes
from tests.core.grids import grid, scrambled

SLIDING = [
    name for name, cls in METHODS.items() if cls().slides_on(make("materials", size=56).with_rules(interfaces="slide"))
]


def bumpy(n: int = 6) -> Mesh:
    """Two materials with a wave as their interface, scrambled between it and the boundary."""
    mesh = grid(n)
    x = mesh.points / n
    low = mesh.points[mesh.hexes].mean(axis=1)[:, 0] < n / 2
    wave = 0.06 * np.sin(np.pi * x[:, 0]) * np.sin(2 * np.pi * x[:, 1]) * np.sin(2 * np.pi * x[:, 2])
    sets = {"low": np.flatnonzero(low), "high": np.flatnonzero(~low)}
    return scrambled(mesh.with_points(x + wave[:, None] * [1, 0, 0]).replace(hex_sets=sets), 0.25 / n)


@settings(max_examples=4)
@given(seed=st.integers(0, 10**6), parts=st.integers(2, 4))
@pytest.mark.parametrize("name", METHODS)
def test_nodes_between_materials_stay_to_the_last_bit(name, seed, parts):
    mesh = make("five-side", size=60)
    mesh = scrambled(mesh.replace(hex_data={"material": np.random.default_rng(seed).integers(0, parts, 60)}), 0.05)
    if mesh.materials is None:
        return
    on = mesh.materials.interface_nodes
    for step in itertools.islice(METHODS[name]().steps(mesh), 4):
        np.testing.assert_array_equal(step.points[on], mesh.points[on])


@pytest.mark.parametrize("name", SLIDING)
def test_an_interface_that_slides_stays_on_itself_and_leaves_the_boundary(name):
    mesh = bumpy().with_rules(interfaces="slide")
    after = smooth(mesh, name, max_iterations=60).mesh
    boundary = mesh.topology.boundary
    np.testing.assert_array_equal(after.points[boundary], mesh.points[boundary])
    on = mesh.materials.interface_nodes & ~boundary
    assert np.linalg.norm(after.points - mesh.points, axis=1)[on].max() > 1e-3 * mesh.mean_edge_length
    y, z = after.points[on, 1], after.points[on, 2]
    wave = 0.5 + 0.06 * np.sin(2 * np.pi * y) * np.sin(2 * np.pi * z)
    assert np.abs(after.points[on, 0] - wave).max() < 0.1 * mesh.mean_edge_length
    volumes = material_volumes(mesh), material_volumes(after)
    assert all(volumes[1][key] == pytest.approx(volume, rel=0.01) for key, volume in volumes[0].items())


def test_an_interface_is_a_patch_of_its_own_that_ends_in_a_curve_on_the_boundary():
    mesh = bumpy()
    between, outer = mesh.materials.interface_nodes, mesh.topology.boundary
    sliding = SlidingBoundary(mesh)
    assert (sliding.node_class[between & ~outer] == NodeClass.PATCH).all()
    assert (sliding.node_class[between & outer] != NodeClass.PATCH).all()
    patches = set(sliding.boundary.component[between & ~outer])
    others = outer & (sliding.node_class == NodeClass.PATCH)
    assert len(patches) == 1
    assert not patches & set(sliding.boundary.component[others])


def test_corners_are_where_the_interfaces_of_four_materials_meet():
    mesh = grid(4)
    quarter = (mesh.points[mesh.hexes].mean(axis=1) > 2) @ [1, 2, 4]
    mesh = mesh.replace(hex_data={"material": quarter})
    classes = SlidingBoundary(mesh).node_class
    at = {tuple(x): classes[k] for k, x in enumerate(mesh.points)}
    assert at[2, 2, 2] == NodeClass.CORNER
    assert at[2, 2, 1] == NodeClass.CURVE
    assert at[2, 1, 1] == NodeClass.PATCH
    assert at[1, 1, 1] == NodeClass.INSIDE


def test_interfaces_slide_with_the_boundary_and_fixed_sets_stay():
    mesh = bumpy()
    inner = mesh.materials.interface_nodes & ~mesh.topology.boundary
    middle = np.flatnonzero(inner)[:3]
    mesh = mesh.replace(node_sets={"middle": middle})
    after = smooth(mesh, boundary="slide", fix="middle", max_iterations=60).mesh.points
    np.testing.assert_array_equal(after[middle], mesh.points[middle])
    others = np.setdiff1d(np.flatnonzero(inner), middle)
    assert (after[others] != mesh.points[others]).any(axis=1).mean() > 0.5


def test_free_interfaces_move_as_in_a_mesh_of_one_material():
    mesh = bumpy()
    one = smooth(mesh.replace(hex_sets={})).mesh.points
    np.testing.assert_array_equal(smooth(mesh, interfaces="free").mesh.points, one)


def test_a_mesh_whose_nodes_are_all_between_materials_has_nothing_free_unless_they_slide():
    mesh = grid(2).replace(hex_data={"material": np.arange(8) % 2})
    mesh = mesh.with_points(mesh.points + 0.2 * (np.arange(27) == 13)[:, None])
    assert smooth(mesh).outcome is Outcome.NOTHING_FREE
    assert smooth(mesh, interfaces="free").outcome is Outcome.CONVERGED


def test_hexes_between_the_boundary_and_an_interface_are_locked_and_sliding_frees_them():
    mesh = grid(3)
    numbers = mesh.points[mesh.hexes].mean(axis=1)[:, 0] > 1
    node = int(np.flatnonzero((mesh.points == [1, 1, 1]).all(axis=1))[0])
    moved = mesh.points + [0, 1.1, 0] * (np.arange(mesh.n_nodes) == node)[:, None]
    mesh = mesh.replace(hex_data={"material": numbers.astype(int)})
    folded = mesh.with_points(moved)
    kept = smooth(folded)
    assert kept.after.inverted
    assert kept.after.locked_inverted
    assert not smooth(folded, interfaces="free").after.inverted
    assert not smooth(mesh.keeping_surface().with_points(moved), interfaces="slide").after.inverted


@pytest.mark.parametrize("name", ["laplacian", "local-nr", "mend"])
def test_a_node_freed_from_an_interface_leaves_its_neighbours_sliding_on_it(name):
    mesh = bumpy()
    between, outer = mesh.materials.interface_nodes, mesh.topology.boundary
    inner = np.flatnonzero(between & ~outer)
    middle = inner[np.linalg.norm(mesh.points[inner] - 0.5, axis=1).argmin()]
    mesh = mesh.replace(node_sets={"middle": [middle]}).with_rules(interfaces="slide", free="middle")
    sliding = SlidingBoundary(mesh, outer=False)
    assert sliding.node_class[middle] == NodeClass.INSIDE
    assert (sliding.node_class[np.setdiff1d(inner, middle)] == NodeClass.PATCH).all()
    after = smooth(mesh, name, max_iterations=60).mesh.points
    ring = np.intersect1d(mesh.topology.rings.of(np.array([middle])), inner)
    assert ring.size == 4
    assert (after[[middle, *ring]] != mesh.points[[middle, *ring]]).any(axis=1).all()
    wave = 0.5 + 0.06 * np.sin(2 * np.pi * after[ring, 1]) * np.sin(2 * np.pi * after[ring, 2])
    assert np.abs(after[ring, 0] - wave).max() < 0.1 * mesh.mean_edge_length
