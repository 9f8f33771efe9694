"""Table of quality statistics."""

import dataclasses

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QTableWidget

from hexmend import Summary, summarise
from hexmend_app.features.quality.quality_bar import FIGURES, QualityBar
from hexmend_app.features.quality.statistics import ROWS, StatisticsTable, change
from hexmend_app.theme.palette import BETTER, MUTED, WORSE
from hexmend_app.widgets.wording import figure
from tests.app.driving import heard_from, named, run_to_end
from tests.core.grids import grid

START = dataclasses.replace(
    summarise(grid(2)),
    inverted=56, invalid=58, q_min=0.4035, q_mean=0.8916, q_std=0.1, scaled_jacobian_min=0.2224, objective=None,
)  # fmt: skip
NOW = dataclasses.replace(START, inverted=0, invalid=2, q_min=0.4841, q_mean=0.8781)
BETTER_NOW = dataclasses.replace(NOW, q_std=0.05, scaled_jacobian_min=0.3, objective=9.5)
_ROW_OF = {row.key: number for number, row in enumerate(ROWS)}


@pytest.fixture
def table(shown):
    widget = shown(StatisticsTable())
    widget.set_summaries(START, BETTER_NOW)
    return widget


def figures_of(table):
    return named(table, QTableWidget, "Statistics of the mesh")


def cell(table, key, column):
    return figures_of(table).item(_ROW_OF[key], column)


def test_regressions_of_important_figures_are_bold(table):
    table.set_summaries(BETTER_NOW, START)
    bold = {key for key in _ROW_OF if cell(table, key, 3).font().bold()}
    assert bold == {"inverted", "invalid", "q_min", "scaled_jacobian_min"}
    for key in bold:
        assert cell(table, key, 3).foreground().color() == QColor(str(WORSE))
        assert cell(table, key, 3).data(Qt.ItemDataRole.AccessibleTextRole).endswith("worse")
    table.set_summaries(START, BETTER_NOW)
    assert not any(cell(table, key, 3).font().bold() for key in _ROW_OF)


def test_every_figure_of_a_summary_except_q_max_has_a_row():
    assert {row.key for row in ROWS} == {field.name for field in dataclasses.fields(Summary)} - {"q_max"}


@pytest.mark.parametrize(
    ("key", "colour"),
    [("inverted", BETTER), ("q_min", BETTER), ("q_mean", WORSE), ("q_std", MUTED), ("hexes", MUTED)]
    + [("objective", BETTER), ("scaled_jacobian_min", BETTER)],
)
def test_changes_are_coloured_as_better_or_worse(table, key, colour):
    assert cell(table, key, 3).foreground().color() == QColor(str(colour))


@pytest.mark.parametrize("row", [row for row in ROWS if row.better])
def test_the_opposite_change_has_the_opposite_sense_and_arrow(row):
    rise, fall = change(row, 0.25, 0.5), change(row, 0.5, 0.25)
    assert rise == ("▲ 0.2500", row.better)
    assert fall == ("▼ 0.2500", -row.better)
    assert change(row, 0.5, 0.5) == ("=", 0)
    assert change(row, 0.5, 0.5 + 1e-9)[0] == "▲ <0.0001"


def test_ctrl_c_copies_the_table_in_full_precision(table):
    figures_of(table).setFocus()
    QTest.keyClick(figures_of(table), Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert len(lines) == len(ROWS) + 1
    assert all(len(line) == 3 for line in lines)
    by_title = {line[0]: line[1:] for line in lines}
    assert by_title["q min"] == ["0.4035", "0.4841"]
    assert by_title["Hexes"] == ["8", "8"]
    assert by_title["Objective Σ η²"] == ["", "9.5"]


@pytest.fixture
def with_inverted(table):
    """Return the table with inverted hexes now, and a list of the groups whose isolation was requested."""
    table.set_summaries(START, dataclasses.replace(NOW, inverted=12, locked_inverted=3, invalid=14))
    requests = heard_from(table.isolate_requested)
    return table, requests


def click(table, key, column):
    position = figures_of(table).visualItemRect(cell(table, key, column)).center()
    QTest.mouseMove(figures_of(table).viewport(), position)
    QTest.mouseClick(figures_of(table).viewport(), Qt.MouseButton.LeftButton, pos=position)


def test_the_numbers_of_inverted_locked_and_invalid_hexes_are_links(with_inverted):
    table, requests = with_inverted
    for key in ("inverted", "locked_inverted", "invalid", "hexes"):
        click(table, key, 2)
    click(table, "inverted", 1)  # numbers at the start are no links
    assert requests == ["inverted", "locked", "invalid"]
    assert cell(table, "inverted", 2).font().underline()
    assert "Show only the locked hexes" in cell(table, "locked_inverted", 2).toolTip()


# Bar of key figures in the view.


@pytest.fixture
def bar(shown):
    bar = shown(QualityBar(), 900, 30)
    bar.set_summaries(START, NOW)
    return bar


def colours(bar):
    html = bar.findChild(QLabel).text()
    return [part.split(";")[0].split('"')[0] for part in html.split('<b style="color: ')[1:]]


def test_each_figure_has_its_value_at_the_start_and_an_arrow_in_the_colour_of_better_or_worse(bar):
    assert bar.text == (
        "inverted 56 → 0 ▼ invalid 58 → 2 ▼ q min 0.4035 → 0.4841 ▲ q mean 0.8916 → 0.8781 ▼ scaled Jacobian min 0.2224"
    )
    assert colours(bar)[:4] == [str(BETTER), str(BETTER), str(BETTER), str(WORSE)]
    assert "q mean 0.8781, worse than at the start: 0.8916" in bar.findChild(QLabel).accessibleDescription()


def test_differences_of_rounding_have_no_arrow(bar):
    bar.set_summaries(START, dataclasses.replace(START, q_min=START.q_min - 1e-14))
    assert not set(bar.text) & set("▲▼→")


def test_a_narrow_bar_omits_the_figures_at_the_start(bar):
    bar.resize(400, bar.height())
    assert "q min 0.4841 ▲" in bar.text
    assert "→" not in bar.text
    bar.resize(900, bar.height())
    assert "0.4035 → 0.4841 ▲" in bar.text


def test_the_bar_follows_a_run(window, qtbot):
    window.resize(1400, 900)  # so that all figures fit
    bar = window.features["quality"].bar
    start = window.session.document.start.summary
    assert bar.isVisible()
    assert "→" not in bar.text
    seen = set()
    window.session.run.iterated.connect(lambda frame: seen.add(frame.iteration.number))
    run_to_end(window, qtbot, "local-sd", max_iterations=5)
    now = window.session.document.now.summary
    assert seen
    changes = [f"{one.label} {figure(getattr(start, one.key))} → {figure(getattr(now, one.key))}" for one in FIGURES]
    qtbot.waitUntil(lambda: all(change in bar.text for change in changes))
