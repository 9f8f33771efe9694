"""Gallery meshes: counts, soundness, determinism, size."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import hexmend as hx
from hexmend import StoppingCriteria, find_layers, smooth, summarise
from hexmend.doctor import examine
from hexmend.gallery import GALLERY, make
from hexmend.gallery.aeroplane import FUSELAGE, TAILPLANE, WINGS
from hexmend.gallery.five_side import DIVISIONS
from hexmend.gallery.kershaw import kershaw_map
from hexmend.gallery.pentagon import CORNERS, corner_angles, fan, pair_triangles, pentagon, subdivide
from hexmend.gallery.plane import BOX
from hexmend.target import given_lengths
from hexmend_app.state.mesh.structure import find_structure

every = pytest.mark.parametrize("name", GALLERY)


COUNTS_OF_THE_THESIS = [
    ("five-side", 7350, 7350, 8711, 6119),  # the thesis's FiveSide4
    ("bridge-sharp", 32000, 32000, 35301, 28899),
    ("cube", 1000, 1000, 1331, 729),
]


@pytest.mark.parametrize(("name", "size", "hexes", "nodes", "free"), COUNTS_OF_THE_THESIS)
def test_counts_are_those_of_the_thesis(name, size, hexes, nodes, free):
    summary = summarise(make(name, size=size))
    assert (summary.hexes, summary.nodes, summary.free_nodes) == (hexes, nodes, free)
    assert summary.inverted == 0


def test_figures_are_near_those_of_the_thesis():
    five, bridge = summarise(make("five-side")), summarise(make("bridge-sharp"))
    assert (five.q_min, five.q_mean, five.q_norm) == pytest.approx((0.5038, 0.8343, 0.8177), abs=0.06)
    assert (bridge.q_min, bridge.q_mean, bridge.q_norm) == pytest.approx((0.1679, 0.8098, 0.6421), abs=0.025)


def test_the_sharp_bridge_gains_by_optimising_and_is_inverted_by_laplacian_smoothing():
    bridge = make("bridge-sharp", size=4000)
    before = summarise(bridge)
    after = smooth(bridge, "local-sd", StoppingCriteria(max_iterations=40)).after
    assert after.inverted == 0
    assert after.q_min > before.q_min + 0.05
    assert after.q_mean > before.q_mean + 0.03
    assert after.q_norm > before.q_norm + 0.1
    assert smooth(bridge, "laplacian", StoppingCriteria(keep_last=True)).after.inverted > 0


@pytest.mark.slow
@every
@settings(max_examples=5)
@given(size=st.integers(2000, 20_000))
def test_any_size_comes_near_and_is_sound(name, size):
    mesh = make(name, size=size)
    assert mesh.n_elements == pytest.approx(size, rel=0.3 if name != "kershaw" else 1)  # multiples of 6
    assert examine(mesh) == ()
    assert (summarise(mesh).inverted == 0) == (name != "plane")  # plane is made to be mended
    assert mesh.name == f"{name}-{mesh.n_elements}"


@every
def test_scrambling_is_deterministic_and_leaves_the_boundary(name):
    mesh, again, other, still = (
        make(name, size=500, scramble=amplitude, seed=seed)
        for amplitude, seed in ((0.5, 1), (0.5, 1), (0.5, 2), (0, 0))
    )
    np.testing.assert_array_equal(mesh.points, again.points)
    assert (mesh.points != other.points).any()
    np.testing.assert_array_equal(mesh.points[mesh.fixed], still.points[mesh.fixed])
    assert (mesh.points[mesh.free] != still.points[mesh.free]).any()


def test_sets_and_layers_name_the_parts():
    five = make("five-side")
    assert len(five.node_sets["bottom"]) == len(five.node_sets["top"]) == 281
    assert np.bincount(five.hex_data["layer"])[1:].tolist() == [245] * 30
    assert len(make("bridge-sharp").node_sets["arch"]) == 41 * 41


# Layered: the heights that its parameters name, on a cylinder, and layers that scrambling leaves near their places.


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


# The gallery mesh plane: figures, boundary, the inverted hexes and that they can be mended.


@pytest.fixture(scope="module")
def plane():
    return make("plane")


@pytest.mark.slow
def test_counts_and_qualities_are_near_those_of_the_thesis(plane):
    summary = summarise(plane)
    assert examine(plane) == ()
    assert summary.hexes == 31760
    assert summary.free_nodes == pytest.approx(30389, rel=0.005)
    assert summary.nodes == pytest.approx(33411, rel=0.01)
    assert summary.inverted == pytest.approx(163, abs=5)
    assert summary.locked_inverted == 0
    assert (summary.q_min, summary.q_mean, summary.q_std) == pytest.approx((0.0945, 0.8164, 0.1276), abs=0.1)
    assert summary.q_min > 0
    assert summary.q_mean == pytest.approx(0.8164, abs=0.005)


@pytest.mark.slow
def test_the_boundary_is_the_box_and_the_aeroplane(plane):
    on_body, on_box = (np.isin(np.arange(plane.n_nodes), plane.node_sets[name]) for name in ("aeroplane", "box"))
    assert not (on_body & on_box).any()
    np.testing.assert_array_equal(plane.topology.boundary, on_body | on_box)
    faces = plane.topology.boundary_faces
    assert (on_body[faces].all(axis=1) ^ on_box[faces].all(axis=1)).all()
    on_plane = np.isclose(plane.points[:, None, :], BOX).any(axis=(1, 2))
    np.testing.assert_array_equal(on_plane, on_box)


@pytest.mark.parametrize("size", [1000, pytest.param(31760, marks=pytest.mark.slow)])
def test_each_surface_is_closed_and_without_handles(size):
    mesh = make("plane", size=size)
    faces = mesh.topology.boundary_faces
    edges = np.concatenate([faces[:, [i, (i + 1) % 4]] for i in range(4)])
    for name in ("aeroplane", "box"):
        mine = np.isin(edges, mesh.node_sets[name]).all(axis=1)
        _, times = np.unique(np.sort(edges[mine], axis=1), axis=0, return_counts=True)
        assert (times == 2).all()
        assert len(mesh.node_sets[name]) - len(times) + mine.sum() // 4 == 2  # Euler: a sphere


def test_it_is_unstructured_and_its_sizes_range_widely(plane):
    edges = plane.topology.edges
    length = np.linalg.norm(np.diff(plane.points[edges], axis=1)[:, 0], axis=1)
    assert np.percentile(length, 99) > 10 * np.percentile(length, 1)
    inner = ~plane.topology.boundary
    valence = np.bincount(edges.ravel())[inner]
    assert {5, 6, 7} <= set(valence)  # 6 in a structured mesh
    assert np.count_nonzero(valence != 6) > 400


def test_the_aeroplane_has_wings_a_tailplane_and_a_fin(plane):
    x, y, z = plane.points[plane.node_sets["aeroplane"]].T
    assert np.ptp(x) == pytest.approx(1, abs=0.1)
    assert np.ptp(y) == pytest.approx(2 * WINGS.span, abs=0.05)
    tip = np.abs(y) > 0.9 * WINGS.span
    root = np.isclose(np.abs(y), FUSELAGE.radius, rtol=0.1)
    assert x[tip].min() > x[root & (x > WINGS.leading)].min() + 0.05  # swept
    tail = x > TAILPLANE.leading
    assert FUSELAGE.radius < np.abs(y[tail & ~tip]).max() < WINGS.span
    assert z[tail].max() > 2 * FUSELAGE.radius > z[~tail].max()


@pytest.mark.parametrize("size", [3000, pytest.param(8000, marks=pytest.mark.slow)])
def test_local_descent_mends_all(size):
    mesh = make("plane", size=size)
    result = hx.smooth(mesh, "local-sd", StoppingCriteria(max_iterations=60))
    before, after = summarise(mesh), summarise(result.mesh)
    assert before.inverted > 10
    assert after.inverted == 0
    assert after.q_min > max(before.q_min, 0.35)
    assert after.q_mean > before.q_mean + 0.04
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])


# Kershaw's map: the identity at eps = 1, planes that stay, and a lattice as the optimum with sliding planes.


def lattice(n):
    axes = np.linspace(0, 1, n + 1)
    return np.stack(np.meshgrid(axes, axes, axes, indexing="ij"), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize(("size", "n"), [(1, 6), (500, 6), (1728, 12), (3000, 12), (3500, 18), (13824, 24)])
def test_the_size_is_that_of_the_nearest_multiple_of_six(size, n):
    assert make("kershaw", size=size).n_hexes == n**3


@pytest.mark.parametrize("eps", [0.1, 0.3, 0.7])
def test_the_box_and_the_planes_of_x_stay_and_no_hex_is_inverted(eps):
    given = lattice(12)
    mapped = kershaw_map(given, eps)
    np.testing.assert_array_equal(mapped[:, 0], given[:, 0])
    for end in (0, 1):
        np.testing.assert_allclose(mapped[given == end], end, atol=1e-15)
    assert summarise(make("kershaw", size=1728, eps=eps)).inverted == 0


def test_the_first_layer_is_left_and_the_last_is_right():
    mapped = kershaw_map(np.array([[0, 0.5, 0.25], [1 / 6, 0.5, 0.25], [5 / 6, 0.5, 0.25], [1, 0.5, 0.25]]), 0.3)
    assert mapped[:, 1] == pytest.approx([0.15, 0.15, 0.85, 0.85])
    assert mapped[:, 2] == pytest.approx([0.075, 0.075, 0.425, 0.425])


def test_the_least_scaled_jacobian_is_the_published_one():
    assert summarise(make("kershaw", size=13824)).scaled_jacobian_min == pytest.approx(0.1660, abs=5e-5)


# The gallery mesh five-side: the counts of the thesis, quads that are convex, the prism; pairing of triangles.


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
def test_counts_of_the_five_side_are_those_of_the_thesis(size, quads, boundary, free):
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
