"""The viewer's dress: palette, fonts and icons in one place, so that all widgets look like one program."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QIcon, QIconEngine, QPainter, QPalette, QPixmap
from PySide6.QtWidgets import QApplication, QLabel, QSizePolicy, QToolTip, QWidget

from hexmend_app.theme.palette import (
    ACCENT,
    AMBER,
    BETTER,
    BLUE,
    BUTTON,
    FAINT,
    FIELD,
    FRAME,
    GLEAM,
    GREY,
    INVERTED,
    INVERTED_TEXT,
    LINE,
    MUTED,
    ON_ACCENT,
    PANEL,
    SHADOW,
    SHEEN,
    STRIPE,
    TEXT,
    THEME,
    WORSE,
    Role,
)

_ROLES = QPalette.ColorRole
_PALETTE = (
    (_ROLES.Window, PANEL),
    (_ROLES.WindowText, TEXT),
    (_ROLES.Base, FIELD),
    (_ROLES.AlternateBase, STRIPE),
    (_ROLES.Text, TEXT),
    (_ROLES.Button, BUTTON),
    (_ROLES.ButtonText, TEXT),
    (_ROLES.BrightText, ON_ACCENT),
    (_ROLES.Light, GLEAM),
    (_ROLES.Midlight, SHEEN),
    (_ROLES.Dark, SHADOW),
    (_ROLES.ToolTipBase, FIELD),
    (_ROLES.ToolTipText, TEXT),
    (_ROLES.PlaceholderText, MUTED),
    (_ROLES.Highlight, ACCENT),
    (_ROLES.HighlightedText, ON_ACCENT),
    (_ROLES.Accent, BLUE),
    (_ROLES.Link, BLUE),
    (_ROLES.LinkVisited, BLUE),
)

#: Controls in whose palette the window's colour is nothing but that of their frames.
_FRAMED = ("QCheckBox", "QPushButton", "QComboBox", "QAbstractSpinBox", "QLineEdit", "QSlider", "QMenu")


class _Mirror(QObject):
    """Tells what is dressed that the theme is another."""

    changed = Signal()


_MIRROR = _Mirror()


def apply_style(app: QApplication, dark: bool) -> None:
    """Give the program the Fusion look in the light theme or the dark one, and have all widgets change with it."""
    if app.property("dark") is dark:
        return
    if app.property("dark") is None:  # once: it has every widget polished anew, which takes longer than all colours
        app.setStyle("Fusion")
    app.setProperty("dark", dark)
    palette = QPalette(QColor(BUTTON.of(dark)), QColor(PANEL.of(dark)))
    for role, colour in _PALETTE:
        palette.setColor(role, QColor(colour.of(dark)))
    for role in (_ROLES.WindowText, _ROLES.Text, _ROLES.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(FAINT.of(dark)))
    app.setPalette(palette)
    QToolTip.setPalette(palette)
    palette.setColor(_ROLES.Window, QColor(FRAME.of(dark)))
    for control in _FRAMED:
        app.setPalette(palette, control)
    THEME.dark = dark
    _MIRROR.changed.emit()


class _Dress(QObject):
    """Part of a widget: what puts it into the theme's colours."""

    def __init__(self, widget: QWidget, put_on: Callable[[], object]):
        super().__init__(widget)
        self._put_on = put_on
        _MIRROR.changed.connect(self.put_on)
        self.put_on()

    def put_on(self) -> None:
        """Take the colours of the theme that is worn."""
        self._put_on()


def on_theme_change(widget: QWidget, put_on: Callable[[], object]) -> None:
    """Call what gives `widget` its colours, now and whenever the theme changes, as long as the widget lives."""
    _Dress(widget, put_on)


def tabular(font: QFont) -> QFont:
    """A copy of `font` whose digits are all of one width, so that columns line up and changing numbers hold still."""
    font = QFont(font)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


def smaller(font: QFont) -> QFont:
    """A copy of `font` for what explains rather than says."""
    font = QFont(font)
    font.setPointSizeF(max(font.pointSizeF() * 0.88, 7.0))
    return font


class _IconEngine(QIconEngine):
    """Paints a glyph in the colour that its role has at that moment."""

    def __init__(self, name: str, role: Role):
        super().__init__()
        self._name, self._role = name, role

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Paint the glyph, as large as the rectangle."""
        import qtawesome  # its fonts are not there before something is painted with them

        glyph = qtawesome.icon(self._name, color=str(self._role), color_disabled=str(FAINT))
        glyph.paint(painter, rect, Qt.AlignmentFlag.AlignCenter, mode, state)

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        """The glyph on nothing; `size` is in pixels of the screen."""
        drawn = QPixmap(size)
        drawn.fill(Qt.GlobalColor.transparent)
        painter = QPainter(drawn)
        self.paint(painter, QRect(QPoint(0, 0), size), mode, state)
        painter.end()
        return drawn

    def clone(self) -> QIconEngine:
        """Another of the same."""
        return _IconEngine(self._name, self._role)


def icon(name: str, role: Role = TEXT) -> QIcon:
    """A Material Design icon by name, sharp at every scale and right in either theme."""
    return QIcon(_IconEngine(f"mdi6.{name}", role))


def set_help(widget: QWidget, name: str, help: str) -> None:
    """Give `widget` its accessible name, and one sentence of help as tooltip and for Shift+F1.

    What it has already is left alone: Qt tells everybody of a text that is set, even of the same.
    """
    if widget.accessibleName() != name:
        widget.setAccessibleName(name)
    if widget.accessibleDescription() != help:
        widget.setAccessibleDescription(help)
    # The tag makes Qt wrap long plain tooltips.
    tip = f"<qt>{help}</qt>" if help else ""
    if widget.toolTip() != tip:
        widget.setToolTip(tip)
    if widget.whatsThis() != tip:
        widget.setWhatsThis(tip)


def note(text: str = "", colour: Role = MUTED, parent: QWidget | None = None) -> QLabel:
    """A small wrapped label that can be selected with the mouse."""
    label = QLabel(text, parent)
    label.setFont(smaller(label.font()))
    label.setWordWrap(True)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    tint(label, colour)
    policy = QSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
    policy.setHeightForWidth(True)
    label.setSizePolicy(policy)
    return label


def tint(widget: QWidget, colour: Role) -> None:
    """Colour the text of `widget`, until it is tinted again."""
    dressed = widget.property("tint") is not None
    widget.setProperty("tint", colour)
    if dressed:
        _tint(widget)
    else:
        on_theme_change(widget, lambda: _tint(widget))


def _tint(widget: QWidget) -> None:
    palette = QPalette()
    palette.setColor(_ROLES.WindowText, QColor(str(widget.property("tint"))))
    widget.setPalette(palette)


__all__ = [
    "AMBER",
    "BETTER",
    "BLUE",
    "FAINT",
    "FIELD",
    "GREY",
    "INVERTED",
    "INVERTED_TEXT",
    "LINE",
    "MUTED",
    "PANEL",
    "TEXT",
    "WORSE",
    "apply_style",
    "icon",
    "note",
    "on_theme_change",
    "set_help",
    "smaller",
    "tabular",
    "tint",
]
