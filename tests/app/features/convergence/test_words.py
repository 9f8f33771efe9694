"""What the charts say where they have nothing to draw."""

import pytest
from PySide6.QtWidgets import QLabel

from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.features.convergence.convergence_plot import ConvergencePlot
from hexmend_app.features.convergence.point_texts import reason_if_blank, titled
from tests.app.features.convergence.test_panel import curve, record

OBJECTIVE, DELTA = CHARTS["objective"], CHARTS["delta"]


def of(inverted, name="laplacian", rows=4, **how):
    """A run that leaves so many hexes inverted, and has no objective while it does."""
    return curve(record(name, rows, objective=None if inverted else 5.0, inverted=inverted), **how)


@pytest.mark.parametrize(("inverted", "words"), [(1, "1 hex is inverted"), (40, "40 hexes are inverted")])
def test_an_objective_that_is_infinite_is_said_to_be(inverted, words):
    assert reason_if_blank(OBJECTIVE, [of(inverted)]).startswith(words)
    assert "infinite" in reason_if_blank(OBJECTIVE, [of(inverted, rows=1)])  # before the first iteration too
    assert titled(OBJECTIVE, [of(inverted)], "") == "objective: laplacian has none while hexes are inverted"


def test_nothing_is_said_where_something_is_drawn():
    both = [of(3), of(0, "mend")]
    assert reason_if_blank(OBJECTIVE, both) == ""
    assert titled(OBJECTIVE, both, "") == "objective: laplacian has none while hexes are inverted"
    assert titled(OBJECTIVE, both[1:], "") == "objective"


def test_a_figure_that_no_method_tells_and_runs_that_are_not_ticked_are_said():
    assert reason_if_blank(DELTA, [of(0)]) == "The method does not tell its delta."
    assert reason_if_blank(DELTA, [of(0), of(0)]) == "No run tells its delta."
    assert reason_if_blank(DELTA, [of(0, rows=1)]) == ""  # it may yet
    assert reason_if_blank(OBJECTIVE, [of(0, shown=False)]) == "No run is ticked."


def test_it_stands_in_the_chart_and_goes(shown):
    plot = shown(ConvergencePlot(OBJECTIVE), 400, 120)
    label = next(one for one in plot.findChildren(QLabel) if one.accessibleName().startswith("Why the chart"))
    plot.draw([of(40)], False, True)
    assert "40 hexes are inverted" in label.text()
    assert label.isVisible()
    assert plot.plot.rect().contains(label.geometry())
    plot.draw([of(0)], False, True)
    assert label.text() == ""
