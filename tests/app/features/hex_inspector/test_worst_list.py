"""The list of the worst elements."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton, QTableView

from hexmend.quality import METRICS, measure
from hexmend_app.features.hex_inspector.worst_file import write_worst
from hexmend_app.features.hex_inspector.worst_list import WorstList
from hexmend_app.state.mesh.worst_hexes import MOST
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(11), 0.7, 4)
FIGURES = measure(MESH.points, MESH.hexes)


@pytest.fixture
def worst_list(qtbot):
    widget = WorstList()
    qtbot.addWidget(widget)
    widget.resize(600, 300)
    widget.show()
    widget.set_figures(MESH, FIGURES)
    return widget


def button(widget, text):
    return next(b for b in widget.findChildren(QPushButton) if b.accessibleName() == text)


def row_at(widget, row):
    table = widget.findChild(QTableView)
    return table.viewport(), table.visualRect(table.model().index(row, 0)).center()


@pytest.mark.parametrize("name", METRICS)
def test_the_list_is_bounded_and_in_the_order_of_its_metric(worst_list, name):
    metric = worst_list.findChild(QComboBox)
    metric.setCurrentIndex(metric.findData(name))
    elements, better = worst_list.elements, METRICS[name].better or 1
    assert len(elements) == min(MOST, MESH.n_hexes) < MESH.n_hexes
    keys = better * METRICS[name].of(MESH.points, MESH.hexes, FIGURES)
    keys[np.isnan(keys)] = -np.inf
    listed = keys[elements]
    assert (listed[1:] >= listed[:-1]).all()
    assert np.sort(keys)[: len(elements)].tolist() == listed.tolist()
    equal = listed[1:] == listed[:-1]
    assert (np.diff(FIGURES.scaled_jacobian[elements])[equal] >= 0).all()


def test_an_inverted_element_of_good_quality_comes_after_worse_ones(worst_list):
    elements = worst_list.elements
    q, inverted = FIGURES.q[elements], FIGURES.inverted[elements]
    assert inverted.any()
    assert q[inverted].max() > q[~inverted].min()


def test_the_list_says_how_equal_elements_are_ordered(worst_list):
    def said():
        return " ".join(label.text() for label in worst_list.findChildren(QLabel))

    assert "equal ones by scaled Jacobian" in said()
    metric = worst_list.findChild(QComboBox)
    metric.setCurrentIndex(metric.findData("scaled-jacobian"))
    assert "equal ones" not in said()


def test_a_click_on_a_row_chooses_its_element(worst_list, qtbot):
    viewport, place = row_at(worst_list, 2)
    with qtbot.waitSignal(worst_list.chosen) as chosen:
        QTest.mouseClick(viewport, Qt.MouseButton.LeftButton, pos=place)
    assert chosen.args == [worst_list.elements[2]]


def test_next_and_previous_walk_from_what_is_selected_and_round_the_ends(worst_list):
    heard = []
    worst_list.chosen.connect(heard.append)
    worst_list.chosen.connect(worst_list.set_selected)
    for text in ("Next", "Next", "Previous", "Previous"):
        QTest.mouseClick(button(worst_list, text), Qt.MouseButton.LeftButton)
    elements = worst_list.elements.tolist()
    assert heard == [elements[0], elements[1], elements[0], elements[-1]]


def test_the_selected_row_follows_its_element_when_the_mesh_moves(worst_list):
    element = int(worst_list.elements[5])
    worst_list.set_selected(element)
    better = scrambled(grid(11), 0.5, 4)
    worst_list.set_figures(better, measure(better.points, better.hexes))
    row = worst_list.findChild(QTableView).currentIndex().row()
    listed = worst_list.elements.tolist()
    assert (listed[row] == element) if element in listed else row == -1


def test_what_cannot_be_seen_is_made_when_it_is_shown(qtbot):
    widget = WorstList()
    qtbot.addWidget(widget)
    widget.set_figures(MESH, FIGURES)
    assert widget.findChild(QTableView).model().rowCount() == 0
    widget.show()
    assert widget.findChild(QTableView).model().rowCount() == min(MOST, MESH.n_hexes)


def test_the_list_as_a_table_reads_back(worst_list, tmp_path):
    write_worst(tmp_path / "worst.csv", MESH, worst_list.chosen_metric)
    lines = (tmp_path / "worst.csv").read_text().splitlines()
    assert lines[0] == "hex,q,scaled-jacobian,state"
    number, q, jacobian, state = lines[1].split(",")
    assert int(number) == worst_list.elements[0]
    assert float(q) == FIGURES.q[int(number)]
    assert float(jacobian) == FIGURES.scaled_jacobian[int(number)]
    assert state == "inverted"


def test_without_a_mesh_nothing_can_be_pressed(qtbot):
    widget = WorstList()
    qtbot.addWidget(widget)
    assert not any(b.isEnabled() for b in widget.findChildren(QPushButton))
    widget.next()  # harmless
    assert not len(widget.elements)


def test_enter_and_a_double_click_choose_the_row_again(worst_list):
    viewport, place = row_at(worst_list, 1)
    QTest.mouseClick(viewport, Qt.MouseButton.LeftButton, pos=place)
    heard = []
    worst_list.chosen.connect(heard.append)
    element = worst_list.elements[1]
    QTest.keyClick(worst_list.findChild(QTableView), Qt.Key.Key_Return)
    assert heard == [element]
    QTest.mouseDClick(viewport, Qt.MouseButton.LeftButton, pos=place)
    assert heard == [element, element]


def test_the_focus_alone_chooses_nothing(worst_list, qtbot):
    with qtbot.waitActive(worst_list):
        worst_list.activateWindow()
    heard = []
    worst_list.chosen.connect(heard.append)
    worst_list.findChild(QTableView).setFocus(Qt.FocusReason.TabFocusReason)
    assert heard == []
