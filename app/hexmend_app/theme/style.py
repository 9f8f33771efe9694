"""Style of the program: palette, fonts and icons of all widgets."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from string import Template

from PySide6.QtCore import QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QIcon, QIconEngine, QPainter, QPalette, QPixmap
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QCheckBox,
    QLabel,
    QPushButton,
    QSizePolicy,
    QToolButton,
    QToolTip,
    QWidget,
)

from hexmend_app.resources import resource
from hexmend_app.theme import palette
from hexmend_app.theme.palette import (
    BLUE,
    BUTTON,
    FAINT,
    FIELD,
    LINE,
    MUTED,
    ON_ACCENT,
    PANEL,
    SELECTION,
    STRIPE,
    TEXT,
    THEME,
    Role,
)

_ROLE = QPalette.ColorRole
_PALETTE = (
    (_ROLE.Window, PANEL),
    (_ROLE.WindowText, TEXT),
    (_ROLE.Base, FIELD),
    (_ROLE.AlternateBase, STRIPE),
    (_ROLE.Text, TEXT),
    (_ROLE.Button, BUTTON),
    (_ROLE.ButtonText, TEXT),
    (_ROLE.BrightText, ON_ACCENT),
    (_ROLE.Light, PANEL),
    (_ROLE.Midlight, PANEL),
    (_ROLE.Mid, LINE),
    (_ROLE.Dark, LINE),
    (_ROLE.ToolTipBase, FIELD),
    (_ROLE.ToolTipText, TEXT),
    (_ROLE.PlaceholderText, MUTED),
    (_ROLE.Highlight, SELECTION),
    (_ROLE.HighlightedText, ON_ACCENT),
    (_ROLE.Accent, BLUE),
    (_ROLE.Link, BLUE),
    (_ROLE.LinkVisited, BLUE),
)


class _IconEngine(QIconEngine):
    """Paints an icon in the current colour of a role."""

    def __init__(self, name: str, role: Role):
        super().__init__()
        self._name, self._role = name, role

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Paint the icon in the size of the rectangle."""
        import qtawesome  # imported late, as it loads fonts

        glyph = qtawesome.icon(f"mdi6.{self._name}", color=str(self._role), color_disabled=str(FAINT), scale_factor=1.1)
        glyph.paint(painter, rect, Qt.AlignmentFlag.AlignCenter, mode, state)

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        """Return the icon on a transparent background; `size` is in device pixels."""
        pixmap = QPixmap(size)
        if pixmap.isNull():  # for a button whose height letters of twice the size have taken
            return pixmap
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        self.paint(painter, QRect(QPoint(0, 0), size), mode, state)
        painter.end()
        return pixmap

    def clone(self) -> QIconEngine:
        """Return a copy."""
        return _IconEngine(self._name, self._role)


def icon(name: str, role: Role = TEXT) -> QIcon:
    """Return an icon of Material Design, which is sharp at all scales and follows the theme.

    Parameters
    ----------
    name : str
    role : Role
        Its colour.
    """
    return QIcon(_IconEngine(name, role))


@cache
def control_sheet(dark: bool) -> str:
    """Return the style sheet of all controls in the dark or in the light theme."""
    colours = {name: role.of(dark) for name, role in vars(palette).items() if isinstance(role, Role)}
    sheet = Template(resource("controls.qss").read_text(encoding="utf-8"))
    return sheet.substitute(colours, images=resource("controls").as_posix())


class _ThemeNotifier(QObject):
    """Emits `changed` when the theme changes."""

    changed = Signal()


_NOTIFIER = _ThemeNotifier()


def apply_style(app: QApplication, dark: bool) -> None:
    """Set the palette and the style sheet of the light or the dark theme, and update all widgets."""
    if app.property("dark") is dark:
        return
    if app.property("dark") is None:  # only once, as it polishes all widgets, which is slow
        app.setStyle("Fusion")
    app.setProperty("dark", dark)
    colours = QPalette(QColor(BUTTON.of(dark)), QColor(PANEL.of(dark)))
    for role, colour in _PALETTE:
        colours.setColor(role, QColor(colour.of(dark)))
    for role in (_ROLE.WindowText, _ROLE.Text, _ROLE.ButtonText):
        colours.setColor(QPalette.ColorGroup.Disabled, role, QColor(FAINT.of(dark)))
    app.setPalette(colours)
    QToolTip.setPalette(colours)
    THEME.dark = dark
    app.setStyleSheet(control_sheet(dark))
    _NOTIFIER.changed.emit()


class _ThemeListener(QObject):
    """Child of a widget that calls a function when the theme changes, until the widget is deleted."""

    def __init__(self, widget: QWidget, apply_colours: Callable[[], object]):
        super().__init__(widget)
        self._apply_colours = apply_colours
        _NOTIFIER.changed.connect(self.update_colours)
        self.update_colours()

    def update_colours(self) -> None:
        """Apply the colours of the current theme."""
        self._apply_colours()


def on_theme_change(widget: QWidget, apply_colours: Callable[[], object]) -> None:
    """Call a function that sets the colours of `widget` now, and on theme changes while the widget exists."""
    _ThemeListener(widget, apply_colours)


def set_variant(widget: QWidget, value: str | bool, name: str = "variant") -> None:
    """Set a property that selects rules of the style sheet, and apply them.

    Parameters
    ----------
    widget : QWidget
    value : str or bool
        For `variant`: "main", "small", "section", "link", "segment", "panel" or "lined".
    name : str
        Name of the property.
    """
    if widget.property(name) == value:
        return
    widget.setProperty(name, value)
    if widget.testAttribute(Qt.WidgetAttribute.WA_WState_Polished):  # otherwise Qt applies them when it is first shown
        widget.style().unpolish(widget)
        widget.style().polish(widget)


def tabular(font: QFont) -> QFont:
    """Return a copy of `font` with tabular digits, so that columns are aligned and changing numbers do not move."""
    font = QFont(font)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


def smaller(font: QFont) -> QFont:
    """Return a smaller copy of `font`, for explanations."""
    font = QFont(font)
    font.setPointSizeF(max(font.pointSizeF() * 0.88, 7.0))
    return font


def bold(font: QFont, on: bool = True) -> QFont:
    """Return a copy of `font` that is bold, or not."""
    font = QFont(font)
    font.setBold(on)
    return font


def labelled(text: str, widget: QWidget) -> QLabel:
    """Return a label of `widget`, whose mnemonic moves the focus there."""
    label = QLabel(text)
    label.setBuddy(widget)
    return label


def set_help(widget: QWidget, name: str, help: str) -> None:
    """Set the accessible name of `widget`, and its help, which is its tooltip and its text for Shift+F1.

    Unchanged texts are not set again, because Qt would notify assistive software each time.
    """
    if widget.accessibleName() != name:
        widget.setAccessibleName(name)
    if widget.accessibleDescription() != help:
        widget.setAccessibleDescription(help)
    # Qt wraps long tooltips only if they are rich text.
    tip = f"<qt>{help}</qt>" if help else ""
    if widget.toolTip() != tip:
        widget.setToolTip(tip)
    if widget.whatsThis() != tip:
        widget.setWhatsThis(tip)


def check_box(text: str, help: str, on: bool = False) -> QCheckBox:
    """Return a check box with help."""
    box = QCheckBox(text)
    box.setChecked(on)
    set_help(box, text, help)
    return box


def push_button(text: str, help: str, icon_name: str = "", name: str = "") -> QPushButton:
    """Return a button with help, an icon unless its name is "", and an accessible name, by default its text."""
    button = QPushButton(text)
    if icon_name:
        button.setIcon(icon(icon_name))
    set_help(button, name or text.removesuffix("…"), help)
    return button


def icon_button(icon_name: str, name: str, help: str) -> QPushButton:
    """Return a narrow button with an icon in place of its name."""
    button = push_button("", help, icon_name, name)
    button.setFixedWidth(34)
    return button


def tool_button(icon_name: str, role: Role = TEXT) -> QToolButton:
    """Return a flat button with an icon, which Tab reaches."""
    button = QToolButton()
    button.setIcon(icon(icon_name, role))
    button.setAutoRaise(True)
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return button


def cross_button() -> QToolButton:
    """Return a small button with a cross, which closes or removes something."""
    button = tool_button("close", MUTED)
    set_variant(button, "small")
    button.setIconSize(QSize(11, 11))
    button.setFixedSize(16, 16)
    return button


def narrow(button: QAbstractButton) -> None:
    """Give a button with a short text the width of that text; the style makes buttons at least 80 pixels wide."""
    button.ensurePolished()
    button.setFixedWidth(max(44, button.fontMetrics().horizontalAdvance(button.text()) + 26))


def small_label(text: str = "", colour: Role = MUTED, parent: QWidget | None = None) -> QLabel:
    """Return a small label that wraps and whose text can be selected."""
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


def show_text(label: QLabel, text: str) -> None:
    """Set the text of a label, which is hidden while it has none."""
    label.setText(text)
    label.setVisible(bool(text))


def tint(widget: QWidget, colour: Role) -> None:
    """Set the text colour of `widget`."""
    listening = widget.property("tint") is not None
    widget.setProperty("tint", colour)
    if listening:
        _tint(widget)
    else:
        on_theme_change(widget, lambda: _tint(widget))


def _tint(widget: QWidget) -> None:
    colours = QPalette()
    colours.setColor(_ROLE.WindowText, QColor(str(widget.property("tint"))))
    widget.setPalette(colours)
