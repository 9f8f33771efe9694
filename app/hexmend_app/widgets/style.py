"""The viewer's colours, fonts and icons: one place, so that all widgets look like one program."""

from __future__ import annotations

import qtawesome
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont, QIcon, QPalette
from PySide6.QtWidgets import QApplication, QLabel, QSizePolicy, QWidget

from hexmend_app.scene.colours import INVERTED as SCENE_INVERTED

TEXT = "#1f2630"
MUTED = "#56606d"
FAINT = "#a3abb6"
LINE = "#c3c9d2"
PANEL = "#f7f8fa"
FIELD = "#ffffff"

# Okabe and Ito's colours, which all kinds of colour vision tell apart; BETTER and WORSE are their bluish green and
# vermilion, darkened until text in them has a contrast of 5:1 on the panel.
BLUE = "#0072b2"
GREY = "#8f98a3"
BETTER = "#00745a"
WORSE = "#b34400"
AMBER = "#8a5a00"
# The colour that inverted elements have in the view, and a darker one for texts about them.
INVERTED = QColor(*SCENE_INVERTED).name()
INVERTED_TEXT = "#b80f6c"


def apply_light_style(app: QApplication) -> None:
    """Give the program the light Fusion look, whatever the desktop's theme."""
    app.setStyle("Fusion")
    palette = QPalette()
    for role, colour in (
        (QPalette.ColorRole.Window, PANEL),
        (QPalette.ColorRole.WindowText, TEXT),
        (QPalette.ColorRole.Base, FIELD),
        (QPalette.ColorRole.AlternateBase, "#f1f3f6"),
        (QPalette.ColorRole.Text, TEXT),
        (QPalette.ColorRole.Button, "#f1f3f6"),
        (QPalette.ColorRole.ButtonText, TEXT),
        (QPalette.ColorRole.ToolTipBase, FIELD),
        (QPalette.ColorRole.ToolTipText, TEXT),
        (QPalette.ColorRole.PlaceholderText, MUTED),
        (QPalette.ColorRole.Highlight, BLUE),
        (QPalette.ColorRole.HighlightedText, FIELD),
        (QPalette.ColorRole.Accent, BLUE),
        (QPalette.ColorRole.Link, BLUE),
    ):
        palette.setColor(role, QColor(colour))
    for role in (QPalette.ColorRole.WindowText, QPalette.ColorRole.Text, QPalette.ColorRole.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(FAINT))
    app.setPalette(palette)


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


def icon(name: str, colour: str = TEXT) -> QIcon:
    """A Material Design icon by name, sharp at every scale."""
    return qtawesome.icon(f"mdi6.{name}", color=colour, color_disabled=FAINT)


def explain(widget: QWidget, name: str, help: str) -> None:
    """Give `widget` its accessible name, and one sentence of help as tooltip and for Shift+F1."""
    widget.setAccessibleName(name)
    widget.setAccessibleDescription(help)
    # The tag makes Qt wrap long plain tooltips.
    tip = f"<qt>{help}</qt>" if help else ""
    widget.setToolTip(tip)
    widget.setWhatsThis(tip)


def note(text: str = "", colour: str = MUTED, parent: QWidget | None = None) -> QLabel:
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


def tint(widget: QWidget, colour: str) -> None:
    """Colour the text of `widget`."""
    palette = widget.palette()
    palette.setColor(QPalette.ColorRole.WindowText, QColor(colour))
    widget.setPalette(palette)
