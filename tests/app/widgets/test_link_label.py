"""Labels with links."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hexmend_app.widgets.link_label import LinkLabel


def test_a_link_is_followed_by_keys(shown, qtbot):
    label = shown(LinkLabel(), 200, 30)
    label.setText('Hexes: <a href="7">7</a>, <a href="1200">1,200</a>')
    with qtbot.waitActive(label):
        label.activateWindow()
    label.setFocus()
    QTest.keyClick(label, Qt.Key.Key_Tab)  # to the first link
    with qtbot.waitSignal(label.followed) as followed:
        QTest.keyClick(label, Qt.Key.Key_Return)
    assert followed.args == [7]
