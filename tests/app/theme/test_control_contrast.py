"""Texts of controls are legible, as painted, in both themes."""

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtGui import QAction, QIcon, QPalette
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QMenu, QTextBrowser, QToolTip, QWidget

from hexmend_app.theme import theme_choice
from hexmend_app.theme.palette import THEME
from hexmend_app.theme.style import apply_style
from hexmend_app.theme.theme_choice import ThemeChoice
from tests.app.driving import turn
from tests.app.theme.contrasts import BLOCK, DISABLED, TEXT, contrast, painted, text_contrast

pytestmark = pytest.mark.slow

THEMES = pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
SIZE = (300, 140)
WORDS = (BLOCK * 4, " " * 4)


@pytest.fixture(autouse=True)
def themed(request, qapp, shared):
    """Use the theme of the parameter `dark`; close the shared window, which would take seconds to change its theme."""
    if "dark" not in request.fixturenames:
        yield
        return
    shared.forget()
    apply_style(qapp, dark=request.getfixturevalue("dark"))
    blinking = qapp.cursorFlashTime()
    qapp.setCursorFlashTime(0)
    yield
    qapp.setCursorFlashTime(blinking)
    apply_style(qapp, dark=False)


def menu(text, enabled=True, active=False, checkable=False):
    """Return an open menu with an entry."""
    widget = QMenu()
    action = QAction(text, widget)
    action.setEnabled(enabled)
    action.setCheckable(checkable)
    action.setChecked(checkable)
    action.setIcon(QIcon())
    widget.addAction(action)
    widget.addAction("another one that is longer")
    if active:
        widget.setActiveAction(action)
    return widget


@THEMES
@pytest.mark.parametrize("current", [0, 1], ids=["current", "other"])
def test_texts_of_combo_popups_are_legible(qtbot, dark, current):
    images = []
    for text in WORDS:
        box = QComboBox()
        box.addItems([text, "another one"])
        box.setCurrentIndex(current)
        qtbot.addWidget(box)
        box.resize(*SIZE)
        box.show()
        with qtbot.waitExposed(box.view().window()):
            box.showPopup()
        popup = box.view().window()
        popup.resize(200, 70)
        turn()
        images.append(painted(popup))
        box.hidePopup()
    assert text_contrast(*images) >= TEXT


@THEMES
@pytest.mark.parametrize(
    "options",
    [{}, {"active": True}, {"enabled": False}, {"checkable": True}, {"checkable": True, "active": True}],
    ids=["enabled", "active", "disabled", "checked", "checked and active"],
)
def test_texts_of_menus_are_legible(qtbot, dark, options):
    images = []
    for text in WORDS:
        widget = menu(text, **options)
        qtbot.addWidget(widget)
        widget.setFixedSize(*SIZE)
        with qtbot.waitExposed(widget):
            widget.popup(QPoint(40, 40))
        widget.setActiveAction(widget.actions()[0] if options.get("active") else None)
        turn()
        images.append(painted(widget))
        widget.close()
    assert text_contrast(*images) >= (TEXT if options.get("enabled", True) else DISABLED)


@THEMES
def test_texts_of_tooltips_are_legible(qtbot, dark):
    images = []
    for text in WORDS:
        anchor = QWidget()
        qtbot.addWidget(anchor)
        anchor.show()
        QToolTip.showText(anchor.mapToGlobal(QPoint(5, 5)), text + "<b>.</b>", anchor)
        tip = next(
            w for w in QApplication.topLevelWidgets() if w.metaObject().className() == "QTipLabel" and w.isVisible()
        )
        tip.resize(*SIZE)
        images.append(painted(tip))
        QToolTip.hideText()
        tip.hide()
    assert text_contrast(*images) >= TEXT


ROLE, GROUP = QPalette.ColorRole, QPalette.ColorGroup
PAIRS = [
    (ROLE.WindowText, ROLE.Window), (ROLE.Text, ROLE.Base), (ROLE.PlaceholderText, ROLE.Base),
    (ROLE.ButtonText, ROLE.Button), (ROLE.HighlightedText, ROLE.Highlight), (ROLE.ToolTipText, ROLE.ToolTipBase),
    (ROLE.Link, ROLE.Base),  # of rich texts
]  # fmt: skip


def palette_faults(widget):
    """Return the pairs of colours of a widget's palette whose contrast is too low."""
    palette = widget.palette()
    for group, least in ((GROUP.Active, TEXT), (GROUP.Inactive, TEXT), (GROUP.Disabled, DISABLED)):
        for text, ground in PAIRS if isinstance(widget, (QLabel, QMenu, QTextBrowser)) else PAIRS[:-1]:
            colours = palette.color(group, text), palette.color(group, ground)
            if all(colour.alpha() == 255 for colour in colours):
                value = contrast(*(colour.name() for colour in colours))
                if value < least:
                    yield f"{group.name}: {text.name} on {ground.name}: {value:.2f}"


@pytest.mark.parametrize("choice", [ThemeChoice.LIGHT, ThemeChoice.DARK], ids=["light", "dark"])
def test_palettes_of_all_widgets_of_the_window_are_legible(window, choice):
    theme_choice.choose(choice)
    assert THEME.dark is (choice is ThemeChoice.DARK)
    turn()
    widgets = [window, *window.findChildren(QWidget)]
    assert len(widgets) > 200
    faults = {
        f"{type(widget.parent()).__name__} {type(widget).__name__} {widget.objectName()} {widget.accessibleName()}: {fault}"
        for widget in widgets
        for fault in palette_faults(widget)
    }
    theme_choice.choose(ThemeChoice.LIGHT)
    assert not faults
