"""Figures of runs, at the width of a page."""

import xml.etree.ElementTree as ET

import pytest

from hexmend_app.report.run_figures import write_convergence, write_distributions

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


@pytest.mark.parametrize(
    ("stem", "name"),
    [
        ("distributions", "$x_{ and $ of\ntwo lines"),
        ("convergence", "bell\a, bad\udcff and ]]> & <svg>"),
    ],
)
def test_names_from_files_are_plain_text(tmp_path, stem, name):
    assert len(list(ET.parse(draw(tmp_path / f"{stem}.svg", name)).iter())) > 50


def test_a_count_that_is_always_0_is_left_out(tmp_path):
    heights = []
    for rows in (ROWS, INVALID, VALID):
        root = ET.parse(draw(tmp_path / "convergence.svg", "mend", rows=rows)).getroot()
        heights.append(float(root.get("height").removesuffix("pt")))
    assert heights[0] > heights[1] > heights[2]
