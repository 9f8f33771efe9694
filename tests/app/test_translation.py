"""Texts of the window go through `tr`: with a translation that marks each text, no sentence is left unmarked."""

import dataclasses
import re

import pytest
from PySide6.QtCore import QCoreApplication, Qt, QTranslator
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QComboBox, QTabBar, QTableView, QTreeView, QWidget

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.quality import METRICS
from hexmend.quality.summary import SUMMARY_QUANTITIES
from hexmend.report.comparison import LINES
from hexmend.run.recipe_files import read_recipe
from hexmend.smoothers import METHODS
from hexmend_app.resources import recipes
from tests.app.conftest import close, separate_settings, window_with_mesh

GETTERS = ("text", "title", "toolTip", "statusTip", "whatsThis", "accessibleName", "accessibleDescription",
           "placeholderText")  # fmt: skip
SENTENCE = re.compile(r"[A-Za-z]{2,} [a-z]{2,} [a-z]{2,}")
MARKED = re.compile(r"⟦[^⟦⟧]*⟧")


class Marking(QTranslator):
    """Translation of each text to itself in brackets."""

    def translate(self, context, text, *rest):
        return f"⟦{text}⟧"

    def isEmpty(self):
        return False


@pytest.fixture
def marked_window(qtbot, qapp, mesh_file, tmp_path):
    translation = Marking()
    QCoreApplication.installTranslator(translation)
    try:
        with separate_settings(tmp_path / "settings"):
            window = window_with_mesh(qtbot, mesh_file)
            yield window
            close(window)
    finally:
        QCoreApplication.removeTranslator(translation)


def texts_of(part):
    """Return the texts that a widget or an action shows."""
    for name in GETTERS:
        if part.metaObject().indexOfProperty(name) >= 0:
            yield part.property(name) or ""
    if isinstance(part, QComboBox):
        yield from (part.itemText(at) for at in range(part.count()))
    if isinstance(part, QTabBar):
        yield from (part.tabText(at) for at in range(part.count()))
        yield from (part.tabToolTip(at) for at in range(part.count()))
    if isinstance(part, QTableView | QTreeView) and (model := part.model()) is not None:
        for column in range(model.columnCount()):
            yield str(model.headerData(column, Qt.Orientation.Horizontal) or "")


def texts_of_core():
    """Return the titles and helps of methods, metrics and quantities, which are data of the core; longest first."""
    declared = [*METRICS.values(), *DISPLACEMENT_QUANTITIES.values(), *SUMMARY_QUANTITIES.values(), *LINES]
    texts = {getattr(one, field.name) for one in declared for field in dataclasses.fields(one)}
    texts |= {text for method in METHODS.values() for text in (method.title, method.help, method.source)}
    texts |= {read_recipe(path).title for path in recipes()}
    return sorted((text for text in texts if isinstance(text, str) and SENTENCE.search(text)), key=len, reverse=True)


def unmarked(text, core):
    text = re.sub(r"<[^>]*>", "", text)
    while MARKED.search(text):
        text = MARKED.sub("", text)
    for known in core:
        text = text.replace(known, "")
    return SENTENCE.search(text) is not None


def test_sentences_of_the_window_go_through_tr(marked_window):
    core = texts_of_core()
    parts = [marked_window, *marked_window.findChildren(QWidget), *marked_window.findChildren(QAction)]
    texts = {text for part in parts for text in texts_of(part)}
    assert sum("⟦" in text for text in texts) > 500
    assert sorted(text for text in texts if unmarked(text, core)) == []


def test_unmarked_sentences_are_found():
    assert unmarked("Pause after this iteration.", [])
    assert not unmarked("⟦Pause after {what}⟧: ⟦this⟧", [])
    assert not unmarked("Local steepest descent of nodes", ["Local steepest descent of nodes"])
