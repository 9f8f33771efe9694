"""The histogram as a figure and as a table."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from hexmend_app.features.histogram.file import text, write_histogram
from hexmend_app.features.histogram.panel import QualityHistogram


@pytest.fixture
def histogram(qtbot):
    widget = QualityHistogram()
    qtbot.addWidget(widget)
    return widget


@pytest.mark.parametrize("log", [False, True])
def test_in_a_figure_too_a_bar_that_is_taller_than_the_bins_is_broken_and_carries_its_number(histogram, tmp_path, log):
    if log:
        histogram.head.scale.button("log").click()

    def written(n_inverted):
        histogram.set_initial(np.full(3000, 0.5), np.arange(3000) < n_inverted)
        path = tmp_path / f"{n_inverted}.svg"
        write_histogram(path, histogram, "title")
        ET.parse(path)
        return path.read_text()

    assert ">2,900<" in written(2900)
    assert ">1,400<" not in written(1400)


def test_the_table_has_a_line_for_each_place_that_counts(histogram):
    histogram.set_initial(np.full(3000, 0.5), np.arange(3000) < 2900)
    lines = text(histogram).splitlines()
    assert lines[:2] == ["q from,q to,at the start", "inverted,inverted,2900"]
    assert len(lines) == 2 + 50
    assert sum(int(line.rsplit(",", 1)[1]) for line in lines[1:]) == 3000
