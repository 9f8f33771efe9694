"""Mid-nodes are moved until hexes are valid between sound corners, and put in order where the file has another one."""

import numpy as np
import pytest

from hexmend import fix_outside, io, smooth
from hexmend.doctor import repair
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.mesh.second_order.bernstein import coefficients, gradient, least_coefficients
from hexmend.mesh.second_order.mid_node_order import in_order
from hexmend.mesh.second_order.valid_mid_nodes import Patch
from hexmend.quality import summarise
from hexmend.quality.validity import Validity, certify, jacobian_bounds
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid, with_edge_midpoints

RNG = np.random.default_rng(5)


def inner_mid_nodes(mesh):
    """Mid-nodes that are not on the boundary, (k,): those whose corners are not in a common face of it."""
    faces = {frozenset(face) for face in mesh.topology.boundary_faces.tolist()}
    found = set()
    for row, mids in zip(mesh.hexes, mesh.mid_nodes, strict=True):
        for column in np.flatnonzero(mids >= 0):
            corners = set(row[MID_NODE_WEIGHTS[column] > 0].tolist())
            if not any(corners <= face for face in faces):
                found.add(int(mids[column]))
    return np.array(sorted(found))


def straight_inside(mesh):
    """A curved mesh whose mid-nodes inside are halfway between the corners, as where a generator curves boundaries."""
    points, inner = mesh.points.copy(), set(inner_mid_nodes(mesh).tolist())
    for row, mids in zip(mesh.hexes, mesh.mid_nodes, strict=True):
        for column in np.flatnonzero([node in inner for node in mids.tolist()]):
            points[mids[column]] = MID_NODE_WEIGHTS[column] @ points[row]
    return mesh.rebuilt(points=points)


def invalid_shell():
    """Thin hexes of 27 nodes of which those at the curved walls are invalid, also with mid-nodes halfway."""
    return straight_inside(curved_shell(27, through=6, around=2, along=2, outer=1.6))


def bent(amplitude):
    mesh = with_edge_midpoints(grid(3))
    points, inner = mesh.points.copy(), inner_mid_nodes(mesh)
    points[inner] += RNG.uniform(-amplitude, amplitude, (inner.size, 3))
    return mesh.rebuilt(points=points)


def test_coefficients_bound_the_jacobian_and_their_sum_has_the_gradient_of_differences():
    nodes = invalid_shell().points[np.column_stack([invalid_shell().hexes, invalid_shell().mid_nodes])]
    nodes, weights = nodes + RNG.normal(scale=0.05, size=nodes.shape), RNG.normal(size=(len(nodes), 216))
    mids = np.arange(8, 27)[None] + np.zeros((len(nodes), 1), int) + 27 * np.arange(len(nodes))[:, None]
    hexes = (np.arange(8)[None] + 27 * np.arange(len(nodes))[:, None]).astype(np.int32)
    points, mids = nodes.reshape(-1, 3), mids.astype(np.int32)
    bounds, least = jacobian_bounds(points, hexes, mids), least_coefficients(points, hexes, mids)
    assert (least <= bounds[:, 0] + 1e-9).all()
    values, cofactors = coefficients(nodes)
    slopes, move = gradient(weights, cofactors), RNG.normal(size=nodes.shape)
    ahead, behind = ((weights * coefficients(nodes + h * move)[0]).sum() for h in (1e-6, -1e-6))
    assert values.shape == (len(nodes), 216)
    assert (slopes * move).sum() == pytest.approx((ahead - behind) / 2e-6, rel=1e-6)


def test_the_barrier_has_the_gradient_of_differences():
    mesh = bent(0.3)
    free = np.zeros(mesh.n_nodes + 1, bool)
    free[inner_mid_nodes(mesh)] = True
    patch = Patch(mesh.points, mesh.hexes, mesh.mid_nodes, free)
    floors, move = patch.least(patch.start) + 0.05, RNG.normal(size=patch.start.shape)  # some are below their floor
    slopes = patch.barrier(patch.start, floors)[1]
    ahead, behind = (patch.barrier(patch.start + h * move, floors)[0] for h in (1e-7, -1e-7))
    assert (slopes * move).sum() == pytest.approx((ahead - behind) / 2e-7, rel=1e-4)


@pytest.mark.parametrize("make", [invalid_shell, lambda: bent(0.3)])
def test_hexes_become_valid_while_corners_and_boundary_stay(make):
    mesh = make()
    assert summarise(mesh).invalid > 0
    after, (finding,) = repair(mesh, ["mid-nodes"])
    assert finding.mendable
    assert (certify(after.points, after.hexes, after.mid_nodes) == Validity.VALID).all()
    stays = np.setdiff1d(np.arange(mesh.n_nodes), inner_mid_nodes(mesh))
    np.testing.assert_array_equal(after.points[stays], mesh.points[stays])


def test_no_hex_becomes_invalid_where_some_cannot_be_valid():
    mesh = invalid_shell()
    points, outer = mesh.points.copy(), int(mesh.mid_nodes[0, 4])
    points[outer] = mesh.points[mesh.hexes[0, 4]]  # a mid-node of the boundary, in a corner
    mesh = mesh.rebuilt(points=points)
    after, _ = repair(mesh, ["mid-nodes"])
    before, now = (certify(each.points, each.hexes, each.mid_nodes) for each in (mesh, after))
    assert not ((before == Validity.VALID) & (now != Validity.VALID)).any()
    assert 0 < (now != Validity.VALID).sum() < (before != Validity.VALID).sum()


def test_a_patch_is_raised_without_a_lower_hex():
    mesh = bent(0.4)
    free = np.zeros(mesh.n_nodes + 1, bool)
    free[inner_mid_nodes(mesh)] = True
    patch = Patch(mesh.points, mesh.hexes, mesh.mid_nodes, free)
    found = patch.improved(patch.start)
    assert (patch.least(found) >= patch.least(patch.start)).all()
    assert patch.least(found).min() > max(patch.least(patch.start).min(), 0)


@pytest.mark.parametrize("nodes", [20, 27])
def test_mid_nodes_in_the_order_of_another_program_are_exchanged_on_reading(nodes, tmp_path):
    mesh = curved_shell(nodes, through=2, around=3, along=2)
    swapped = mesh.mid_nodes[:, [0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7, *range(12, 19)]]
    io.write(tmp_path / "swapped.vtu", mesh.replace(mid_nodes=swapped))
    back = io.read(tmp_path / "swapped.vtu")
    np.testing.assert_array_equal(back.mid_nodes, mesh.mid_nodes)
    assert "order of another program" in back.notes[-1]
    assert not io.read(tmp_path / "swapped.vtu", as_is=True).notes
    assert in_order(mesh.points, mesh.hexes, mesh.mid_nodes) is None


def test_bent_hexes_are_no_other_order():
    mesh = bent(0.4)
    assert in_order(mesh.points, mesh.hexes, mesh.mid_nodes) is None
    assert in_order(mesh.points, mesh.hexes, np.full((mesh.n_hexes, 19), -1, np.int32)) is None


def test_smooth_moves_mid_nodes_after_the_corners_and_not_outside_its_region():
    mesh = invalid_shell()
    result = smooth(mesh)
    assert (result.before.invalid, result.after.invalid) == (8, 0)
    assert "Mid-nodes inside the mesh were moved, which made 8 hexes of second order valid." in result.message
    part = fix_outside(mesh, [0])
    after = smooth(part)
    assert 0 < after.after.invalid < 8
    for column, weights in enumerate(MID_NODE_WEIGHTS):
        outside = mesh.mid_nodes[part.pinned[mesh.hexes[:, weights > 0]].all(axis=1), column]
        np.testing.assert_array_equal(after.mesh.points[outside], mesh.points[outside])


def test_hexes_with_inverted_corners_beside_bent_ones_stay_as_they_are():
    mesh = bent(0.3)
    points, corner = mesh.points.copy(), int(mesh.hexes[13, 6])
    points[corner] += 1.5
    mesh = mesh.rebuilt(points=points)
    after, _ = repair(mesh, ["mid-nodes"])
    before, now = (certify(each.points, each.hexes, each.mid_nodes) == Validity.VALID for each in (mesh, after))
    assert now[before].all()
    np.testing.assert_array_equal(after.points[corner], points[corner])
