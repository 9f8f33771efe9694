"""Panels behind tabs, and a drawer of them that folds."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QSplitter

from hexmend_app.shell.tabs import Drawer, Tabs
from tests.app.driving import LEFT

TITLES = ("One", "Two", "Three")


def filled(tabs):
    """The tabs with three pages."""
    tabs.pages = [QLabel(title) for title in TITLES]
    for page in tabs.pages:
        tabs.add(page, page.text(), f"Page {page.text()}.")
    return tabs


@pytest.fixture
def tabs(shown):
    return shown(filled(Tabs("Pages")), 400, 200)


@pytest.fixture
def drawer(shown):
    """A drawer below something."""
    splitter = QSplitter(Qt.Orientation.Vertical)
    drawer = filled(Drawer("Pages"))
    splitter.addWidget(QLabel("Above"))
    splitter.addWidget(drawer)
    splitter.setCollapsible(1, False)
    shown(splitter, 400, 600)
    QApplication.processEvents()
    yield drawer
    splitter.hide()


def click(tabs, at):
    """Click on a tab."""
    QTest.mouseClick(tabs.tabBar(), LEFT, pos=tabs.tabBar().tabRect(at).center())
    QApplication.processEvents()


def heard(tabs):
    """How often other pages were to be seen."""
    told = []
    tabs.changed.connect(lambda: told.append(tabs.front))
    return told


def above(drawer):
    return drawer.parentWidget().widget(0)


def test_a_page_is_brought_to_the_front_and_closed_and_shown_again(tabs):
    one, two, _ = tabs.pages
    told = heard(tabs)
    assert tabs.shows(one)
    tabs.bring(two)
    assert tabs.shows(two)
    assert tabs.front == "Two"
    tabs.close_page(two)
    assert not tabs.is_open(two)
    assert not tabs.shows(two)
    assert two.isHidden()
    tabs.bring(two)
    assert tabs.is_open(two)
    assert tabs.shows(two)
    assert told[-1] == "Two"


def test_a_page_is_found_by_its_title(tabs):
    tabs.set_front("Three")
    assert tabs.shows(tabs.pages[2])
    tabs.set_front("Four")
    assert tabs.front == "Three"


def test_tabs_explain_themselves_and_have_a_name(tabs):
    assert tabs.tabBar().accessibleName() == "Pages"
    assert [tabs.tabToolTip(at) for at in range(3)] == ["Page One.", "Page Two.", "Page Three."]


def test_the_drawer_is_folded_at_first_and_leaves_its_room(drawer):
    assert drawer.folded
    assert drawer.height() < 40
    assert above(drawer).height() > 550
    assert not any(drawer.shows(page) for page in drawer.pages)


def test_any_tab_opens_the_drawer_and_the_one_in_front_folds_it(drawer):
    told = heard(drawer)
    click(drawer, 1)
    assert drawer.shows(drawer.pages[1])
    assert drawer.height() == drawer.height_unfolded == 260
    click(drawer, 2)
    assert drawer.shows(drawer.pages[2])
    click(drawer, 2)
    assert drawer.folded
    assert drawer.height() < 40
    assert above(drawer).height() > 550  # nothing is left empty
    click(drawer, 2)
    assert drawer.shows(drawer.pages[2])
    assert told[-1] == "Three"


def test_the_drawer_opens_as_high_as_it_was_dragged(drawer):
    drawer.set_folded(False)
    drawer.parentWidget().setSizes([200, 395])
    high = drawer.height()
    assert high > 300
    assert drawer.height_open == high
    click(drawer, drawer.currentIndex())
    assert drawer.folded
    assert drawer.height_open == high
    drawer.bring(drawer.pages[1])
    assert drawer.height() == high


def test_a_page_is_offered_without_opening_the_drawer(drawer):
    drawer.offer(drawer.pages[2])
    assert drawer.folded
    assert drawer.front == "Three"
    drawer.bring(drawer.pages[1])
    assert drawer.shows(drawer.pages[1])
