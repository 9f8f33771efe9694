"""Colours of the program by purpose, in the light and in the dark theme.

Code must not store colours: evaluate them when painting (`str(TEXT)`), or set them again when the theme changes (see
`hexmend_app.theme.style.on_theme_change`).
"""

from __future__ import annotations

from dataclasses import dataclass


def rgb(colour: str) -> tuple[float, float, float]:
    """Return red, green and blue of a colour #rrggbb from 0 to 1, as used by VTK."""
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255, green / 255, blue / 255


@dataclass
class Theme:
    """Current theme."""

    dark: bool = False


#: Theme of the program, set by `hexmend_app.theme.style.apply_style`.
THEME = Theme()


@dataclass(frozen=True, eq=False)
class Role:
    """Purpose of a colour; `str(role)` is its colour in the current theme.

    Parameters
    ----------
    light, dark : str
        Colour in the light and in the dark theme, #rrggbb.
    on : tuple of Role
        For texts: backgrounds on which the contrast is at least 4.5.
    """

    light: str
    dark: str
    on: tuple[Role, ...] = ()

    def of(self, dark: bool) -> str:
        """Return the colour in the dark or in the light theme."""
        return self.dark if dark else self.light

    def __str__(self) -> str:
        return self.of(THEME.dark)


# Backgrounds
PANEL = Role("#f7f8fa", "#21262d")
FIELD = Role("#ffffff", "#181c22")
STRIPE = Role("#f1f3f6", "#1d2128")  # every other row of a list
BUTTON = Role("#f1f3f6", "#2c323b")
HOVER = Role("#e9ecf1", "#333a44")
PRESSED = Role("#dde2e9", "#3b434e")
WRONG = Role("#fdeee5", "#3d261a")  # an invalid value or an error
WARNED = Role("#fff6dc", "#372e17")
INFO = Role("#e8f2f9", "#1c3040")
CHOSEN = Role("#d5e7f3", "#1e4563")
ACCENT = Role("#0072b2", "#1b6fa8")  # the main button of a panel
SELECTION = Role("#00639b", "#1b6fa8")  # selected rows and letters; Fusion tints the text of the row with the focus
ACCENT_HOVER = Role("#0a7abb", "#2478b2")
ACCENT_PRESSED = Role("#005a8e", "#155a8a")
INACTIVE = Role("#e6e9ee", "#2a3038")  # a disabled button

# Texts
_NEUTRAL = (PANEL, FIELD, STRIPE, BUTTON)
TEXT = Role("#1f2630", "#e3e7ed", on=(*_NEUTRAL, HOVER, PRESSED, WRONG, WARNED, INFO))
MUTED = Role("#56606d", "#a7b0bc", on=_NEUTRAL)
ON_ACCENT = Role("#ffffff", "#ffffff", on=(ACCENT, SELECTION, ACCENT_HOVER, ACCENT_PRESSED))
ON_CHOSEN = Role("#003f66", "#d3e9fb", on=(CHOSEN,))
FAINT = Role("#79828e", "#828d9a")  # disabled texts: a contrast of at least 3 suffices

# Colours of Okabe and Ito, which can be distinguished with all kinds of colour vision; BETTER and WORSE are bluish
# green and vermilion, darkened or lightened to be legible.
BLUE = Role("#0072b2", "#6cb9f0", on=(*_NEUTRAL, INFO))
BETTER = Role("#00745a", "#45c4a0", on=_NEUTRAL)
WORSE = Role("#b34400", "#ff9d63", on=(*_NEUTRAL, WRONG))
AMBER = Role("#8a5a00", "#e6b450", on=(*_NEUTRAL, WARNED))
INVERTED_TEXT = Role("#b80f6c", "#ff85c6", on=_NEUTRAL)

#: Colours of inverted hexes in the view, and of those that are invalid inside, in both themes; no colour map contains
#: them. They differ in lightness, which all kinds of colour vision see.
INVERTED, INVALID_INSIDE = "#e6198a", "#ff99e0"

# Lines and areas
LINE = Role("#c3c9d2", "#434b57")
OUTLINE = Role("#858e9a", "#737e8b")  # frames of controls that take a value
ACCENT_LINE = Role("#0072b2", "#6cb9f0")  # frames of focused controls, and the line under the tab in front
TRACK = Role("#b4bbc6", "#4d5663")  # grooves of sliders, and handles of scroll bars
GREY = Role("#8f98a3", "#8f98a3")
RIM = Role("#11151c", "#8b95a3")  # around swatches

# The 3D view
BACKGROUND = Role("#eef1f5", "#323943")
BACKGROUND_BELOW = Role("#e3e8ef", "#2a3039")  # ends of the gradient, whose middle is BACKGROUND
BACKGROUND_ABOVE = Role("#f9fafb", "#3a424d")
AXES = Role("#39414d", "#d5dae1", on=(BACKGROUND, BACKGROUND_BELOW, BACKGROUND_ABOVE))
GHOST = Role("#6f7b8b", "#aab4c1")
ORIGINAL = Role("#0072b2", "#6cb9f0")  # boundary of the mesh as opened
TARGET = Role("#e69f00", "#f0b53c")  # surface of a file on which the boundary slides
INTERFACE = Role("#aa4499", "#e07fd0")  # faces between materials
SHARP = Role("#1b1f2a", "#0c0e13")
SILHOUETTE = Role("#7d8797", "#8d97a5")
SHADE = Role("#d9dfe8", "#3e4651")  # slightly different from the background
PLANE_EDGE = Role("#4d5c73", "#b4c0d0")
PLANE = Role("#5c7394", "#9fb2cc")
PLANE_ACTIVE = Role("#0072b2", "#6cb9f0")

# Node steps, in the view, in the plot and in its legend: colours of Okabe and Ito too
DESCENT = Role("#e69f00", "#f0b53c")
SEARCH = Role("#3d9bd8", "#6cb9f0")
TAKEN = Role("#00b883", "#2ee6ac")
TRIED = Role("#d55e00", "#ff8a4a")
PATCH = Role("#ffffff", "#ffffff")
OTHERWISE = Role("#9a80f0", "#b3a0ff")  # the patch after or before the step

#: Colours of snapshots, by slot: those of Okabe and Ito except blue, which is for the current mesh, and yellow, which
#: is too pale for lines.
KEPT = (
    Role("#d55e00", "#d55e00"),
    Role("#009e73", "#009e73"),
    Role("#e69f00", "#e69f00"),
    Role("#56b4e9", "#56b4e9"),
    Role("#000000", "#ffffff"),
    Role("#cc79a7", "#cc79a7"),
)

#: Colours of runs in charts, by slot modulo their number.
RUN_COLOURS = (BLUE, *KEPT)
