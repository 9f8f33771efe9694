"""The page of mouse and keys."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from hexmend_app.shell.keys import name_of
from hexmend_app.shell.keys_page import KeysPage


def test_the_page_lists_every_key_and_can_be_filtered(window, qtbot):
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F1)
    page = next(page for page in window.findChildren(KeysPage) if page.isVisible())
    text = page.text()
    for declared in window.menus.declared():
        assert name_of(declared) in text
        assert declared.keys in text.replace("\xa0", " ")
    QTest.keyClicks(page.findChild(QLineEdit), "sharp")
    assert "Sharp edges" in page.text()
    assert "Open" not in page.text()
    page.close()
