"""Distributions of values, for every metric, and their axis."""

import math
from itertools import cycle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METRICS, ParameterError, measure
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Axis, Distribution
from hexmend_app.scene.colour.value_range import within
from hexmend_app.scene.cutting.filters import Filters
from hexmend_app.scene.geometry.frame import Frame
from tests.core.grids import grid, scrambled

MESHES = {"cubes": grid(3), "bent": scrambled(grid(4), 0.2), "inverted": scrambled(grid(4), 0.9), "flat": None}
MESHES["flat"] = grid(2).with_points(grid(2).points * 0)


def valid(values):
    return Distribution.of(values, np.zeros(len(values), bool))


@pytest.mark.parametrize(("name", "mesh"), list(zip(METRICS, cycle(MESHES), strict=False)))
def test_every_metric_has_an_axis_on_which_every_hex_is_counted_once(name, mesh):
    mesh = MESHES[mesh]
    figures = measure(mesh.points, mesh.hexes)
    distribution = Distribution.of(METRICS[name].of(mesh.points, mesh.hexes, figures), figures.inverted)
    axis = Axis.fitted(name, [distribution], 40)
    minimum, maximum = METRICS[name].full_range
    assert minimum <= axis.low < axis.high <= maximum
    assert math.isfinite(axis.high - axis.low)
    assert distribution.inverted >= figures.n_inverted
    assert distribution.counts(axis).sum() + distribution.inverted == distribution.total == mesh.n_hexes
    assert distribution.counts(axis, cumulative=True)[-1] == mesh.n_hexes
    positions, texts = zip(*axis.ticks(), strict=True)
    assert min(positions) >= 0
    assert max(positions) <= 40
    assert len(set(texts)) == len(texts) >= 2


@pytest.mark.parametrize("name", [name for name, metric in METRICS.items() if math.isinf(metric.full_range[1])])
def test_an_open_axis_spans_most_valid_hexes_and_no_outlier(name):
    rng = np.random.default_rng(2)
    values = 1 + rng.gamma(2, 1, 5000) * 1e-3
    values[:10] = 1e9
    axis = Axis.fitted(name, [valid(values)])
    assert 1 <= axis.low < axis.high < 1.02
    counts = valid(values).counts(axis)
    assert 10 <= counts[-1] <= 100
    assert (counts > 0).sum() > 15
    assert axis.ticks()[-1][1].startswith("≥ ")


def test_a_bounded_axis_is_zoomed_to_the_values_and_ends_at_the_bound():
    axis = Axis.fitted("q", [valid(np.linspace(0.62, np.nextafter(1, 2), 300))])  # rounding exceeds 1
    assert (axis.low, axis.high) == (0.6, 1.0)
    assert [text for _, text in axis.ticks()] == ["0.6", "0.7", "0.8", "0.9", "1"]
    assert not axis.below | axis.above
    assert Axis.fitted("q", [valid(np.linspace(0.62, 1, 300)), valid(np.array([0.31]))]).low == pytest.approx(0.3)


def test_inverted_hexes_do_not_stretch_the_axis():
    values = np.concatenate([np.linspace(1, 2, 100), np.full(100, 500.0)])
    mixed = Distribution.of(values, np.arange(200) >= 100)
    assert Axis.fitted("edge-ratio", [mixed]).high < 3
    assert mixed.counts(Axis.fitted("edge-ratio", [mixed]))[-1] <= 3


@given(st.floats(1e-12, 1e9), st.floats(1.1, 100), st.floats(0, 1))
def test_a_value_has_a_position_and_a_text_to_a_hundredth_of_the_axis(size, ratio, position):
    axis = Axis.fitted("volume", [valid(np.linspace(size, ratio * size, 200))])
    width = axis.high - axis.low
    value = axis.low + position * width
    assert axis.position(value) == pytest.approx(position * axis.bins, abs=1e-4)
    assert float(axis.text(value).replace("−", "-")) == pytest.approx(value, rel=1e-5, abs=0.01 * width)


def test_a_range_to_the_end_of_the_metric_tolerates_rounding():
    values = np.array([1 + 2e-16, np.nextafter(1, 2), 0.5])
    none = np.zeros(3, bool)
    assert within(values, none, Show((0.9, 1.0), "q")).tolist() == [True, True, False]
    assert within(values, none, Show((0.0, 0.99), "q")).tolist() == [False, False, True]
    assert within(np.array([1.0, np.inf]), none[:2], Show((2, np.inf), "condition")).tolist() == [False, True]
    with pytest.raises(ParameterError, match="lower number first"):
        Show((0.5, 0.4), "q")


def test_positions_beyond_the_bins_mean_all_values_there_and_left_of_them_inverted_hexes():
    axis = Axis("q", 0.5, 1.0, bins=10)
    assert axis.range(0, 4) == Show((0.0, 0.7), "q")
    assert axis.range(4, 11) == Show((0.7, 1.0), "q")
    assert axis.range(-1, 4) == Show((0.0, 0.7), "q", inverted=True)
    assert axis.range(-1, -0.5) == Show((-math.inf, -math.inf), "q", inverted=True)
    assert axis.range(-1, 11) is None


# The range of a bin contains exactly the hexes that it counts.


AXES = (
    Axis("q"),
    Axis("max-angle", 0, 180),
    Axis("condition", 1, 2.8, above=True),
    Axis("volume", 1.1e-5, 1.7e-5, below=True, above=True),
    Axis("volume", 1e6, 1e6 + 0.7, below=True, above=True),
)


@st.composite
def cases(draw):
    """Draw a distribution, with values at, near and between the ends of bins, and its axis."""
    axis = draw(st.sampled_from(AXES))
    width = axis.high - axis.low
    ends = st.integers(-2, axis.bins + 2).map(lambda k: axis.low + k * (width / axis.bins))
    near = st.tuples(ends, st.sampled_from([-math.inf, math.inf])).map(lambda pair: math.nextafter(*pair))
    anywhere = st.floats(axis.low - width, axis.high + width)
    special = st.sampled_from([math.nan, math.inf, -math.inf, 0.0, -0.0])
    values = np.array(draw(st.lists(st.one_of(ends, near, anywhere, special), max_size=60)), dtype=float)
    inverted = np.array(draw(st.lists(st.booleans(), min_size=len(values), max_size=len(values))), dtype=bool)
    return Distribution.of(values, inverted), axis


@given(cases())
def test_the_range_of_a_bin_contains_as_many_hexes_as_it_counts(case):
    distribution, axis = case
    counts = distribution.counts(axis)
    assert [distribution.within(axis.bin_range(bin)) for bin in range(axis.bins)] == counts.tolist()
    assert distribution.counts(axis, cumulative=True)[-1] == distribution.total


@pytest.mark.parametrize("name", METRICS)
def test_the_view_shows_as_many_hexes_as_the_bins_count(name):
    mesh = scrambled(grid(6), 0.7, 1)
    figures = measure(mesh.points, mesh.hexes)
    assert 0 < figures.n_inverted < mesh.n_hexes
    distribution = Distribution.of(METRICS[name].of(mesh.points, mesh.hexes, figures), figures.inverted)
    axis, filters = Axis.fitted(name, [distribution], 20), Filters(mesh)
    counts = distribution.counts(axis)
    for bin in (0, 8, 19):
        shown = filters.kept(Frame(mesh, figures, None, Look(show=axis.bin_range(bin))))
        assert np.count_nonzero(shown) == counts[bin]
    shown = filters.kept(Frame(mesh, figures, None, Look(show=axis.range(-1, -1))))
    assert np.count_nonzero(shown) == distribution.inverted
