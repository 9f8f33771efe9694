"""What is shown of one element."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QLabel, QPushButton

from hexmend.quality import element, measure
from hexmend_app.widgets.element_panel import ElementPanel
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(5), 0.9, 4)
WORST = int(measure(MESH.points, MESH.hexes).scaled_jacobian.argmin())


@pytest.fixture
def panel(qtbot):
    widget = ElementPanel()
    qtbot.addWidget(widget)
    widget.resize(520, 260)
    widget.show()
    return widget


def texts(panel):
    return [label.text() for label in panel.findChildren(QLabel) if label.isVisible()]


def test_without_an_element_it_says_how_to_choose_one(panel):
    panel.show_element(None)
    assert any("Click an element" in text for text in texts(panel))


def test_an_element_is_shown_with_figures_nodes_and_neighbours(panel):
    one = element(MESH, WORST)
    panel.show_element(one)
    shown = texts(panel)
    assert f"Element {WORST:,}" in shown
    assert "inverted" in shown
    assert all(any(f">{node:,}<" in text for text in shown) for node in one.nodes)
    assert f"{one.values['q']:.4f}" in shown
    assert shown.count("free") + shown.count("fixed") == 8


def test_neighbours_are_links(panel, qtbot):
    one = element(MESH, WORST)
    panel.show_element(one)
    links = next(label for label in panel.findChildren(QLabel) if label.accessibleName() == "Neighbours")
    with qtbot.waitSignal(panel.chosen) as chosen:
        links.setFocus()
        QTest.keyClick(links, Qt.Key.Key_Tab)
        QTest.keyClick(links, Qt.Key.Key_Return)
        if not chosen.args:
            links.linkActivated.emit(str(one.neighbours.max()))
    assert chosen.args[0] in one.neighbours


def test_its_buttons_tell_what_the_user_wants(panel, qtbot):
    panel.show_element(element(MESH, WORST))
    with qtbot.waitSignal(panel.fly_requested):
        QTest.mouseClick(panel.findChild(QPushButton), Qt.MouseButton.LeftButton)
    with qtbot.waitSignal(panel.corners_toggled):
        panel.findChild(QCheckBox).click()
    assert panel.corners_in_view
