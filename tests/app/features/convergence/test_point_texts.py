"""Texts of empty charts."""

import pytest
from PySide6.QtWidgets import QLabel

from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.features.convergence.convergence_plot import ConvergencePlot
from hexmend_app.features.convergence.point_texts import reason_if_blank, titled
from tests.app.features.convergence.test_panel import curve, record

OBJECTIVE, DELTA = CHARTS["objective"], CHARTS["delta"]


def of(inverted, name="laplacian", rows=4, **options):
    """Return a curve with a constant number of inverted hexes, and an objective if it is 0."""
    return curve(record(name, rows, objective=None if inverted else 5.0, inverted=inverted), **options)


@pytest.mark.parametrize(("inverted", "text"), [(1, "1 inverted hex"), (40, "40 inverted hexes")])
def test_charts_report_an_infinite_objective(inverted, text):
    assert reason_if_blank(OBJECTIVE, [of(inverted)]) == f"The objective is infinite: {text}."
    assert "infinite" in reason_if_blank(OBJECTIVE, [of(inverted, rows=1)])  # before the first iteration too
    assert titled(OBJECTIVE, [of(inverted)], "") == "objective: infinite for laplacian while hexes are inverted"


def test_reasons_are_unreported_quantities_and_deselected_runs():
    assert reason_if_blank(DELTA, [of(0)]) == "The method does not report its delta."
    assert reason_if_blank(DELTA, [of(0), of(0)]) == "No run reports its delta."
    assert reason_if_blank(DELTA, [of(0, rows=1)]) == ""  # it may report it later
    assert reason_if_blank(OBJECTIVE, [of(0, shown=False)]) == "No run selected."


def test_the_reason_is_shown_in_the_chart_until_there_is_a_curve(shown):
    plot = shown(ConvergencePlot(OBJECTIVE), 400, 120)
    label = next(one for one in plot.findChildren(QLabel) if one.accessibleName().startswith("Why the chart"))
    plot.draw([of(40)], False, True)
    assert "40 inverted hexes" in label.text()
    assert label.isVisible()
    assert plot.plot.rect().contains(label.geometry())
    plot.draw([of(0)], False, True)
    assert label.text() == ""
