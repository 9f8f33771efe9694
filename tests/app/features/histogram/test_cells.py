"""A brushed range shows exactly what the bars under it count."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.quality import METRICS, measure
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.picture.appearance import Look, ValueRange
from hexmend_app.scene.colour.value_range import within
from hexmend_app.scene.geometry.filters import Filters
from hexmend_app.scene.views.frame import Frame
from tests.core.grids import grid, scrambled

AXES = (
    Axis("q"),
    Axis("scaled-jacobian"),
    Axis("max-angle", 0, 180, 30),
    Axis("condition", 1, 2.8, 0.3, open_high=True),
    Axis("volume", 1.1e-5, 1.7e-5, 1e-6, open_low=True, open_high=True),
    Axis("volume", 1e6, 1e6 + 0.7, 0.1, open_low=True, open_high=True),
)


@st.composite
def counted(draw):
    """An axis with some bins, values beside, between and on their ends, and two of the places that count."""
    axis, bins = draw(st.sampled_from(AXES)), draw(st.integers(10, 200))
    width = axis.high - axis.low
    ends = st.integers(-2, bins + 2).map(lambda k: axis.low + k * (width / bins))
    beside = st.tuples(ends, st.sampled_from([-math.inf, math.inf])).map(lambda pair: math.nextafter(*pair))
    anywhere = st.floats(axis.low - width, axis.high + width)
    odd = st.sampled_from([math.nan, math.inf, -math.inf, 0.0, -0.0])
    values = np.array(draw(st.lists(st.one_of(ends, beside, anywhere, odd), max_size=60)), dtype=float)
    inverted = np.array(draw(st.lists(st.booleans(), min_size=len(values), max_size=len(values))), dtype=bool)
    first, last = sorted(draw(st.tuples(*[st.integers(0, len(Cells(axis, bins)) - 1)] * 2)))
    return distribute(values, inverted, axis, bins), first, last


def cell_counts(part):
    """What is counted in each cell, from left to right."""
    below = [part.below] if part.axis.open_low else []
    above = [part.above] if part.axis.open_high else []
    return [part.inverted, *below, *part.counts.tolist(), *above]


@given(counted())
def test_as_many_elements_are_shown_as_the_bars_count(case):
    part, first, last = case
    counts = cell_counts(part)
    assert len(counts) == len(part.cells)
    chosen = part.cells.range(first, last)
    if chosen is None:
        assert sum(counts[first : last + 1]) == part.total
    else:
        assert part.within(chosen) == sum(counts[first : last + 1])


@given(counted())
def test_neighbouring_ranges_share_no_element(case):
    part, first, last = case
    if first == last:
        return
    halves = [part.cells.range(first, first), part.cells.range(first + 1, last)]
    shown = [within(part.values, part.is_inverted, half) for half in halves]
    assert not (shown[0] & shown[1]).any()


@pytest.mark.parametrize("name", METRICS)
def test_the_view_shows_what_the_bars_count(name):
    mesh = scrambled(grid(6), 0.7, 1)
    figures = measure(mesh.points, mesh.hexes)
    assert 0 < figures.n_inverted < mesh.n_hexes
    values = METRICS[name].of(mesh.points, mesh.hexes, figures)
    part = distribute(values, figures.inverted, Axis.fitted(name, values, figures.inverted), 20)
    counts, filters = cell_counts(part), Filters(mesh)
    for first, last in ((0, 0), (1, len(counts) - 1), (0, 8), (3, 12), (len(counts) - 2, len(counts) - 1)):
        look = Look(quality_range=part.cells.range(first, last))
        kept = filters.kept(Frame(mesh, figures, None, look))
        assert np.count_nonzero(kept) == sum(counts[first : last + 1])


@given(st.sampled_from(AXES), st.integers(10, 200), st.data())
def test_the_nearest_cells_of_their_own_ends_are_themselves(axis, bins, data):
    cells = Cells(axis, bins)
    first, last = sorted(data.draw(st.tuples(*[st.integers(0, len(cells) - 1)] * 2)))
    assert cells.nearest(cells.place(first)[0], cells.place(last)[1]) == (first, last)
    middle = sum(cells.place(first)) / 2
    assert cells.nearest(middle, middle) == (first, first)  # a short stroke takes what it is in


def test_the_plot_marks_the_cells_of_a_range():
    for axis in AXES:
        cells = Cells(axis, 20)
        for first, last in ((0, 0), (0, 7), (1, 4), (5, len(cells) - 1)):
            left, right = axis.span(cells.range(first, last))
            assert left == pytest.approx(cells.place(first)[0], abs=1e-6)
            assert right == pytest.approx(cells.place(last)[1], abs=1e-6)


def test_all_cells_are_no_range_and_none_are_no_question():
    cells = Cells(Axis("q"), 10)
    assert cells.range(0, 10) is None
    assert cells.range(1, 10) == ValueRange("q", 0.0, 1.0)
    assert cells.range(0, 0) == ValueRange("q", -math.inf, -math.inf, inverted=True)
    for first, last in ((3, 2), (-1, 4), (0, 11)):
        with pytest.raises(ValueError, match="the lower first"):
            cells.range(first, last)
