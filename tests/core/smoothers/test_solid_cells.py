"""Meshes of wedges, pyramids and tetrahedra: lattices come back, kinds agree, boundaries, interfaces and pins hold."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.gallery import make
from hexmend.locking import find_locking
from hexmend.mesh.solid_cells import SOLID_KINDS, kinds_of
from tests.core.grids import scrambled
from tests.core.solid_lattices import honeycomb, mixed, prisms

METHODS = ["laplacian", "smart-laplacian", "getme", "local-sd", "local-patch", "global-sd", "general"]
LATTICES = {"prisms": (prisms, 1.0), "honeycomb": (honeycomb, 2**0.5)}


def least(mesh):
    """Least scaled Jacobian of each kind."""
    return {kind: one["scaled_jacobian_min"] for kind, one in mesh.quality().cells.items()}


@pytest.mark.parametrize("method", ["mend", "local-nr", "global-nr"])
@pytest.mark.parametrize("name", LATTICES)
def test_scrambled_lattices_come_back(name, method):
    make, edge = LATTICES[name]
    lattice = make(4)
    tangled = method != "global-nr"
    mesh = scrambled(lattice, (0.45 if tangled else 0.2) * edge, 4)
    assert bool(mesh.quality().inverted) is tangled
    result = hx.smooth(mesh, method, hx.StoppingCriteria(tolerance=1e-9))
    assert np.abs(result.mesh.points - lattice.points).max() < 1e-5 * edge


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", [*LATTICES, "mixed"])
def test_every_method_improves_all_kinds_together(name, method):
    lattice = mixed(4) if name == "mixed" else LATTICES[name][0](4)
    mesh = scrambled(lattice, 0.2 * lattice.mean_edge_length, 4)
    after = hx.smooth(mesh, method).mesh
    np.testing.assert_array_equal(after.points[mesh.fixed], mesh.points[mesh.fixed])
    assert min(least(after).values()) > min(least(mesh).values()) + 0.05
    assert after.quality().q_mean > mesh.quality().q_mean + 0.02


@pytest.mark.parametrize("method", ["getme", "getme-sequential"])
def test_getme_inverts_no_cell_of_another_kind(method):
    mesh = scrambled(mixed(4), 0.15, 4)
    assert not mesh.quality().inverted
    assert not hx.smooth(mesh, method).mesh.quality().inverted


def test_unrelated_methods_bring_the_scrambled_mesh_of_all_kinds_back_to_its_optimum():
    mend, patient = hx.METHODS["mend"](goal="shape"), hx.StoppingCriteria(max_iterations=5000, tolerance=1e-9)
    optimum = hx.smooth(make("mixed", size=500), mend, patient).mesh
    given = make("mixed", size=500, scramble=0.6, seed=1)
    assert sum(one["inverted"] > 0 for one in given.quality().cells.values()) == 3  # tetrahedra have fixed corners
    assert not optimum.quality().invalid
    for method in (mend, "local-mnr"):
        assert np.abs(hx.smooth(given, method, patient).mesh.points - optimum.points).max() < 1e-6


@pytest.mark.parametrize("method", ["mend", "local-nr", "laplacian"])
def test_the_boundary_of_all_kinds_slides_on_itself(method):
    mesh = mixed(4)
    points = mesh.points.copy()
    top = (points[:, 2] == 4) & (np.abs(points[:, :2] - 2) < 1.5).all(axis=1)
    points[top, :2] += np.random.default_rng(0).uniform(-0.3, 0.3, (top.sum(), 2))
    given = mesh.with_points(points)
    after = hx.smooth(given, method, boundary="slide").mesh
    np.testing.assert_allclose(after.points[mesh.points[:, 2] == 4, 2], 4, atol=0.1 if method == "mend" else 1e-9)
    assert np.abs(after.points - points)[top].max() > 0.05
    assert min(least(after).values()) > min(least(given).values())


def test_an_interface_between_kinds_is_kept_or_slides():
    mesh = mixed(4)
    cells = tuple(hx.Cells(c.kind, c.nodes, {"material": np.full(len(c.nodes), 2)}) for c in mesh.cells)
    mesh = scrambled(mesh.replace(hex_data={"material": np.ones(mesh.n_hexes)}, cells=cells), 0.2)
    between = np.intersect1d(mesh.hexes, mesh.elements[mesh.n_hexes :])
    np.testing.assert_array_equal(np.flatnonzero(mesh.materials.interface_nodes), between)
    kept = hx.smooth(mesh, "mend").mesh
    np.testing.assert_array_equal(kept.points[between], mesh.points[between])
    slid = hx.smooth(mesh.with_rules(interfaces="slide"), "mend").mesh
    assert (slid.points[between] != mesh.points[between]).any()
    assert slid.quality().q_mean >= kept.quality().q_mean


def test_pins_hold_nodes_of_all_kinds():
    mesh = scrambled(mixed(3), 0.2)
    pinned = mesh.free & (np.arange(mesh.n_nodes) % 2 == 0)
    after = hx.smooth(mesh.replace(pinned=pinned), "mend").mesh
    np.testing.assert_array_equal(after.points[pinned], mesh.points[pinned])
    assert (after.points != mesh.points).any()


def test_worst_cells_and_locked_ones_are_named_by_their_kind():
    mesh = mixed(2)
    points = mesh.points.copy()
    points[int(mesh.cells[1].nodes[0, -1]), 2] = 2.5  # an apex above the top
    worst = mesh.with_points(points).replace(pinned=np.ones(mesh.n_nodes, bool))
    which = worst.worst(6)
    assert set(kinds_of(worst.elements[which])) == {2, 3}
    assert any(one.describe(worst).startswith("Tetrahedron") for one in find_locking(worst).corners)


@pytest.mark.slow
def test_a_real_hybrid_mesh_gets_better_as_far_as_its_fixed_boundary_lets_it(real_mesh):
    mesh = hx.read(real_mesh("box_hybrid_mesh.vtu"))
    assert [mesh.n_hexes, mesh.n_elements] == [943, 943 + 7949 + 515]
    after = hx.smooth(mesh, "mend").mesh
    np.testing.assert_array_equal(after.points[mesh.fixed], mesh.points[mesh.fixed])
    assert not after.quality().invalid
    assert after.quality().scaled_jacobian_min > 5 * mesh.quality().scaled_jacobian_min
    assert after.quality().q_mean > mesh.quality().q_mean


@pytest.mark.slow
def test_a_real_hybrid_mesh_whose_boundary_slides_gets_better_in_every_kind(real_mesh):
    mesh = hx.read(real_mesh("box_hybrid_mesh.vtu"))
    after = hx.smooth(mesh, "mend", boundary="slide").mesh
    assert not after.quality().invalid
    before, now = least(mesh), least(after)
    assert set(now) == {SOLID_KINDS[k].name for k in (0, 2, 3)}
    assert all(now[kind] >= value for kind, value in before.items())
    assert now["tetrahedron"] > 0.05
