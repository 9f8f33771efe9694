"""Table of quality statistics."""

import dataclasses
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QTableWidget

from hexmend.quality.summary import Summary
from hexmend_app.features.quality.statistics import ROWS, StatisticsTable, change
from hexmend_app.theme.style import BETTER, MUTED, WORSE
from tests.app.driving import named

_START = {
    "hexes": 32735,
    "nodes": 37473,
    "free_nodes": 28317,
    "inverted": 36,
    "locked_inverted": 0,
    "invalid": 40,
    "min_jacobian": -1.0,
    "q_min": 0.0123456789,
    "q_mean": 0.85,
    "q_max": 0.99,
    "q_std": 0.1,
    "q_norm": 0.0,
    "scaled_jacobian_min": -0.5,
    "objective": None,
}
_NOW = _START | {
    "inverted": 0,
    "invalid": 0,
    "min_jacobian": 0.1,
    "q_min": 0.5,
    "q_mean": 0.8,
    "q_norm": 0.7,
    "q_std": 0.05,
    "scaled_jacobian_min": 0.3,
    "objective": 9.5,
}
_ROW_OF = {row.key: number for number, row in enumerate(ROWS)}


@pytest.fixture
def table(shown):
    widget = shown(StatisticsTable())
    widget.set_summaries(SimpleNamespace(**_START), SimpleNamespace(**_NOW))
    return widget


def grid(table):
    return named(table, QTableWidget, "Statistics of the mesh")


def cell(table, key, column):
    return grid(table).item(_ROW_OF[key], column)


def test_regressions_of_important_figures_are_bold(table):
    table.set_summaries(SimpleNamespace(**_NOW), SimpleNamespace(**_START))
    bold = {key for key in _ROW_OF if cell(table, key, 3).font().bold()}
    assert bold == {"inverted", "invalid", "q_min", "scaled_jacobian_min"}
    for key in bold:
        assert cell(table, key, 3).foreground().color() == QColor(str(WORSE))
        assert cell(table, key, 3).data(Qt.ItemDataRole.AccessibleTextRole).endswith("worse")
    table.set_summaries(SimpleNamespace(**_START), SimpleNamespace(**_NOW))
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
    grid(table).setFocus()
    QTest.keyClick(grid(table), Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert len(lines) == len(ROWS) + 1
    assert all(len(line) == 3 for line in lines)
    by_title = {line[0]: line[1:] for line in lines}
    assert by_title["q min"] == ["0.0123456789", "0.5"]
    assert by_title["Hexes"] == ["32735", "32735"]
    assert by_title["Objective Σ η²"] == ["", "9.5"]


@pytest.fixture
def with_inverted(table):
    """Return the table with inverted hexes now, and a list of the groups whose isolation was requested."""
    table.set_summaries(
        SimpleNamespace(**_START), SimpleNamespace(**_NOW | {"inverted": 12, "locked_inverted": 3, "invalid": 14})
    )
    requests = []
    table.isolate_requested.connect(requests.append)
    return table, requests


def click(table, key, column):
    position = grid(table).visualItemRect(cell(table, key, column)).center()
    QTest.mouseMove(grid(table).viewport(), position)
    QTest.mouseClick(grid(table).viewport(), Qt.MouseButton.LeftButton, pos=position)


def test_the_numbers_of_inverted_locked_and_invalid_hexes_are_links(with_inverted):
    table, requests = with_inverted
    for key in ("inverted", "locked_inverted", "invalid", "hexes"):
        click(table, key, 2)
    click(table, "inverted", 1)  # numbers at the start are no links
    assert requests == ["inverted", "locked", "invalid"]
    assert cell(table, "inverted", 2).font().underline()
    assert "Show only the locked hexes" in cell(table, "locked_inverted", 2).toolTip()
