"""Quality of hexes with known values, and its invariances."""

import dataclasses
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import energies
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE
from hexmend.mesh.orientation import MIRRORED_CORNERS, left_handed_hexes
from hexmend.quality import METRICS, SUMMARY_QUANTITIES, corner_determinants, locked_hexes, measure, summarise
from tests.core.grids import displaced, grid, scrambled

ONE = np.arange(8, dtype=np.int32)[None]


def by_the_book(x):
    """q, sigma, scaled Jacobian and eta of one hex, straight from (2.8)-(2.10) and (B.20)."""
    q, sigma, jacobian, eta = [], [], [], []
    for a, b, c, d in CORNER_TETRAHEDRA:
        S = np.column_stack([x[b] - x[a], x[c] - x[a], x[d] - x[a]])
        det, square = np.linalg.det(S), (S**2).sum()
        sigma.append(det)
        jacobian.append(det / np.prod(np.linalg.norm(S, axis=0)))
        q.append(3 * det ** (2 / 3) / square if det > 0 else 0)
        eta.append(square / (3 * det ** (2 / 3)) if det > 0 else np.inf)
    return np.mean(q), min(sigma), min(jacobian), np.mean(eta) - 1


@pytest.mark.parametrize("flat", [UNIT_CUBE * [1, 1, 0], UNIT_CUBE * [1, 0, 0], UNIT_CUBE * 0])
def test_a_collapsed_hex_is_inverted_and_has_no_quality(flat):
    figures = measure(flat, ONE)
    assert figures.q[0] == 0
    assert figures.sigma[0] == 0
    assert figures.scaled_jacobian[0] == 0
    assert figures.eta[0] == np.inf
    assert figures.n_inverted == 1


@given(st.integers(0, 2**32 - 1), st.floats(0, 1.5))
def test_figures_are_those_of_the_book(seed, amplitude):
    x = UNIT_CUBE + np.random.default_rng(seed).uniform(-amplitude, amplitude, (8, 3))
    figures = measure(x, ONE)
    q, sigma, jacobian, eta = by_the_book(x)
    np.testing.assert_allclose(
        [figures.q[0], figures.sigma[0], figures.scaled_jacobian[0]], [q, sigma, jacobian], rtol=1e-9, atol=1e-11
    )
    assert (figures.eta[0] == np.inf) == (eta == np.inf)
    if eta < np.inf:
        assert figures.eta[0] == pytest.approx(eta, rel=1e-8, abs=1e-12)
    assert 0 <= figures.q[0] <= 1 + 1e-14
    assert -1 - 1e-14 <= figures.scaled_jacobian[0] <= 1 + 1e-14


def determinants_term_by_term(x):
    """sigma at the eight corners of hexes (k, 8, 3): u . (v x w), every operation rounded on its own."""
    a, b, c, d = np.moveaxis(x[:, CORNER_TETRAHEDRA], (2, 3), (0, 1))  # each (3, k, 8)
    (ux, uy, uz), (vx, vy, vz), (wx, wy, wz) = b - a, c - a, d - a
    return ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx)


@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([1e-100, 1e-8, 1.0, 1e5, 1e90]),
    st.sampled_from(["any", "flat", "thirds"]),
)
def test_determinants_are_those_of_plain_arithmetic_to_the_last_bit(seed, scale, kind):
    random = np.random.default_rng(seed)
    x = {
        "any": lambda: UNIT_CUBE + random.uniform(-1, 1, (21, 8, 3)),
        "flat": lambda: (
            (UNIT_CUBE * [1, 1, 0] + random.integers(-1, 2, (21, 8, 3)) * [1, 1, 0]) @ random.normal(size=(3, 3))
        ),
        "thirds": lambda: random.integers(-2, 3, (21, 8, 3)) / 3,  # many corners are flat, or would be but for rounding
    }[kind]()
    points, hexes = (x * scale).reshape(-1, 3), np.arange(21 * 8, dtype=np.int32).reshape(21, 8)
    expected = determinants_term_by_term(x * scale)
    sigma = corner_determinants(points, hexes)
    np.testing.assert_array_equal(sigma, expected)
    np.testing.assert_array_equal(measure(points, hexes).sigma, sigma.min(axis=1))
    np.testing.assert_array_equal(measure(points, hexes).inverted, (expected <= 0).any(axis=1))
    which = np.flatnonzero(random.random(21) < 0.3)
    np.testing.assert_array_equal(corner_determinants(points, hexes, which), expected[which])


@pytest.mark.parametrize("scale", [1e-320, 1e-110, 1e102, 1e103, 1e150, 1e200, 1e307])
def test_figures_of_finite_points_are_numbers_in_range_however_large_or_small(scale):
    for seed in range(100):
        x = (UNIT_CUBE + np.random.default_rng(seed).uniform(-1, 1, (8, 3))) * scale
        figures = measure(x, ONE)
        assert 0 <= figures.q[0] <= 1 + 1e-14
        assert -1 - 1e-14 <= figures.scaled_jacobian[0] <= 1 + 1e-14
        assert figures.eta[0] >= 0
        assert not np.isnan(figures.sigma[0])


def test_a_mesh_of_no_hexes_has_no_figures():
    none = np.empty((0, 8), np.int32)
    assert measure(UNIT_CUBE, none).q.shape == (0,)
    assert corner_determinants(UNIT_CUBE, none).shape == (0, 8)


def test_energy_is_softened_by_delta_and_unsoftened_at_zero():
    x = UNIT_CUBE.copy()
    x[6] = [0.2, 0.2, 0.2]
    assert energies(x, ONE)[0] == np.inf
    soft = [energies(x, ONE, delta)[0] for delta in (1e-3, 1e-2, 1e-1)]
    assert np.isfinite(soft).all()
    assert soft == sorted(soft, reverse=True)
    assert energies(UNIT_CUBE, ONE, 0.0)[0] == pytest.approx(0, abs=1e-14)
    assert energies(UNIT_CUBE * 1.1, ONE, 1e-9)[0] == pytest.approx(0, abs=1e-9)


def test_summary_of_a_tangled_mesh():
    mesh = scrambled(grid(4), 0.9)
    summary = summarise(mesh)
    figures = measure(mesh.points, mesh.hexes)
    assert summary.inverted == figures.n_inverted > 0
    assert summary.objective is None
    assert summary.locked_inverted == 0
    assert (summary.hexes, summary.nodes, summary.free_nodes) == (64, 125, 27)
    assert summary.q_std == pytest.approx(figures.q.std())
    assert summary.q_norm == pytest.approx(np.mean(figures.q**-2) ** -0.5)
    assert (summary.q_min, summary.scaled_jacobian_min) == (figures.q.min(), figures.scaled_jacobian.min())


def test_a_corner_of_fixed_nodes_locks_its_hex():
    mesh = grid(2)
    points = mesh.points.copy()
    corner = int(np.flatnonzero((points == 0).all(axis=1))[0])
    points[corner] = [0.9, 0.9, 0.9]  # a boundary node pushed through its three neighbours
    bad = mesh.with_points(points)
    summary = summarise(bad)
    assert summary.inverted >= summary.locked_inverted >= 1
    free = summarise(bad.with_points(mesh.points))
    assert free.locked_inverted == 0
    figures = measure(points, mesh.hexes)
    assert locked_hexes(points, mesh.hexes, np.zeros(27, bool), figures.inverted).sum() == 0


def test_a_released_quality_is_measured_again_and_its_pickle_has_the_values_alone():
    mesh = scrambled(grid(4), 0.4, 3)
    quality, kept = measure(mesh.points, mesh.hexes), measure(mesh.points.copy(), mesh.hexes)
    inverted = quality.inverted.copy()
    for released in (quality, kept):
        released.release()
        for name in ("q", "sigma", "scaled_jacobian", "eta"):
            np.testing.assert_array_equal(getattr(released, name), getattr(measure(mesh.points, mesh.hexes), name))
        np.testing.assert_array_equal(released.inverted, inverted)
    assert "q" in kept.__dict__  # of points that may have changed since: they are not measured again
    quality.release()
    assert "q" not in quality.__dict__
    again = pickle.loads(pickle.dumps(quality))
    np.testing.assert_array_equal(again.q, quality.q)
    assert len(pickle.dumps(quality)) < 5 * quality.q.nbytes
    with pytest.raises(AttributeError, match="no attribute p"):
        quality.p  # noqa: B018


# Better end of each quantity of a summary, and its old keyword.


def test_counts_extremes_and_spreads_have_no_better_way_and_all_others_have():
    better = {name: figure.better for name, figure in SUMMARY_QUANTITIES.items()}
    lower, higher = ({name for name, way in better.items() if way == end} for end in (-1, 1))
    assert lower == {"inverted", "locked_inverted", "invalid", "objective"}
    assert higher == {"min_jacobian", "q_min", "q_mean", "q_norm", "scaled_jacobian_min"}
    assert set(better.values()) == {-1, 0, 1}


def test_no_metric_is_best_both_at_its_least_and_at_its_greatest():
    assert {metric.better for metric in METRICS.values()} <= {-1, 0, 1}
    assert METRICS["scaled-jacobian"].better == METRICS["q"].better == 1
    assert METRICS["condition"].better == METRICS["skew"].better == -1


def test_a_hex_so_large_that_its_volume_is_no_number_has_the_worst():
    huge = np.float64(1e200) * np.random.default_rng(1).normal(size=(8, 3))
    hexes = np.arange(8, dtype=np.int32)[None]
    with np.errstate(all="ignore"):
        values = {name: metric.of(huge, hexes, measure(huge, hexes)) for name, metric in METRICS.items()}
    assert values["jacobian"].tolist() == [-np.inf]
    assert not any(np.isnan(one).any() for one in values.values())


# Unacceptable values of a metric, also at the ends of its range, and left-handed hexes.


VALUES = np.array([-1.0, 0.2, 0.5, 0.8, 2.0, np.nan])


RANGES = [
    (1, [True, False, False, False, False, True]),
    (-1, [False, False, False, False, True, True]),
    (0, [True, False, False, False, True, True]),
]


@pytest.mark.parametrize(("better", "unacceptable"), RANGES)
def test_what_is_worse_than_the_acceptable_range_is_unacceptable_and_its_ends_are_not(better, unacceptable):
    metric = dataclasses.replace(METRICS["scaled-jacobian"], acceptable=(0.2, 0.8), better=better)
    assert metric.unacceptable(VALUES).tolist() == unacceptable


def folded(shift):
    """Make two stacked left-handed cubes with the top lowered."""
    mesh = grid(1, 1, 2)
    points = mesh.points.copy()
    points[points[:, 2] == 2, 2] -= shift
    return mesh.rebuilt(hexes=mesh.hexes[:, MIRRORED_CORNERS]).with_points(points)


@pytest.mark.parametrize(
    ("shift", "mirrored"),
    [(0.0, True), (1 - 1e-6, True), (1 - 1e-17, True), (1.0, True), (1 + 1e-15, True), (1 + 1e-6, False), (2, False)],
)
def test_a_part_of_which_a_hex_is_flat_but_for_rounding_is_wound_as_the_others_are(shift, mirrored):
    assert left_handed_hexes(folded(shift)).tolist() == [mirrored] * 2


def test_rounding_grows_with_the_distance_from_the_origin_and_the_size():
    mesh = folded(1.0)
    far = mesh.with_points(1e3 * mesh.points + 1e9)
    assert left_handed_hexes(displaced(far, np.s_[-1, 2], 2e-7)).all()  # a bit of such coordinates
