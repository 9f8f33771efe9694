"""Closest points against their optimality condition, and surfaces for sliding.

Curves that are marked by hand: kept when the boundary slides, stored in files, removed again.
"""

import itertools
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, FileError, MeshError, gallery, io, kernels
from hexmend.boundary import (
    ClosestPointTrees,
    NodeClass,
    PartitionedSurface,
    SlidingBoundary,
    boundary_of,
    boundary_with_kept_corners,
    classify,
)
from hexmend.boundary.marking import marked_segments, with_curve, without_curves
from hexmend.cli.main import main
from hexmend.io.surfaces.read import with_curves_of_file
from hexmend_app.features.curves.edge_path import curve_through, edge_path
from tests.core.boundary.solids import ball, cylinder, project, wavy
from tests.core.grids import grid


def brute(corners, x):
    """The point of a triangle or segment (2 or 3 corners) that is closest to x: the best of all its sides' own."""
    best = min(corners, key=lambda corner: np.linalg.norm(corner - x))
    for size in range(2, len(corners) + 1):
        for a, *others in itertools.combinations(corners, size):
            spanned = np.transpose(others) - a[:, None]
            weights = np.linalg.lstsq(spanned, x - a, rcond=None)[0]
            place = a + spanned @ weights
            inside = weights.min() >= 0 and weights.sum() <= 1
            if inside and np.linalg.norm(place - x) < np.linalg.norm(best - x):
                best = place
    return best


def random_pieces(seed, n, k, degenerate):
    """Pieces of a cloud in two groups: triangles and segments, on demand with triangles that are lines or points."""
    random = np.random.default_rng(seed)
    points = random.normal(size=(n, 3)) * [1, 1, random.choice([1, 1e-3, 0])]
    pieces = random.integers(0, n, (k, 3)).astype(np.int32)
    pieces[random.random(k) < 0.3, 2] = -1
    pieces = np.where(pieces < 0, pieces[:, [1]], pieces)
    if not degenerate:
        pieces = pieces[(pieces[:, 0] != pieces[:, 1]) & (pieces[:, 0] != pieces[:, 2])]
    pieces = np.concatenate([pieces, [[0, 1, 2]], [[0, 1, 1]]]).astype(np.int32)
    group = np.concatenate([random.integers(0, 2, len(pieces) - 2), [0, 1]])
    return points, pieces, group, random


@given(st.integers(0, 2**31), st.integers(4, 12), st.integers(0, 30), st.booleans())
def test_closest_points_are_those_of_brute_force(seed, n, k, degenerate):
    points, pieces, group, random = random_pieces(seed, n, k, degenerate)
    trees = ClosestPointTrees(points, pieces, group)
    x, of = 2 * random.normal(size=(6, 3)), random.integers(0, 2, 6)
    found = trees.closest(x, of)
    for i in range(6):
        distance = min(np.linalg.norm(brute(points[np.unique(piece)], x[i]) - x[i]) for piece in pieces[group == of[i]])
        assert np.linalg.norm(found.points[i] - x[i]) == pytest.approx(distance, rel=1e-12, abs=1e-12)
        piece = pieces[trees.order[found.pieces[i]]]
        assert group[trees.order[found.pieces[i]]] == of[i]
        np.testing.assert_allclose(found.weights[i] @ points[piece], found.points[i], atol=1e-12)
        assert found.weights[i].min() >= 0
        assert found.weights[i].sum() == pytest.approx(1, abs=1e-14)


@given(st.integers(0, 2**31), st.floats(0, 2))
def test_trees_whose_points_have_moved_find_what_new_ones_do_and_enough_is_enough(seed, enough):
    random = np.random.default_rng(seed)
    points, moved = random.normal(size=(2, 40, 3))
    pieces, group = random.integers(0, 40, (60, 3)).astype(np.int32), np.sort(random.integers(0, 3, 60) % 3)
    group[:3] = 0, 1, 2
    x, of = random.normal(size=(50, 3)), random.integers(0, 3, 50)
    new, refitted = (
        ClosestPointTrees(moved, pieces, group).closest(x, of),
        ClosestPointTrees(points, pieces, group).with_points(moved),
    )
    far, found = (np.linalg.norm(one.points - x, axis=1) for one in (new, refitted.closest(x, of)))
    np.testing.assert_allclose(found, far, rtol=1e-12, atol=1e-12)
    rough = np.linalg.norm(refitted.closest(x, of, enough).points - x, axis=1)
    assert (rough <= np.maximum(far, enough) + 1e-12).all()
    np.testing.assert_allclose(rough[far > enough], far[far > enough], rtol=1e-12)


def test_trees_that_threads_build_in_parts_are_those_of_one_thread_and_find_the_closest_of_all_pieces():
    random, n = np.random.default_rng(7), 20_000
    centres = random.normal(size=(n, 3))
    points = (centres[:, None] + 0.01 * random.normal(size=(n, 3, 3))).reshape(-1, 3)
    pieces, group = np.arange(3 * n, dtype=np.int32).reshape(-1, 3), np.zeros(n, dtype=np.int64)
    trees = ClosestPointTrees(points, pieces, group)
    assert np.array_equal(np.sort(trees.order), np.arange(n))
    with ThreadPoolExecutor() as pool:
        alone = pool.submit(lambda: (kernels.set_threads(1), ClosestPointTrees(points, pieces, group))[1]).result()
    for name in ("order", "boxes", "links", "roots"):
        np.testing.assert_array_equal(getattr(alone, name), getattr(trees, name))
    x = 2 * random.normal(size=(50, 3))
    found = np.linalg.norm(trees.closest(x, np.zeros(50, dtype=np.int64)).points - x, axis=1)
    for i in range(50):
        near = np.argsort(np.linalg.norm(centres - x[i], axis=1))[:200]  # pieces are smaller than the gaps between them
        one = ClosestPointTrees(points, pieces[near], group[near]).closest(x[i : i + 1], np.zeros(1, dtype=np.int64))
        assert found[i] == pytest.approx(np.linalg.norm(one.points[0] - x[i]), rel=1e-14)


def sliding(mesh, kinds=(NodeClass.CURVE, NodeClass.PATCH)):
    boundary = boundary_of(mesh)
    return boundary, PartitionedSurface(mesh.points, boundary), np.flatnonzero(np.isin(boundary.node_class, kinds))


@pytest.mark.parametrize("mesh", [grid(4, 3, 2), ball(6), cylinder(), wavy(grid(4), 0.3)], ids=lambda mesh: mesh.name)
def test_nodes_that_have_not_moved_stay_to_the_last_bit(mesh):
    _, surface, nodes = sliding(mesh)
    places, directions = project(surface, mesh.points[nodes], nodes)
    np.testing.assert_array_equal(places, mesh.points[nodes])
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1, rtol=1e-14)


@given(st.integers(0, 999), st.floats(0, 3))
def test_nodes_of_a_box_stay_in_their_planes_and_on_their_edges(seed, far):
    mesh = grid(4, 3, 5)
    boundary, surface, nodes = sliding(mesh)
    x = mesh.points[nodes]
    moved = x + far * np.random.default_rng(seed).normal(size=x.shape)
    places, directions = project(surface, moved, nodes)
    upper = np.array([4, 3, 5])
    held = (x == 0) | (x == upper)
    np.testing.assert_array_equal(places[held], x[held])
    np.testing.assert_allclose(places[~held], np.clip(moved, 0, upper)[~held], atol=1e-12)
    on_patch = boundary.node_class[nodes] == NodeClass.PATCH
    outward = np.where(x == 0, -1.0, np.where(x == upper, 1.0, 0.0))[on_patch]
    np.testing.assert_allclose(directions[on_patch], outward, atol=1e-14)
    np.testing.assert_allclose(np.abs(directions[~on_patch]), ~held[~on_patch], atol=1e-14)


def test_a_node_goes_to_its_own_patch_though_another_is_nearer():
    mesh = grid(4, 4, 1)
    _boundary, surface, nodes = sliding(mesh, (NodeClass.PATCH,))
    lower = nodes[mesh.points[nodes, 2] == 0]
    places, normals = project(surface, mesh.points[lower] + [0, 0, 0.9], lower)
    assert not places[:, 2].any()
    assert (normals[:, 2] == -1).all()


def test_nodes_of_a_loop_slide_around_it():
    mesh = cylinder(64, 4)
    _, surface, nodes = sliding(mesh, (NodeClass.CURVE,))
    upper = nodes[mesh.points[nodes, 2] == 1]
    x = mesh.points[upper]
    ahead = np.column_stack([-x[:, 1], x[:, 0], np.zeros(len(x))])
    places, tangents = project(surface, x + 0.3 * ahead + [0, 0, 0.2], upper)
    np.testing.assert_array_equal(places[:, 2], 1)
    radius = np.linalg.norm(places[:, :2], axis=1)
    assert (radius <= 1 + 1e-14).all()
    assert (radius >= np.cos(np.pi / 64) - 1e-14).all()
    around = np.column_stack([-places[:, 1], places[:, 0], 0 * radius]) / radius[:, None]
    assert np.abs(np.einsum("ij,ij->i", tangents, around)).min() > 1 - 1e-5
    _, plain = project(surface, x + 0.3 * ahead, upper, smooth=False)
    assert np.abs(np.einsum("ij,ij->i", plain, around)).min() < 1 - 1e-5


def test_normals_of_a_ball_come_nearer_to_its_radii_by_refinement_and_by_interpolation():
    def error(n, smooth):
        _, surface, nodes = sliding(ball(n))
        random = np.random.default_rng(0)
        nodes = random.choice(nodes, 2000)
        x = random.normal(size=(2000, 3))
        places, normals = project(surface, x, nodes, smooth)
        assert (np.linalg.norm(places, axis=1) <= 1 + 1e-14).all()
        return np.linalg.norm(normals - places / np.linalg.norm(places, axis=1, keepdims=True), axis=1).max()

    assert error(16, True) < 0.4 * error(8, True)
    assert error(16, True) < 0.3 * error(16, False)


def test_nodes_that_do_not_slide_and_invalid_positions_are_refused():
    mesh = grid(3)
    boundary, surface, nodes = sliding(mesh)
    (corner, *_), (inside, *_) = (
        np.flatnonzero(boundary.node_class == kind) for kind in (NodeClass.CORNER, NodeClass.INSIDE)
    )
    with pytest.raises(MeshError, match=rf"node {corner} \(counted from 0\) is of kind CORNER"):
        project(surface, mesh.points[[nodes[0], corner]], np.array([nodes[0], corner]))
    with pytest.raises(MeshError, match="of kind INSIDE"):
        project(surface, mesh.points[[inside]], np.array([inside]))
    with pytest.raises(MeshError, match=r"closest to the point \[nan"):
        project(surface, np.full((1, 3), np.nan), nodes[:1])
    assert len(project(surface, np.empty((0, 3)), nodes[:0])[0]) == 0


def as_triangles(mesh):
    """Divide the boundary's quads into two triangles each, with own numbering, as in a surface file."""
    nodes, faces = np.unique(mesh.topology.boundary_faces, return_inverse=True)
    quads = faces.reshape(-1, 4).astype(np.int32)
    return mesh.points[nodes], np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])


@pytest.mark.parametrize("fine", [grid(8, 8, 8), grid(2)], ids=["finer", "coarser"])
def test_nodes_slide_on_the_surface_of_a_file(fine):
    points, triangles = as_triangles(fine)
    points = 4 / points.max() * points
    mesh = grid(4)
    boundary = boundary_of(mesh)
    surface = PartitionedSurface(points, classify(points, triangles)).attached(mesh.points, boundary)
    np.testing.assert_array_equal(surface.node_class, boundary.node_class)
    own = PartitionedSurface(mesh.points, boundary)
    nodes = np.flatnonzero(boundary.node_class >= NodeClass.CURVE)
    x = mesh.points[nodes] + 0.3 * np.random.default_rng(0).normal(size=(len(nodes), 3))
    (places, there), (same, here) = project(surface, x, nodes), project(own, x, nodes)
    np.testing.assert_allclose(places, same, atol=1e-12)
    np.testing.assert_allclose(np.abs(there), np.abs(here), atol=1e-12)


def test_curve_nodes_slide_on_patches_where_a_surface_has_no_curve():
    mesh = cylinder()
    points, triangles = as_triangles(ball(8))
    surface = PartitionedSurface(points, classify(points, triangles)).attached(mesh.points, boundary_of(mesh))
    nodes = np.flatnonzero(mesh.topology.boundary)
    assert (surface.node_class[nodes] == NodeClass.PATCH).all()
    radius = np.linalg.norm(project(surface, mesh.points[nodes], nodes)[0], axis=1)
    assert radius.min() > 0.95
    assert radius.max() <= 1 + 1e-14


@pytest.fixture(scope="module")
def mesh():
    return ball(4)


@pytest.fixture(scope="module")
def chain(mesh):
    """A chain between two distant nodes of the smooth boundary."""
    on = np.flatnonzero(mesh.topology.boundary)
    x = mesh.points[on]
    start = int(on[x[:, 0].argmin()])
    return edge_path(mesh, start, int(on[x[:, 0].argmax()]))


def test_a_chain_goes_from_node_to_node_along_edges_of_the_boundary(mesh, chain):
    faces = {
        frozenset(pair)
        for face in mesh.topology.boundary_faces.tolist()
        for pair in zip(face, face[1:] + face[:1], strict=True)
    }
    assert len(chain) > 4
    assert all(frozenset(pair) in faces for pair in itertools.pairwise(chain))
    assert len(set(chain)) == len(chain)
    assert edge_path(mesh, chain[0], chain[0]) == (chain[0],)


def test_a_chain_follows_creases():
    mesh = grid(4)
    start, end = (int(np.abs(mesh.points - x).sum(axis=1).argmin()) for x in ([0, 0, 0], [4, 4, 0]))
    x = mesh.points[list(edge_path(mesh, start, end))]
    assert ((x == 0) | (x == 4)).sum(axis=1).min() >= 2


def test_marked_edges_are_a_curve_that_sliding_keeps(mesh, chain):
    assert (boundary_with_kept_corners(mesh, 40.0).node_class[list(chain)] == NodeClass.PATCH).any()
    marked = with_curve(mesh, chain)
    kinds = boundary_with_kept_corners(marked, 40.0).node_class
    assert (kinds[list(chain[1:-1])] == NodeClass.CURVE).all()
    sliding, inner = SlidingBoundary(marked), np.array(chain[1:-1])
    x = sliding.project(marked.points[inner] * 1.01 + 0.02, inner)
    a, b = marked.points[list(chain[:-1])], marked.points[list(chain[1:])]
    t = np.clip(np.einsum("kij,ij->ki", x[:, None] - a, b - a) / np.square(b - a).sum(axis=1), 0, 1)
    distances = np.linalg.norm(x[:, None] - (a + t[..., None] * (b - a)), axis=2).min(axis=1)
    assert distances.max() < 1e-9


def test_marks_are_removed_again(mesh, chain):
    marked = with_curve(with_curve(mesh, chain[:3]), chain)
    assert len(marked_segments(marked)) == len(chain) - 1
    assert len(marked.cells) == len(mesh.cells) + 1
    assert curve_through(marked, chain[2]) in (chain, chain[::-1])
    assert len(marked_segments(without_curves(marked, chain[:2]))) == len(chain) - 2
    assert without_curves(marked, chain).cells == mesh.cells
    assert without_curves(marked).cells == mesh.cells
    assert curve_through(mesh, chain[2]) == ()


def test_a_closed_curve_is_found_from_any_of_its_nodes():
    mesh = grid(3)
    corners = [int(np.abs(mesh.points - x).sum(axis=1).argmin()) for x in ([0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0])]
    chain = [corners[0]]
    for corner in (*corners[1:], corners[0]):
        chain += edge_path(mesh, chain[-1], corner)[1:]
    found = curve_through(with_curve(mesh, chain), chain[4])
    assert found[0] == found[-1] == chain[4]
    assert sorted(found[1:]) == sorted(chain[1:])


def test_marks_of_a_file_lose_only_their_flags(mesh, chain):
    lines = Cells("line", np.array([chain[:2], chain[1:3]], np.int32), {"medit:ridge": np.array([1, 0]), "medit:required": np.array([0, 1]), "medit:ref": np.array([7, 8])})  # fmt: skip
    given = mesh.replace(cells=(*mesh.cells, lines))
    (left,) = (cells for cells in without_curves(given, chain[1:3]).cells if cells.kind == "line")
    assert left.data["medit:ref"].tolist() == [7, 8]
    assert (left.data["medit:ridge"].tolist(), left.data["medit:required"].tolist()) == ([1, 0], [0, 0])


@pytest.mark.parametrize("suffix", [".mesh", ".vtu"])
def test_files_store_marks(mesh, chain, tmp_path, suffix):
    io.write(tmp_path / f"ball{suffix}", with_curve(mesh, chain))
    read = io.read(tmp_path / f"ball{suffix}")
    np.testing.assert_array_equal(marked_segments(read), marked_segments(with_curve(mesh, chain)))


def test_what_is_no_chain_is_refused(mesh, chain):
    with pytest.raises(MeshError, match=r"no edge of the boundary joins the nodes"):
        with_curve(mesh, (chain[0], chain[-1]))
    inside = int(np.flatnonzero(~mesh.topology.boundary)[0])
    with pytest.raises(MeshError, match=f"node {inside} .* is not on the boundary"):
        edge_path(mesh, chain[0], inside)


def test_the_command_line_reads_chains_of_a_file(mesh, chain, tmp_path, capsys, complaint):
    io.write(tmp_path / "ball.mesh", mesh)
    (tmp_path / "curves.txt").write_text(f"# one curve\n{' '.join(map(str, chain))}  # from end to end\n\n")
    words = ["smooth", str(tmp_path / "ball.mesh"), "-o", str(tmp_path / "out.mesh"), "--method", "laplacian"]
    words += ["--boundary", "slide", "--max-iterations", "2", "--ridges", str(tmp_path / "curves.txt")]
    assert main(words) == 0
    np.testing.assert_array_equal(
        marked_segments(io.read(tmp_path / "out.mesh")), marked_segments(with_curve(mesh, chain))
    )
    capsys.readouterr()
    (tmp_path / "curves.txt").write_text(f"{chain[0]}, {chain[-1]}\n")
    assert "curves.txt: line 1: no edge of the boundary joins" in complaint(*words, status=3)
    (tmp_path / "curves.txt").write_text("\n3 x\n")
    with pytest.raises(FileError, match=r"line 2: 'x' is not a node number"):
        with_curves_of_file(gallery.make("cube", size=27), tmp_path / "curves.txt")
