"""The gallery mesh five-side: the counts of the thesis, quads that are convex, the prism; pairing of triangles."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.gallery.five_side import DIVISIONS
from hexmend.gallery.pentagon import CORNERS, corner_angles, fan, pair_triangles, pentagon, subdivide
from hexmend.quality import summarise
from hexmend_app.state.mesh.structure import find_structure

#: The thesis's FiveSide4, 5, 6, 60k, 90k and 110k: hexes, quads, boundary nodes of the quads' mesh, free nodes.
THESIS = [
    (7350, 245, 70, 6119),
    (16650, 555, 106, 14587),
    (44400, 555, 106, 39737),
    (62350, 1247, 146, 57575),
    (85400, 2135, 226, 78897),
    (110450, 2209, 196, 103488),
]


def outline(quads):
    """Return the nodes of edges of only one quad."""
    sides = np.sort(np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1)
    sides, times = np.unique(sides, axis=0, return_counts=True)
    assert times.max() == 2
    return np.unique(sides[times == 1])


def area(points, quads):
    a, b, c, d = (points[quads[:, i]] for i in range(4))
    (px, py), (qx, qy) = (c - a).T, (d - b).T
    return (px * qy - py * qx).sum() / 2


@pytest.mark.slow
@pytest.mark.parametrize(("size", "quads", "boundary", "free"), THESIS)
def test_counts_are_those_of_the_thesis(size, quads, boundary, free):
    mesh = make("five-side", size=size)
    summary = summarise(mesh)
    assert (summary.hexes, summary.free_nodes, summary.inverted) == (size, free, 0)
    floor = mesh.node_sets["bottom"]
    assert len(floor) == quads + boundary // 2 + 1
    assert len(outline(mesh.hexes[:quads, :4])) == boundary
    assert np.bincount(mesh.hex_data["layer"])[1:].tolist() == [quads] * (size // quads)


@given(quads=st.integers(45, 300), share=st.floats(0.8, 1.1), jitter=st.floats(0.05, 0.7), seed=st.integers(0, 100))
def test_a_pentagon_has_the_quads_asked_for_and_they_are_convex(quads, share, jitter, seed):
    boundary = 2 * round(2.2 * share * quads**0.5)
    points, found = pentagon(quads, boundary, jitter, seed)
    assert len(found) == quads
    assert len(points) == quads + boundary // 2 + 1
    np.testing.assert_array_equal(outline(found), np.arange(boundary))
    assert corner_angles(points, found).min() > 0
    assert corner_angles(points, found).max() < np.pi
    np.testing.assert_allclose(corner_angles(points, found).sum(axis=1), 2 * np.pi)
    assert area(points, found) == pytest.approx(2.5 * np.sin(0.4 * np.pi))
    valence = np.bincount(found.ravel())
    assert (valence[boundary:] >= 3).all()
    assert np.count_nonzero(valence[:boundary] == 1) == 5  # the corners
    assert set(valence[:boundary]) == {1, 2}


@pytest.mark.parametrize("times", [1, 2, 5])
def test_quads_are_divided_and_the_outline_stays(times):
    for coarse in (fan(), pentagon(60, 34)):
        points, quads = subdivide(*coarse, times)
        assert len(quads) == len(coarse[1]) * times**2
        assert len(outline(quads)) == times * len(outline(coarse[1]))
        assert corner_angles(points, quads).max() < np.pi
        assert area(points, quads) == pytest.approx(area(*coarse))


@pytest.mark.parametrize("size", [5, 60, 900, 3000])
def test_any_size_comes_near(size):
    mesh = make("five-side", size=size)
    assert mesh.n_hexes == pytest.approx(size, rel=0.35)
    assert summarise(mesh).inverted == 0


def test_it_is_a_turned_and_tapered_prism():
    mesh = make("five-side", size=1000, height=2.0, turn=30.0, taper=0.5)
    bottom, top = (mesh.points[mesh.node_sets[name]] for name in ("bottom", "top"))
    assert np.ptp(bottom[:, 2]) == np.ptp(top[:, 2]) == 0
    assert top[0, 2] - bottom[0, 2] == pytest.approx(2)
    to = bottom[:, :2] @ [1, 1j]
    np.testing.assert_allclose(top[:, :2] @ [1, 1j], 0.5 * np.exp(1j * np.pi / 6) * to, atol=1e-12)
    for corner in CORNERS:
        assert np.linalg.norm(bottom[:, :2] - corner, axis=1).min() == pytest.approx(0, abs=1e-12)


def test_irregular_edges_stand_upright_and_end_on_the_boundary():
    mesh = make("five-side")
    found = find_structure(mesh)
    layers = DIVISIONS[7350].layers
    assert len(found.interior)
    assert len(found.interior) % layers == 0
    assert set(found.interior_valence.tolist()) <= {3, 5, 6}
    assert not len(found.nodes)


def test_triangles_of_squares_are_paired_to_squares():
    points = np.array([(i // 2, i % 2) for i in range(10)], dtype=float)
    triangles = np.array([c for a, b in pairwise(range(0, 10, 2)) for c in ((a, b, b + 1), (a, b + 1, a + 1))])
    quads = pair_triangles(points, triangles, np.full(10, 9))
    np.testing.assert_allclose(corner_angles(points, quads), np.pi / 2)
    assert np.unique(quads, axis=0).shape == (4, 4)


def test_triangles_without_a_perfect_matching_are_not_paired():
    points = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (-1, 1)], dtype=float)
    triangles = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4)])
    assert pair_triangles(points, triangles, np.full(5, 9)) is None
    assert pair_triangles(points, triangles[:2], np.full(5, 9)) is not None
    assert pair_triangles(points, triangles[:2], np.zeros(5)) is None  # node 0 would lose an edge
