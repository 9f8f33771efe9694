"""Distributions in the histogram as a figure for print and as CSV."""

import csv
import io

import numpy as np
import pytest

from hexmend_app.features.histogram.distributions import Shown, ShownHistogram
from hexmend_app.report.charts import ChartStyle
from hexmend_app.report.distribution import Axis, Distribution
from hexmend_app.theme.palette import BLUE, GREY

Q = np.random.default_rng(3).beta(6, 2, 1000)
NOW, START = Distribution.of(Q, Q < 0.4), Distribution.of(Q**2, np.zeros(1000, bool))


def shown(*distributions, metric="q", **options):
    drawn = [Shown(f"name {at}", (BLUE, GREY)[at % 2], one, at == 0) for at, one in enumerate(distributions)]
    return ShownHistogram(Axis.fitted(metric, distributions), drawn, **options)


@pytest.mark.parametrize("cumulative", [False, True])
def test_the_csv_has_a_line_for_each_bin_and_printed_names(cumulative):
    text = shown(NOW, START, cumulative=cumulative).csv_text({"name 1": "GETMe"})
    lines = list(csv.reader(io.StringIO(text)))
    assert lines[0][:2] == ["q from", "q to"]
    assert ["name 0" in lines[0][2], "GETMe" in lines[0][3]] == [True, True]
    assert lines[1] == ["inverted", "inverted", f"{NOW.inverted / (10 if cumulative else 1):g}", "0"]
    assert len(lines) == 2 + 50
    assert lines[2][1] == lines[3][0]
    if cumulative:
        assert lines[-1][2:] == ["100", "100"]
    else:
        assert [sum(int(row[at]) for row in lines[1:]) for at in (2, 3)] == [1000, 1000]


def test_an_open_end_is_written_as_infinity():
    long = Distribution.of(np.append(1 + Q, 1e9), np.zeros(1001, bool))
    assert shown(long, metric="aspect-ratio").csv_text({}).splitlines()[-1].split(",")[1] == "inf"


@pytest.mark.parametrize("log", [False, True])
def test_screen_and_print_have_a_column_for_inverted_hexes_only_if_there_are_any(log):
    for distributions, texts in (((NOW, START), {"inverted"}), ((START,), set())):
        described = shown(*distributions, log=log).describe("title")
        assert (described.column is None) == (not texts)
        axes = described.draw(ChartStyle()).axes[0]
        assert {text.get_text() for text in axes.get_xticklabels()} & {"inverted"} == texts
        assert axes.get_yscale() == ("log" if log else "linear")


def test_a_tall_column_of_inverted_hexes_does_not_flatten_the_bins():
    most = Distribution.of(Q, np.arange(1000) < 990)
    floor, top = shown(most).describe().heights
    assert floor == 0
    assert top < 10
