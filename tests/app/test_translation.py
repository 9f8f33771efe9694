"""Texts of the window in another language, by Qt's translators."""

import pytest
from PySide6.QtCore import QCoreApplication, QTranslator

from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted

GERMAN = {"Flip": "Umkehren", "{count:,} hidden": "{count:,} versteckt", "nodes": "Knoten"}


class German(QTranslator):
    """Translation as of a file of Qt Linguist, whose context of functions outside classes is empty."""

    def translate(self, context, text, comment=None, number=-1):
        return GERMAN.get(text) if context == "" else None


@pytest.fixture
def german(qapp):
    translator = German()
    QCoreApplication.installTranslator(translator)
    yield
    QCoreApplication.removeTranslator(translator)


def test_texts_are_those_of_the_translation_and_else_english(german):
    assert [tr("Flip"), tr("{count:,} hidden", count=1234), tr("Stop")] == ["Umkehren", "1,234 versteckt", "Stop"]
    assert [counted(2, "node"), counted(1, "node")] == ["2 Knoten", "1 node"]
