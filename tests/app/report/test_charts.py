"""Charts as files: sizes, letters, names."""

import re
import struct
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from hexmend import ParameterError, gallery, measure
from hexmend_app.report.charts import ChartStyle, chart_png, write_chart
from hexmend_app.report.convergence import Convergence, Line, LineChart
from hexmend_app.report.histogram import Histogram, Series
from hexmend_app.report.run_figures import write_convergence, write_distributions
from hexmend_app.report.worst_hexes import Locked, reason, worst_table

HISTOGRAM = Histogram(
    [Series("before", "#5b6573", [1, 2, 3], filled=True, note="2 inverted"), Series("after", "#0072B2", [0, 4, 9])],
    "bridge",
    "q(H)",
    "hexes",
    [(0.0, "0"), (3.0, "1")],
)
CURVE = Line("mend", "#0072B2", [0, 1, 2], [3.0, 2.0, 0.5])
CONVERGENCE = Convergence([LineChart("quality", [CURVE])], "bridge", "iteration")


def written(path, draw, **style):
    """What a chart says in SVG, and its size in mm."""
    write_chart(path, draw, ChartStyle(**style))
    root = ET.parse(path).getroot()
    size = [float(root.get(side).removesuffix("pt")) / 72 * 25.4 for side in ("width", "height")]
    return [one.text for one in root.iter("{http://www.w3.org/2000/svg}text")], size


@pytest.mark.parametrize("drawn", [HISTOGRAM, CONVERGENCE])
def test_a_chart_is_as_large_as_it_is_asked_to_be(tmp_path, drawn):
    assert written(tmp_path / "a.svg", drawn.draw, width=85.0, height=50.0)[1] == pytest.approx([85, 50], abs=0.1)
    wide, high = written(tmp_path / "b.svg", drawn.draw, width=120.0)[1]
    assert wide == pytest.approx(120, abs=0.1)
    assert 0.3 * wide < high < wide
    data = chart_png(drawn.draw, ChartStyle(width=100.0, height=60.0), 127)
    assert struct.unpack(">II", data[16:24]) == (500, 300)


def test_names_and_title_are_what_they_are_said_to_be(tmp_path):
    said, _ = written(tmp_path / "a.svg", HISTOGRAM.draw)
    assert {"bridge", "before (2 inverted)", "after"} <= set(said)
    said, _ = written(tmp_path / "a.svg", HISTOGRAM.draw, title="", names={"before": "as given", "after": "$x_{"})
    assert {"as given (2 inverted)", "$x_{"} <= set(said)
    assert not {"bridge", "before (2 inverted)", "after"} & set(said)


@pytest.mark.parametrize("drawn", [HISTOGRAM, CONVERGENCE])
def test_no_letter_makes_a_name_vanish(tmp_path, drawn):
    said, _ = written(tmp_path / "a.svg", drawn.draw, names={"after": "_ours", "mend": "_ours"})
    assert "_ours" in said


def test_powers_of_ten_need_something_to_be_counted(tmp_path):
    nothing = Histogram([Series("a", "#5b6573", [0, 0])], "", "q", "hexes", [(0.0, "0")], log=True)
    assert "a" in written(tmp_path / "a.svg", nothing.draw)[0]


def test_a_picture_of_too_many_pixels_is_refused_once_its_height_is_known(tmp_path):
    many = Convergence([LineChart(str(k), [CURVE]) for k in range(8)], "bridge", "iteration")
    style = ChartStyle(width=169.0, resolution=1200)
    write_chart(tmp_path / "a.svg", CONVERGENCE.draw, style)
    with pytest.raises(ParameterError, match="too many pixels"):
        many.draw(style)


def test_letters_have_their_size(tmp_path):
    sizes = []
    for letters in (6.0, 12.0):
        write_chart(tmp_path / "a.svg", CONVERGENCE.draw, ChartStyle(letters=letters))
        found = re.findall(r'font[^"]*?([\d.]+)px', (tmp_path / "a.svg").read_text())
        sizes.append(max(map(float, found)))
    assert sizes[1] == pytest.approx(2 * sizes[0])


def test_charts_without_curves_are_left_out_unless_there_are_no_others(tmp_path):
    empty = LineChart("objective", [])
    said, _ = written(tmp_path / "a.svg", Convergence([empty, *CONVERGENCE.charts], "bridge", "iteration").draw)
    assert "quality" in said
    assert "objective" not in said
    assert "objective" in written(tmp_path / "a.svg", Convergence([empty], "bridge", "iteration").draw)[0]


@pytest.mark.parametrize(
    ("y", "scale"),
    [([45.0, 44.0], "linear"), ([45.0, 0.0], "linear"), ([45.0, 4.0], "log"), ([45.0, 4.0, 0.0], "symlog")],
)
def test_an_axis_goes_by_powers_of_ten_where_there_are_some(y, scale):
    curve = Line("mend", "#0072B2", list(range(len(y))), y)
    axes = Convergence([LineChart("inverted", [curve], True, True)], "a", "iteration").draw(ChartStyle()).axes[0]
    assert axes.get_yscale() == scale


@pytest.mark.parametrize(
    "wrong", [{"width": 5}, {"height": 7}, {"letters": 1}, {"resolution": 5000}, {"width": 1000, "resolution": 1200}]
)
def test_sizes_that_cannot_be_are_refused(wrong):
    with pytest.raises(ParameterError, match=next(iter(wrong)) if len(wrong) == 1 else "pixels"):
        ChartStyle(**wrong)


# Figures of runs, at the width of a page.


ROWS = [
    {"iteration": k, "q_min": 0.1 * k, "objective": None if k == 0 else 9.0 / k, "inverted": 3 - k, "invalid": 4 - k}
    for k in range(4)
]
INVALID = [row | {"inverted": 0} for row in ROWS]
VALID = [row | {"inverted": 0, "invalid": 0} for row in ROWS]


def draw(path, name, width=120.0, rows=ROWS):
    if "distribution" in path.stem:
        write_distributions(path, {name: [1, 2, 3], "mend": [0, 2, 4]}, title=name, width_mm=width)
    else:
        write_convergence(path, {name: rows}, title=name, width_mm=width)
    return path


@pytest.mark.parametrize("stem", ["distributions", "convergence"])
def test_a_figure_is_as_wide_as_it_is_asked_to_be(tmp_path, stem):
    for width in (60.0, 170.0):
        root = ET.parse(draw(tmp_path / f"{stem}.svg", "mend", width)).getroot()
        assert float(root.get("width").removesuffix("pt")) == pytest.approx(width / 25.4 * 72, abs=0.1)


NAMES_FROM_FILES = [
    ("distributions", "$x_{ and $ of\ntwo lines"),
    ("convergence", "bell\a, bad\udcff and ]]> & <svg>"),
]


@pytest.mark.parametrize(("stem", "name"), NAMES_FROM_FILES)
def test_names_from_files_are_plain_text(tmp_path, stem, name):
    assert len(list(ET.parse(draw(tmp_path / f"{stem}.svg", name)).iter())) > 50


def test_a_count_that_is_always_0_is_left_out(tmp_path):
    heights = []
    for rows in (ROWS, INVALID, VALID):
        root = ET.parse(draw(tmp_path / "convergence.svg", "mend", rows=rows)).getroot()
        heights.append(float(root.get("height").removesuffix("pt")))
    assert heights[0] > heights[1] > heights[2]


# Table of the worst hexes, and locked hexes.


def inverted_corner():
    """Return a grid with a hex that is inverted by boundary nodes alone, and the node that inverts it."""
    mesh = gallery.make("cube", size=27)
    points = mesh.points.copy()
    corner = int(np.argmin(points.sum(axis=1)))
    points[corner] += 0.9 * np.ptp(points, axis=0)
    return mesh.with_points(points), corner


def test_a_locked_hex_is_first_and_its_node_is_named():
    mesh, corner = inverted_corner()
    figures = measure(mesh.points, mesh.hexes)
    locked = Locked.of(mesh, figures)
    (hex,) = np.flatnonzero((mesh.hexes == corner).any(axis=1))
    assert locked.locked[hex]
    said = reason(mesh, figures, locked, int(hex))
    assert said.startswith("locked at node")
    assert "σ = -" in said
    assert str(corner) in said
    table = worst_table("now", mesh, figures, locked)
    assert table.rows[0][0] == str(hex)
    assert "locked" in locked.words()
    assert table.rows[0][1:3] == [f"{figures.q[hex]:.4f}", f"{figures.scaled_jacobian[hex]:.4f}"]


def test_a_valid_mesh_has_no_locked_hexes():
    mesh = gallery.make("cube", size=27)
    figures = measure(mesh.points, mesh.hexes)
    locked = Locked.of(mesh, figures)
    assert locked.words() == ""
    assert all(row[-1].startswith("valid") for row in worst_table("now", mesh, figures, locked).rows)
