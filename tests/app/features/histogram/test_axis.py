"""Axis of the histogram, for every metric."""

import csv
import math
import xml.etree.ElementTree as ET
from itertools import cycle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METRICS, Mesh, ParameterError, measure
from hexmend.gallery import make
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.features.histogram.histogram_file import HistogramExport
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.colour.value_range import within
from hexmend_app.scene.cutting.filters import Filters
from hexmend_app.scene.geometry.frame import Frame
from tests.core.grids import grid, scrambled

MESHES = {"cubes": grid(3), "bent": scrambled(grid(4), 0.2), "inverted": scrambled(grid(4), 0.9), "flat": None}
MESHES["flat"] = grid(2).with_points(grid(2).points * 0)


@pytest.mark.parametrize(("name", "mesh"), list(zip(METRICS, cycle(MESHES), strict=False)))
def test_every_metric_has_an_axis_on_which_every_hex_is_counted_once(name, mesh):
    mesh = MESHES[mesh]
    figures = measure(mesh.points, mesh.hexes)
    values = METRICS[name].of(mesh.points, mesh.hexes, figures)
    axis = Axis.fitted(name, values, figures.inverted)
    assert math.isfinite(axis.low)
    assert axis.low < axis.high < math.inf
    counted = distribute(values, figures.inverted, axis, 40)
    assert counted.inverted == figures.n_inverted
    assert counted.counts.sum() + counted.inverted + counted.below + counted.above == mesh.n_hexes
    assert counted.cumulated().counts[-1] + counted.above == mesh.n_hexes
    positions = [position for position, _ in axis.ticks()]
    assert axis.extent[0] < min(positions)
    assert max(positions) < axis.extent[1]
    assert len({text for _, text in axis.ticks()}) == len(positions) >= 4


@pytest.mark.parametrize("name", [name for name, metric in METRICS.items() if math.isinf(metric.full_range[1])])
def test_an_open_axis_spans_most_valid_hexes_and_no_outlier(name):
    rng = np.random.default_rng(2)
    values = 1 + rng.gamma(2, 1, 5000) * 1e-3
    values[:10] = 1e9
    axis = Axis.fitted(name, values, np.zeros(5000, bool))
    counted = distribute(values, np.zeros(5000, bool), axis)
    assert axis.high < 1.02
    assert 10 <= counted.above <= 100
    assert counted.below <= 50
    assert (counted.counts > 0).sum() > 15
    assert dict(axis.ticks())[sum(axis.above) / 2].startswith("≥ ")


def test_negative_values_of_valid_hexes_give_an_axis():
    values = np.linspace(-2, -1, 20)  # Jacobians at the centre, of hexes whose corners are valid
    counted = distribute(values, np.zeros(20, bool), Axis.fitted("jacobian", values, np.zeros(20, bool)))
    assert counted.axis.low == 0 < counted.axis.high
    assert counted.counts[0] == 20


def test_inverted_hexes_do_not_stretch_the_axis():
    values = np.concatenate([np.linspace(1, 2, 100), np.full(100, 500.0)])
    inverted = np.arange(200) >= 100
    assert Axis.fitted("edge-ratio", values, inverted).high < 3
    assert distribute(values, inverted, Axis.fitted("edge-ratio", values, inverted)).above <= 1


@given(st.floats(1e-12, 1e9), st.floats(1.1, 100), st.floats(0, 1))
def test_a_value_has_a_position_and_a_text_to_a_hundredth_of_the_axis(size, ratio, position):
    values = np.linspace(size, ratio * size, 200)
    axis = Axis.fitted("volume", values, np.zeros(200, bool))
    value = axis.low + position * (axis.high - axis.low)
    assert axis.position(value) == pytest.approx(position, abs=1e-6)
    assert float(axis.text(value)) == pytest.approx(value, rel=1e-5, abs=axis.resolution)
    assert float(axis.end_text(value)) == pytest.approx(value, rel=1e-5, abs=axis.resolution)


def test_values_beyond_the_ends_have_the_positions_of_their_bars():
    axis = Axis("condition", 1, 21, open_high=True)
    assert axis.position(math.inf) == axis.above[1] == axis.brush_limits[1]
    assert axis.position(-math.inf) == 0 > axis.brush_limits[0]
    volume = Axis("volume", 1.0, 2.0, open_low=True)
    assert volume.position(0.0) == volume.below[0] > volume.brush_limits[0] == volume.inverted[0]
    assert volume.position(3.0) == volume.brush_limits[1] == 1


def test_a_range_to_the_end_of_the_metric_tolerates_rounding():
    values = np.array([1 + 2e-16, np.nextafter(1, 2), 0.5])
    none = np.zeros(3, bool)
    assert within(values, none, Show((0.9, 1.0), "q")).tolist() == [True, True, False]
    assert within(values, none, Show((0.0, 0.99), "q")).tolist() == [False, False, True]
    assert within(np.array([1.0, np.inf]), none[:2], Show((2, np.inf), "condition")).tolist() == [False, True]
    with pytest.raises(ParameterError, match="lower number first"):
        Show((0.5, 0.4), "q")


# Export of the histogram as a picture and as CSV.


BLUE = "#0072b2"


@pytest.fixture(scope="module")
def mesh():
    return make("cube", size=1000, scramble=0.2, seed=1)


def rows(path):
    return list(csv.reader(path.read_text().splitlines()))


@pytest.mark.parametrize("log", [False, True])
def test_a_tall_bar_of_inverted_hexes_is_broken_and_labelled_in_the_figure(mesh, tmp_path, log):
    for inverted, broken in ((invert(mesh, 990), True), (invert(mesh, 3), False)):
        path = tmp_path / "figure.svg"
        HistogramExport("title", "q", [("now", BLUE, True, inverted)], log=log).write(path)
        ET.parse(path)
        count = measure(inverted.points, inverted.hexes).n_inverted
        assert (f">{count:,}<" in path.read_text()) == broken


def invert(mesh, count):
    """Return a mesh with the first `count` hexes inverted."""
    hexes = mesh.hexes.copy()
    hexes[:count] = hexes[:count][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    return Mesh(mesh.points, hexes)


def counted(mesh, folder, bins=50, cumulative=False):
    path = folder / "counts.csv"
    HistogramExport("title", "q", [("now", BLUE, True, mesh)], bins=bins, cumulative=cumulative).write(path)
    return rows(path)


def test_the_csv_has_a_line_for_each_cell(mesh, tmp_path):
    lines = counted(mesh, tmp_path)
    assert lines[0] == ["q from", "q to", "now"]
    assert lines[1] == ["inverted", "inverted", str(measure(mesh.points, mesh.hexes).n_inverted)]
    assert len(lines) == 2 + 50
    assert sum(int(row[2]) for row in lines[1:]) == mesh.n_hexes


def test_the_axis_fits_the_first_mesh(mesh, tmp_path):
    path = tmp_path / "volume.csv"
    flat = mesh.with_points(mesh.points * [1, 1, 0.01])
    HistogramExport("title", "volume", [("at the start", BLUE, True, mesh), ("now", BLUE, True, flat)]).write(path)
    edges = [row[0] for row in rows(path)]
    HistogramExport("title", "volume", [("at the start", BLUE, True, mesh)]).write(path)
    assert [row[0] for row in rows(path)] == edges


# Counts of hexes in bins.


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
