"""Labels with links."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.widgets.link_label import LinkLabel


def test_a_link_is_followed_by_keys(shown, qtbot):
    panel, label = QWidget(), LinkLabel()
    QVBoxLayout(panel).addWidget(label)
    label.setText('Hexes: <a href="7">7</a>, <a href="1200">1,200</a>')
    shown(panel, 200, 60)
    with qtbot.waitActive(panel):
        panel.activateWindow()
    label.setFocus()
    QTest.keyClick(label, Qt.Key.Key_Tab)  # to the first link
    with qtbot.waitSignal(label.followed) as followed:
        QTest.keyClick(label, Qt.Key.Key_Return)
    assert followed.args == [7]
