"""Counts of hexes in bins."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.quality import METRICS, measure
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.geometry.filters import Filters
from hexmend_app.scene.views.frame import Frame
from tests.core.grids import grid, scrambled

Q = Axis("q")


def test_values_beyond_open_ends_are_counted_in_separate_bars():
    axis = Axis("volume", 1.0, 2.0, open_low=True, open_high=True)
    values = np.array([-np.inf, 0.999999, 1.0, 1.999999, 2.0, np.inf, np.nan])
    counted = distribute(values, np.arange(7) == 6, axis, 10)
    assert (counted.below, counted.counts.tolist(), counted.above, counted.inverted) == (2, [1, *[0] * 8, 1], 2, 1)
    assert counted.cumulated().counts.tolist() == [4] * 9 + [5]
    assert (counted.cumulated().below, counted.cumulated().above) == (3, 7)


# Values by bins, against plain NumPy.


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.booleans(), st.booleans())
def test_every_value_is_counted_once_where_it_belongs(seed, bins, open_low, open_high):
    random = np.random.default_rng(seed)
    low, high = -0.5, 2.0
    values = np.concatenate([random.uniform(-1, 3, 200), [low, high, np.inf, -np.inf, np.nan]])
    inverted = random.random(values.size) < 0.2
    place = (values - low) * (bins / (high - low))
    none = inverted | np.isnan(place)
    at = np.floor(np.clip(place, -1, bins)[~none]).astype(int)
    at[at < 0] = bins + 1 if open_low else 0
    at[place[~none] >= bins] = bins if open_high else bins - 1
    expected = np.bincount(at, minlength=bins + 3)
    expected[bins + 2] = none.sum()
    axis = Axis("volume", low, high, open_low=open_low, open_high=open_high)
    found = distribute(values, inverted, axis, bins)
    assert [*found.counts, found.above, found.below, found.inverted] == expected.tolist()
    assert found.total == values.size


# A brushed range contains exactly the hexes that its bars and bins count.


AXES = (
    Axis("q"),
    Axis("scaled-jacobian"),
    Axis("max-angle", 0, 180),
    Axis("condition", 1, 2.8, open_high=True),
    Axis("volume", 1.1e-5, 1.7e-5, open_low=True, open_high=True),
    Axis("volume", 1e6, 1e6 + 0.7, open_low=True, open_high=True),
)


@st.composite
def cases(draw):
    """Draw a distribution, with values at, near and between the ends of bins, and two of its cells."""
    axis, bins = draw(st.sampled_from(AXES)), draw(st.integers(10, 200))
    width = axis.high - axis.low
    ends = st.integers(-2, bins + 2).map(lambda k: axis.low + k * (width / bins))
    near = st.tuples(ends, st.sampled_from([-math.inf, math.inf])).map(lambda pair: math.nextafter(*pair))
    anywhere = st.floats(axis.low - width, axis.high + width)
    special = st.sampled_from([math.nan, math.inf, -math.inf, 0.0, -0.0])
    values = np.array(draw(st.lists(st.one_of(ends, near, anywhere, special), max_size=60)), dtype=float)
    inverted = np.array(draw(st.lists(st.booleans(), min_size=len(values), max_size=len(values))), dtype=bool)
    first, last = sorted(draw(st.tuples(*[st.integers(0, len(Cells(axis, bins)) - 1)] * 2)))
    return distribute(values, inverted, axis, bins), first, last


def cell_counts(counted):
    """Return the counts of the cells, from left to right."""
    below = [counted.below] if counted.axis.open_low else []
    above = [counted.above] if counted.axis.open_high else []
    return [counted.inverted, *below, *counted.counts.tolist(), *above]


@given(cases())
def test_a_range_contains_as_many_hexes_as_its_cells_count(case):
    counted, first, last = case
    counts = cell_counts(counted)
    assert len(counts) == len(counted.cells)
    range = counted.cells.range(first, last)
    if range is None:
        assert sum(counts[first : last + 1]) == counted.total
    else:
        assert counted.within(range) == sum(counts[first : last + 1])


@pytest.mark.parametrize("name", METRICS)
def test_the_view_shows_as_many_hexes_as_the_cells_count(name):
    mesh = scrambled(grid(6), 0.7, 1)
    figures = measure(mesh.points, mesh.hexes)
    assert 0 < figures.n_inverted < mesh.n_hexes
    values = METRICS[name].of(mesh.points, mesh.hexes, figures)
    counted = distribute(values, figures.inverted, Axis.fitted(name, values, figures.inverted), 20)
    counts, filters = cell_counts(counted), Filters(mesh)
    for first, last in ((0, 0), (1, len(counts) - 1), (0, 8), (3, 12), (len(counts) - 2, len(counts) - 1)):
        look = Look(show=counted.cells.range(first, last) or Show())
        shown = filters.kept(Frame(mesh, figures, None, look))
        assert np.count_nonzero(shown) == sum(counts[first : last + 1])


def test_all_cells_are_no_range_and_invalid_cells_are_rejected():
    cells = Cells(Axis("q"), 10)
    assert cells.range(0, 10) is None
    assert cells.range(1, 10) == Show((0.0, 1.0), "q")
    assert cells.range(0, 0) == Show((-math.inf, -math.inf), "q", True)
    for first, last in ((3, 2), (-1, 4), (0, 11)):
        with pytest.raises(ValueError, match="the lower first"):
            cells.range(first, last)


def test_a_quality_that_exceeds_one_by_rounding_is_counted_and_within_the_range():
    counted = distribute(np.array([1 + 2e-16, np.nextafter(1, 2)]), np.array([False, True]), Q)
    assert counted.counts[-1] == 1
    assert counted.within(Show((0.9, 1.0), "q")) == 1
    assert counted.within(Show((0.9, 1.0), "q", True)) == 2
    assert counted.within(Show((0.9, 0.99), "q")) == 0
