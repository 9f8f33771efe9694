"""What is shown of one element."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QTextDocumentFragment
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QLabel, QPushButton

from hexmend.quality import describe_hex, measure
from hexmend_app.features.hex_inspector.hex_panel import ElementPanel
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
    assert any("Click a hex" in text for text in texts(panel))


def test_an_element_is_shown_with_figures_nodes_and_neighbours(panel):
    one = describe_hex(MESH, WORST)
    panel.show_element(one)
    shown = texts(panel)
    assert f"Hex {WORST:,}" in shown
    assert "inverted" in shown
    assert all(any(f">{node:,}<" in text for text in shown) for node in one.nodes)
    assert f"{one.values['q']:.4f}" in shown
    assert shown.count("free") + shown.count("fixed") == 8


def neighbours(panel):
    return next(label for label in panel.findChildren(QLabel) if label.accessibleName() == "Neighbours")


def test_neighbours_are_links_for_keys(panel, qtbot):
    one = describe_hex(MESH, WORST)
    panel.show_element(one)
    with qtbot.waitActive(panel):
        panel.activateWindow()
    links = neighbours(panel)
    links.setFocus()
    QTest.keyClick(links, Qt.Key.Key_Tab)  # to the first link
    with qtbot.waitSignal(panel.chosen, timeout=1000) as chosen:
        QTest.keyClick(links, Qt.Key.Key_Return)
    assert chosen.args[0] == next(h for h in one.neighbours if h >= 0)


def test_neighbours_are_links_for_the_mouse(panel, qtbot):
    one = describe_hex(MESH, WORST)
    panel.show_element(one)
    links = neighbours(panel)
    first = int(min(np.flatnonzero(one.neighbours >= 0)))
    text = QTextDocumentFragment.fromHtml(links.text()).toPlainText()
    number = f"{one.neighbours[first]:,}"
    before = text[: text.index(number)]
    x = links.fontMetrics().horizontalAdvance(before) + links.fontMetrics().horizontalAdvance(number) // 2
    with qtbot.waitSignal(panel.chosen, timeout=1000) as chosen:
        QTest.mouseClick(links, Qt.MouseButton.LeftButton, pos=QPoint(x, links.fontMetrics().height() // 2))
    assert chosen.args[0] == one.neighbours[first]


def test_a_low_and_wide_panel_needs_no_scrolling(panel):
    panel.show_element(describe_hex(MESH, WORST))
    assert panel.heightForWidth(1000) <= 230
    assert panel.minimumSizeHint().width() <= 340


def test_its_buttons_tell_what_the_user_wants(panel, qtbot):
    panel.show_element(describe_hex(MESH, WORST))
    with qtbot.waitSignal(panel.fly_requested):
        QTest.mouseClick(panel.findChild(QPushButton), Qt.MouseButton.LeftButton)
    with qtbot.waitSignal(panel.corners_toggled):
        panel.findChild(QCheckBox).click()
    assert panel.corners_in_view
