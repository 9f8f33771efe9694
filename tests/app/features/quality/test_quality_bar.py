"""Strip of quality figures in the view."""

import dataclasses

import pytest
from PySide6.QtGui import QGuiApplication, QTextDocument
from PySide6.QtWidgets import QLabel

from hexmend import Summary, summarise
from hexmend_app.features.quality.feature import FIGURES, ROWS, QualityBar, sense
from hexmend_app.theme.palette import BETTER, WORSE
from hexmend_app.widgets.wording import figure
from tests.app.driving import heard_from, run_to_end
from tests.core.grids import grid

START = dataclasses.replace(
    summarise(grid(2)),
    inverted=56, invalid=58, q_min=0.4035, q_mean=0.8916, q_std=0.1, scaled_jacobian_min=0.2224, objective=None,
)  # fmt: skip
NOW = dataclasses.replace(START, inverted=0, invalid=2, q_min=0.4841, q_mean=0.8781)


@pytest.fixture
def bar(shown):
    bar = shown(QualityBar(), 900, 30)
    bar.set_summaries(START, NOW)
    return bar


def table_of(bar):
    """Return the figures of the expanded table by title: at the start, now, change."""
    document = QTextDocument()
    document.setHtml(bar.table.text())
    cells = [cell.strip() for cell in document.toPlainText().replace("\xa0", " ").splitlines()]
    rows = [cells[at : at + 4] for at in range(1, len(cells), 4)]
    return {title: values for title, *values in rows if title}


def colours(bar):
    html = bar.findChild(QLabel).text()
    return [part.split(";")[0].split('"')[0] for part in html.split('<b style="color: ')[1:]]


def test_every_figure_of_a_summary_except_q_max_has_a_row():
    assert {row.key for row in ROWS} == {field.name for field in dataclasses.fields(Summary)} - {"q_max", "cells"}


@pytest.mark.parametrize("row", [row for row in ROWS if row.better])
def test_the_opposite_change_has_the_opposite_sense(row):
    assert (sense(row, 0.25, 0.5), sense(row, 0.5, 0.25), sense(row, 0.5, 0.5)) == (row.better, -row.better, 0)


def test_the_table_has_all_figures_and_their_changes(bar):
    bar.set_summaries(START, dataclasses.replace(NOW, objective=9.5))
    height = bar.sizeHint().height()
    bar.all_button.click()
    rows = table_of(bar)
    assert bar.sizeHint().height() > height
    assert len(rows) == len(ROWS)
    assert rows["Inverted"] == ["56", "0", "▼ 56"]
    assert rows["q min"] == ["0.4035", "0.4841", "▲ 0.0806"]
    assert rows["Hexes"] == ["8", "8", "="]
    assert rows["Objective Σ η²"] == ["–", "9.5000", "▼"]


def test_the_numbers_of_inverted_locked_and_invalid_hexes_are_links(bar):
    requests = heard_from(bar.isolate_requested)
    bar.set_summaries(START, dataclasses.replace(NOW, inverted=12, locked_inverted=3, invalid=14))
    bar.all_button.click()
    links = [part.split('"')[0] for part in bar.table.text().split('<a href="')[1:]]
    assert links == ["inverted", "locked", "invalid"]
    bar.table.linkActivated.emit("locked")
    assert requests == ["locked"]


def test_each_figure_has_its_value_at_the_start_and_an_arrow_in_the_colour_of_better_or_worse(bar):
    assert bar.text == (
        "inverted 56 → 0 ▼ invalid 58 → 2 ▼ q min 0.4035 → 0.4841 ▲ q mean 0.8916 → 0.8781 ▼ scaled Jacobian min 0.2224"
    )
    assert colours(bar)[:4] == [str(BETTER), str(BETTER), str(BETTER), str(WORSE)]
    assert "q mean 0.8781, worse than at the start: 0.8916" in bar.findChild(QLabel).accessibleDescription()


def test_figures_that_are_written_alike_have_no_arrow(bar):
    bar.set_summaries(START, dataclasses.replace(START, q_min=START.q_min - 1e-6))
    assert not set(bar.text) & set("▲▼→")


def test_a_narrow_bar_omits_the_figures_at_the_start(bar):
    bar.resize(420, bar.height())
    assert "q min 0.4841 ▲" in bar.text
    assert "→" not in bar.text
    bar.resize(900, bar.height())
    assert "0.4035 → 0.4841 ▲" in bar.text


def test_the_bar_follows_a_run_and_its_figures_are_copied(window, qtbot):
    window.resize(1400, 900)  # so that all figures fit
    bar = window.features["quality"].bar
    start = window.session.document.start.summary
    assert bar.isVisible()
    assert "→" not in bar.text
    seen = heard_from(window.session.run.iterated)
    run_to_end(window, qtbot, "local-sd", max_iterations=5)
    now = window.session.document.now.summary
    assert seen
    changes = [f"{one.label} {figure(getattr(start, one.key))} → {figure(getattr(now, one.key))}" for one in FIGURES]
    qtbot.waitUntil(lambda: all(change in bar.text for change in changes))
    window.action("copy_figures").trigger()
    lines = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert ["q min", str(start.q_min), str(now.q_min)] in lines
    assert len(lines) == len(ROWS) + 1
