"""The page of mouse and keys."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from hexmend_app.shell.keys import words
from hexmend_app.shell.keys_page import KeysPage


def test_the_page_of_keys_lists_every_key_and_finds_letters(window, qtbot):
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F1)
    page = next(one for one in window.findChildren(KeysPage) if one.isVisible())
    text = page.text()
    for declared in window.menus.declared():
        assert words(declared) in text
        assert declared.keys in text.replace("\xa0", " ")
    QTest.keyClicks(page.findChild(QLineEdit), "sharp")
    assert "Sharp edges" in page.text()
    assert "Open" not in page.text()
    page.close()
