"""Keyboard navigation: every control is reached in reading order and has a name."""

from collections import Counter

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractScrollArea, QAbstractSpinBox, QApplication, QLabel, QTabBar, QWidget

from hexmend_app.widgets.section import Section
from tests.app.driving import choose_by_keys, named

pytestmark = pytest.mark.slow


def tab(window, key=Qt.Key.Key_Tab):
    """Press Tab or another key, and return the widget with the focus."""
    QTest.keyClick(QApplication.focusWidget(), key)
    return QApplication.focusWidget()


def walk(window, key=Qt.Key.Key_Tab):
    """All widgets that Tab goes through, from the one after the view on to the view; or the other way round.

    In the view itself Tab is for the panels: there, Shift and Tab lead out.
    """
    view = window.canvas.interactor
    view.setFocus()
    reached = []
    if key == Qt.Key.Key_Tab:
        reached.append(walk(window, Qt.Key.Key_Backtab)[-2])
        reached[0].setFocus(Qt.FocusReason.TabFocusReason)
    for _ in range(300):
        now = tab(window, key)
        if now is view:
            return [*reached, view]
        seen = now.viewport() if isinstance(now, QAbstractScrollArea) else now
        assert not seen.visibleRegion().isEmpty(), f"{now} has the focus and cannot be seen"
        # A text walks through its own links first.
        if not reached or now is not reached[-1] or not isinstance(now, QLabel):
            reached.append(now)
    raise AssertionError(f"Tab does not come back: it walks around {reached[-5:]}")


def controls(window):
    """Return the widgets that Tab must reach, according to their focus policies."""
    chosen = [
        widget
        for widget in window.findChildren(QWidget)
        if widget.isVisible()
        and widget.isEnabled()
        and widget.focusPolicy() & Qt.FocusPolicy.TabFocus
        and widget.focusProxy() is None
        and not isinstance(widget.parentWidget(), QAbstractSpinBox)
    ]
    # Of buttons of which one is chosen, Tab reaches that one, and arrow keys the others.
    return [one for one in chosen if not getattr(one, "group", lambda: None)() or one.isChecked()]


@pytest.fixture
def everything_on(window):
    """The window with as many options on as possible."""
    window.action("cut").trigger()
    window.messages.show_error("Something", "to copy and dismiss")
    window.session.selection.choose(7, int(window.session.document.now.mesh.hexes[7, 0]))
    window.session.commands.tag("bad", [7])
    for section in window.findChildren(Section):
        section.expand()
    window.refresh()
    window.action("tags").trigger()
    return window


#: Panels that can be in front together, so that each is once.
FRONTS = [
    ("run", "histogram", "worst"),
    ("look", "histogram", "hex"),
    ("cut", "histogram", "convergence"),
    ("show", "histogram", "worst"),
    ("movement", "histogram", "worst"),
    ("recipe", "histogram", "node"),
    ("inside", "histogram", "outcome"),
    ("run", "histogram", "doctor"),
    ("run", "histogram", "compare"),
    ("look", "histogram", "reproduce"),
]


def settle():
    """Let sizes reach all levels of nested panels: one level for each pass of the event loop."""
    for _ in range(10):
        QApplication.processEvents()


def bring(window, panels):
    """Show panels, those below the view alone."""
    window.docks.set_drawer_open(False)
    for panel in panels:
        window.show_panel(panel)
    window.refresh()
    settle()
    assert all(map(window.is_visible, panels))


def test_tab_reaches_every_control_once_and_returns(everything_on):
    window = everything_on
    assert {panel for panels in FRONTS for panel in panels} == set(window.docks.ids()) - {"timeline"}
    for panels in FRONTS:
        bring(window, panels)
        reached = walk(window)
        assert max(Counter(map(id, reached)).values()) == 1
        meant = controls(window)
        assert [one.accessibleName() for one in meant if one not in reached] == [], panels
        assert [one.accessibleName() for one in reached if one not in meant] == [], panels
        back = walk(window, Qt.Key.Key_Backtab)
        assert back == [*reached[-2::-1], reached[-1]], panels


def test_tab_goes_in_reading_order(everything_on):
    window = everything_on
    bring(window, ("run", "histogram", "hex"))
    window.show_panel("worst")
    settle()
    reached = walk(window)
    tools, facts = (window.features[name].panel for name in ("smooth", "histogram"))
    parts = [
        window.canvas.colour_bar,
        window.features["quality"].bar,
        window.messages,
        window.features["tags"].strip,
        window.features["timeline"].panel,
        named(window, QTabBar, "Panels below the view"),
        window.features["hex_inspector"].worst_list,
        window.docks.buttons,
        named(window, QTabBar, "Tools"),
        tools,
        facts,
        window.canvas.interactor,
    ]
    at = [next((k for k, part in enumerate(parts) if part is one or part.isAncestorOf(one)), None) for one in reached]
    within = [one for one, part in zip(reached, at, strict=True) if part is None]
    assert all(
        isinstance(one.parentWidget(), Section) or window.features["recipe"].panel.isAncestorOf(one) for one in within
    )
    seen = [part for part in at if part is not None]
    assert seen == sorted(seen), seen
    assert set(seen) == set(range(len(parts)))
    assert_read_from_the_top(window, reached)
    choose_by_keys(window, "local-sd")  # its parameters are made while the window is there
    settle()
    assert_read_from_the_top(window, walk(window))
    bring(window, ("cut", "histogram", "worst"))
    assert_read_from_the_top(window, walk(window))
    bring(window, ("look", "histogram", "worst"))
    assert_read_from_the_top(window, walk(window))


def assert_read_from_the_top(window, reached):
    for panel in (
        window.features["appearance"].panel,
        window.features["cut"].panel,
        window.features["cut"].inside,
        window.features["smooth"].panel,
    ):
        inside = [one for one in reached if panel.isAncestorOf(one)]
        places = [one.mapTo(panel, QPoint(0, one.height() // 2)) for one in inside]
        for (x, y), (next_x, next_y) in zip(
            [p.toTuple() for p in places], [p.toTuple() for p in places[1:]], strict=False
        ):
            assert next_y > y - 8
            assert next_x > x or next_y > y + 8
