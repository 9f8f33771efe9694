"""Every metric: known values, declarations, invariances, and hexes for which it is undefined."""

import math
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METRICS, Target, measure
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, DIAGONALS, EDGES, FACES, UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_NODE_POSITIONS, jacobian_range
from hexmend.quality import ElementQuality, MetricStatistics, metric_statistics, rank_worst
from hexmend.quality.corner_heights import least_heights
from hexmend.quality.validity import Validity, certify
from hexmend.target import given_lengths, make_target
from tests.core.grids import grid, scrambled
from tests.core.layers.stacks import scrambled_in_layers, stack

ONE = np.arange(8, dtype=np.int32)[None]


def value(name, x):
    return METRICS[name].of(x, ONE, measure(x, ONE))[0]


def every(x):
    return {name: value(name, x) for name in METRICS}


SHEAR = np.array([[1, 0, 0], [1, 1, 0], [0, 0, 1]])  # rows: y leans by 45 degrees towards x

KNOWN = {
    "cube": (UNIT_CUBE, {
        "q": 1, "scaled-jacobian": 1, "shape": 1, "condition": 1, "jacobian": 1, "volume": 1, "edge-ratio": 1,
        "aspect-ratio": 1, "stretch": 1, "diagonal": 1, "skew": 0, "taper": 0, "warpage": 0, "min-angle": 90,
        "max-angle": 90,
    }),
    "stretched": (UNIT_CUBE * [2, 1, 1], {
        "q": 2 ** (2 / 3) / 2, "scaled-jacobian": 1, "shape": 2 ** (2 / 3) / 2, "condition": math.sqrt(6) * 1.5 / 3,
        "jacobian": 2, "volume": 2, "edge-ratio": 2, "aspect-ratio": 2, "stretch": math.sqrt(3 / 6), "diagonal": 1,
        "skew": 0, "taper": 0, "warpage": 0, "min-angle": 90, "max-angle": 90,
    }),
    "sheared": (UNIT_CUBE @ SHEAR, {
        "q": 0.75, "scaled-jacobian": math.sqrt(0.5), "shape": 0.75, "condition": 4 / 3, "jacobian": 1, "volume": 1,
        "edge-ratio": math.sqrt(2), "aspect-ratio": math.sqrt(2), "stretch": math.sqrt(3 / 6),
        "diagonal": math.sqrt(2 / 6), "skew": math.sqrt(0.5), "taper": 0, "warpage": 0, "min-angle": 45,
        "max-angle": 135,
    }),
    "parallelepiped": (UNIT_CUBE @ [[1, 0, 0], [0.5, math.sqrt(3) / 2, 0], [0, 0, 2]], {
        "volume": math.sqrt(3), "jacobian": math.sqrt(3), "edge-ratio": 2, "aspect-ratio": 2, "skew": 0.5,
        "min-angle": 60, "max-angle": 120, "diagonal": math.sqrt(5 / 7), "stretch": math.sqrt(3 / 7), "taper": 0,
    }),
    "frustum": (UNIT_CUBE * 2 - [1, 1, 0] - (UNIT_CUBE * 2 - 1) * UNIT_CUBE[:, 2:] * [0.5, 0.5, 0], {
        "volume": 2 / 3 * (4 + 1 + 2), "taper": 1 / 3, "skew": 0, "aspect-ratio": 4 / 3, "warpage": 0,
        "edge-ratio": math.sqrt(4.5), "jacobian": 2,
    }),
    "flat": (UNIT_CUBE * [1, 1, 0], {
        "q": 0, "scaled-jacobian": 0, "shape": 0, "condition": math.inf, "jacobian": 0, "volume": 0,
        "edge-ratio": math.inf, "aspect-ratio": math.inf, "stretch": 0, "diagonal": 1, "skew": 1, "taper": math.inf,
        "warpage": 2, "min-angle": 0, "max-angle": 180,
    }),
    "in one place": (UNIT_CUBE * 0 + 3, {
        "q": 0, "scaled-jacobian": 0, "shape": 0, "condition": math.inf, "jacobian": 0, "volume": 0,
        "edge-ratio": math.inf, "aspect-ratio": math.inf, "stretch": 0, "diagonal": 0, "skew": 1, "taper": math.inf,
        "warpage": 2, "min-angle": 0, "max-angle": 180,
    }),
    "inside out": (UNIT_CUBE * [-1, 1, 1], {
        "q": 0, "scaled-jacobian": -1, "shape": 0, "condition": math.inf, "jacobian": -1, "volume": -1,
        "edge-ratio": 1, "aspect-ratio": 1, "stretch": 1, "diagonal": 1, "skew": 0, "taper": 0, "warpage": 0,
        "min-angle": 90, "max-angle": 90,
    }),
}  # fmt: skip


@pytest.mark.parametrize("name", KNOWN)
def test_known_values(name):
    x, expected = KNOWN[name]
    values = every(np.array(x, float))
    assert {key: values[key] for key in expected} == pytest.approx(expected, rel=1e-12, abs=1e-12)


def by_plain_arithmetic(x):
    """Compute every metric of a hex that is not flat by the formulas of the manual."""
    edges, diagonals = (np.linalg.norm(x[pairs[:, 1]] - x[pairs[:, 0]], axis=1) for pairs in (EDGES, DIAGONALS))
    sides = (2 * UNIT_CUBE - 1).T
    axes, crossing = sides @ x, sides * sides[[1, 2, 0]] @ x
    long, other = np.linalg.norm(axes, axis=1), np.linalg.norm(crossing, axis=1)
    skew = [abs(axes[i] @ axes[j]) / (long[i] * long[j]) for i, j in ((0, 1), (1, 2), (2, 0))]
    taper = [other[i] / min(long[i], long[j]) for i, j in ((0, 1), (1, 2), (2, 0))]
    S = [np.column_stack([x[k] - x[t[0]] for k in t[1:]]) for t in CORNER_TETRAHEDRA]
    sound = min(map(np.linalg.det, S)) > 0
    shape = [3 * np.linalg.det(s) ** (2 / 3) / np.square(s).sum() if sound else 0 for s in S]
    condition = [np.linalg.norm(s) * np.linalg.norm(np.linalg.inv(s)) / 3 if sound else math.inf for s in S]
    warpage, angles, volume = [], [], 0
    for face in FACES:
        y = x[face]
        ahead, back = np.roll(y, -1, axis=0) - y, np.roll(y, 1, axis=0) - y
        normals = np.cross(ahead, back)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        warpage.append(1 - min(normals[0] @ normals[2], normals[1] @ normals[3]) ** 3)
        lengths = np.linalg.norm(ahead, axis=1) * np.linalg.norm(back, axis=1)
        angles += np.degrees(np.arccos((ahead * back).sum(axis=1) / lengths)).tolist()
        middle = y.mean(axis=0)  # (a + b + c + d)/4: four tetrahedra with it and the origin
        volume += sum(np.linalg.det([y[k], y[(k + 1) % 4], middle]) for k in range(4)) / 6
    return {
        "edge-ratio": edges.max() / edges.min(), "stretch": math.sqrt(3) * edges.min() / diagonals.max(),
        "diagonal": diagonals.min() / diagonals.max(), "aspect-ratio": long.max() / long.min(), "skew": max(skew),
        "taper": max(taper), "shape": min(shape), "condition": max(condition), "warpage": max(warpage),
        "min-angle": min(angles), "max-angle": max(angles), "volume": volume,
    }  # fmt: skip


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.2, 0.7]))
def test_metrics_are_those_of_plain_arithmetic(seed, amplitude):
    x = UNIT_CUBE + np.random.default_rng(seed).uniform(-amplitude, amplitude, (8, 3))
    expected = by_plain_arithmetic(x)
    values = every(x)
    assert {name: values[name] for name in expected} == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_a_mesh_of_no_hexes_has_no_values():
    none = np.empty((0, 8), np.int32)
    figures = measure(UNIT_CUBE, none)
    assert {metric.of(UNIT_CUBE, none, figures).shape for metric in METRICS.values()} == {(0,)}


@given(st.integers(0, 2**32 - 1), st.sampled_from([0, 1e-310, 1e-200, 1e-60, 1, 1e60, 1e110, 1e200, 1e307]))
def test_finite_points_have_values_in_range_and_none_is_nan(seed, scale):
    random = np.random.default_rng(seed)
    x = random.integers(-1, 2, (8, 3)) * scale * random.choice([1.0, 1e-8], (8, 1))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        values = every(x)
    for name in set(METRICS) - {"q", "scaled-jacobian"}:
        low, high = METRICS[name].full_range
        assert low - 1e-12 <= values[name] <= high + 1e-12, name


@pytest.mark.parametrize("metric", METRICS.values(), ids=METRICS)
def test_metrics_declare_what_they_are_and_stay_in_range(metric):
    mesh = scrambled(grid(3), 0.6)
    values = metric.of(mesh.points, mesh.hexes, measure(mesh.points, mesh.hexes))
    assert METRICS[metric.name] is metric
    assert metric.formula
    assert metric.source
    assert metric.meaning.endswith(".")
    assert metric.better in (-1, 0, 1)
    assert len(metric.title) <= 16
    assert values.shape == (27,)
    assert values.dtype == np.float64
    low, high = metric.full_range
    assert (values >= low - 1e-12).all()
    assert (values <= high + 1e-12).all()
    assert low <= metric.acceptable[0] < metric.acceptable[1] <= high


def test_cubes_are_acceptable_and_what_is_worse_is_counted():
    mesh = grid(3)
    assert {spread.unacceptable for spread in metric_statistics(mesh).values()} == {0}
    assert MetricStatistics.over(METRICS["edge-ratio"], np.array([1, 5, 6, math.inf])) == MetricStatistics(
        1.0, 4.0, 6.0, 1, 2
    )
    assert MetricStatistics.over(METRICS["condition"], np.array([math.inf])) == MetricStatistics(None, None, None, 1, 1)
    assert MetricStatistics.over(METRICS["volume"], np.array([-1.0, 2.0])).unacceptable == 1
    assert MetricStatistics.over(METRICS["shape"], np.array([0.2, 1 + 1e-15])).unacceptable == 1


def test_volumes_of_a_mesh_add_up_to_that_of_its_box():
    mesh = scrambled(grid(4), 0.3)
    assert METRICS["volume"].of(mesh.points, mesh.hexes, None).sum() == pytest.approx(64)


# Order of the worst hexes.


@given(st.integers(0, 2**32 - 1), st.integers(0, 40), st.sampled_from([1, -1]))
def test_the_worst_are_inverted_then_invalid_inside_then_the_lowest(seed, count, better):
    random = np.random.default_rng(seed)
    values, jacobian = random.integers(0, 6, (2, 30)) / 5.0
    sigma = random.choice([-1.0, 1.0], 30, p=[0.3, 0.7])
    inside = np.where(random.random(30) < 0.2, Validity.INVALID_INSIDE, Validity.VALID)
    validity = np.where(sigma <= 0, Validity.INVERTED, inside).astype(np.uint8)
    figures = ElementQuality(values, sigma, jacobian, values, validity)
    got = rank_worst(values, figures, count, better)
    order = [Validity.INVERTED, Validity.INVALID_INSIDE, Validity.VALID]
    everything = sorted(range(30), key=lambda h: (order.index(validity[h]), better * values[h], jacobian[h], h))
    assert got.tolist() == everything[:count]


def test_what_has_no_value_is_the_worst_whichever_way_is_better():
    values = np.array([0.5, np.nan, 3.0, np.inf])
    figures = ElementQuality(values, np.ones(4), np.zeros(4), values, np.zeros(4, np.uint8))
    assert rank_worst(values, figures, 4).tolist() == [1, 0, 2, 3]
    assert rank_worst(values, figures, 3, better=-1).tolist() == [1, 3, 2]
    assert np.isnan(values[1])  # not written into


@pytest.mark.parametrize("count", [0, 1, 7, 100, 2_999, 3_000, 4_000])
@pytest.mark.parametrize("levels", [2, 40, 10**9])
def test_of_many_hexes_the_worst_are_found_without_sorting_all(count, levels):
    random = np.random.default_rng(count)
    q, scaled = (random.integers(0, levels, 3_000) / levels for _ in range(2))
    order = np.lexsort((np.arange(3_000), scaled, q))
    valid = np.zeros(3_000, bool)
    figures = SimpleNamespace(q=q, scaled_jacobian=scaled, inverted=valid, invalid=valid)
    assert rank_worst(q, figures, count).tolist() == order[:count].tolist()


# Metrics against the target of a mesh: perfect where hexes are as the target wants them, and neutral without one.


def values(mesh, name):
    return METRICS[name].values(mesh, measure(mesh.points, mesh.hexes))


@pytest.mark.parametrize("name", ["q-of-target", "size-against-target", "aspect-against-given"])
def test_blocks_as_the_target_wants_them_are_perfect(name):
    mesh = stack()
    np.testing.assert_allclose(values(mesh.with_element_target(make_target(mesh, "given")), name), 1)


def test_without_a_target_q_is_that_of_cubes_and_the_others_are_one():
    mesh = scrambled_in_layers(stack(), 0.3)
    np.testing.assert_array_equal(values(mesh, "q-of-target"), values(mesh, "q"))
    assert (values(mesh, "size-against-target") == 1).all()
    assert (values(mesh, "aspect-against-given") == 1).all()


def test_sizes_and_proportions_are_relative_to_the_target():
    mesh = stack()
    lengths = given_lengths(mesh)
    larger = mesh.with_element_target(Target(lengths / 2))
    np.testing.assert_allclose(values(larger, "size-against-target"), 2)
    np.testing.assert_allclose(values(larger, "aspect-against-given"), 1)
    np.testing.assert_allclose(values(larger, "q-of-target"), 1)
    flatter = mesh.with_element_target(Target(lengths * [1, 1, 8]))
    np.testing.assert_allclose(values(flatter, "size-against-target"), 0.5)
    np.testing.assert_allclose(values(flatter, "aspect-against-given"), 8)
    assert (values(flatter, "q-of-target") < 0.5).all()


def test_a_hex_without_extent_has_the_worse_end():
    mesh = stack(2, 2, 5)
    flat = mesh.with_element_target(make_target(mesh, "given")).with_points(mesh.points * [1, 1, 0])
    assert np.isposinf(values(flat, "aspect-against-given")).all()
    assert (values(flat, "size-against-target") == 0).all()


# Time step, Jacobian ratio and mid-node offset: hand-computed values, and second-order hexes.


HEX = np.arange(8)[None]


def second_order(width=20, shift=None):
    """A unit cube of 20 or 27 nodes; `shift` moves nodes, {number: vector}."""
    points = np.concatenate([UNIT_CUBE, MID_NODE_POSITIONS])[:width].copy()
    for node, vector in (shift or {}).items():
        points[node] += vector
    mid = np.full((1, 19), -1, np.int32)
    mid[0, : width - 8] = np.arange(8, width)
    return Mesh(points, HEX, mid_nodes=mid)


LEAST_HEIGHTS = [
    (UNIT_CUBE, 1.0),
    (UNIT_CUBE * [3, 2, 0.5], 0.5),
    (UNIT_CUBE @ [[1, 0, 0], [1, 1, 0], [0, 0, 1]], math.sqrt(0.5)),  # leans by 45 degrees
    (UNIT_CUBE * [-1, 1, 1], -1.0),
    (UNIT_CUBE * [1, 1, 0], 0.0),
    (UNIT_CUBE * 1e-200, 1e-200),
    (UNIT_CUBE * 1e200, 1e200),
]


@pytest.mark.parametrize(("x", "height"), LEAST_HEIGHTS)
def test_the_least_height_is_that_over_the_largest_face(x, height):
    assert least_heights(np.array(x, float), HEX)[0] == pytest.approx(height)


def test_the_height_of_a_parallelepiped_is_its_volume_over_its_largest_face():
    axes = np.random.default_rng(3).normal(size=(20, 3, 3))
    axes[np.linalg.det(axes) < 0, 0] *= -1
    for a in axes:
        faces = np.linalg.norm([np.cross(a[0], a[1]), np.cross(a[1], a[2]), np.cross(a[2], a[0])], axis=1)
        assert least_heights(UNIT_CUBE @ a, HEX)[0] == pytest.approx(np.linalg.det(a) / faces.max())


def test_the_jacobian_ratio_of_a_frustum_is_that_of_its_ends():
    x = UNIT_CUBE.copy()
    x[4:, :2] = x[4:, :2] / 2 + 0.25  # the upper square has half the edges
    mesh = Mesh(x, HEX)
    assert mesh.quality("jacobian-ratio")[0] == pytest.approx(4)
    flat = Mesh(UNIT_CUBE * [1, 1, 0], HEX)
    assert flat.quality("jacobian-ratio")[0] == math.inf


@pytest.mark.parametrize("width", [20, 27])
def test_straight_second_order_hexes_are_perfect(width):
    mesh = second_order(width)
    assert mesh.quality("jacobian-ratio")[0] == pytest.approx(1)
    assert mesh.quality("mid-node-offset")[0] == pytest.approx(0, abs=1e-15)
    np.testing.assert_allclose(jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes), [[1, 1]])


@pytest.mark.parametrize("width", [20, 27])
def test_a_mid_node_at_a_quarter_has_an_offset_of_a_quarter(width):
    mesh = second_order(width, {8: [-0.25, 0, 0]})
    assert mesh.quality("mid-node-offset")[0] == pytest.approx(0.25)
    least = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes)[0, 0]
    assert least == pytest.approx(0, abs=1e-12)  # singular at the edge's end
    assert mesh.quality("jacobian-ratio")[0] > 1e6


def test_the_ratio_counts_nodes_and_gauss_points():
    mesh = second_order(20, {8: [-0.3, 0, 0]})
    at_nodes, at_gauss = (
        jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes, nodes=nodes, gauss=not nodes) for nodes in (True, False)
    )
    both = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes)
    assert both[0, 0] == min(at_nodes[0, 0], at_gauss[0, 0]) < 0 < at_gauss[0, 0]
    assert both[0, 1] == max(at_nodes[0, 1], at_gauss[0, 1])
    assert mesh.quality("jacobian-ratio")[0] == math.inf
    assert (
        certify(mesh.points, mesh.hexes, mesh.mid_nodes)[0] == Validity.INVERTED
    )  # at the corner whose edge is curved
