"""Curves that are marked by hand: kept when the boundary slides, stored in files, removed again."""

import itertools

import numpy as np
import pytest

from hexmend import Cells, FileError, MeshError, gallery, io
from hexmend.boundary import NodeClass, SlidingBoundary, boundary_with_kept_corners
from hexmend.boundary.marking import marked_segments, with_curve, without_curves
from hexmend.cli.main import main
from hexmend.io.surfaces.read import with_curves_of_file
from hexmend_app.features.curves.edge_path import curve_through, edge_path
from tests.core.boundary.solids import ball
from tests.core.grids import grid


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
