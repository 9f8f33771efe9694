"""A brushed range contains exactly the hexes that its bars and bins count."""

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
