"""The program's colours by what they are for, in the light theme and in the dark one.

A colour is never kept: who paints asks for it then (`str(TEXT)`), and who has to hand one over does so again when the
widgets are dressed anew (`hexmend_app.theme.style.dress`).
"""

from __future__ import annotations

from dataclasses import dataclass


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green and blue of #rrggbb, each from 0 to 1, as VTK takes them."""
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255, green / 255, blue / 255


@dataclass
class Theme:
    """Current theme."""

    dark: bool = False


#: The one that the program wears; `hexmend_app.theme.style` changes it and tells of it.
THEME = Theme()


@dataclass(frozen=True, eq=False)
class Role:
    """Purpose of a colour; as text, the colour of the current theme.

    Parameters
    ----------
    light, dark : str
        The colour in either theme, #rrggbb.
    on : tuple of Role
        For a text, the grounds that it is read on, with a contrast of 4.5 at least.
    """

    light: str
    dark: str
    on: tuple[Role, ...] = ()

    def of(self, dark: bool) -> str:
        """The colour in one of the themes."""
        return self.dark if dark else self.light

    def __str__(self) -> str:
        return self.of(THEME.dark)


# Grounds
PANEL = Role("#f7f8fa", "#21262d")
FIELD = Role("#ffffff", "#181c22")
STRIPE = Role("#f1f3f6", "#1d2128")  # every other row of a list
BUTTON = Role("#f1f3f6", "#2c323b")
HOVER = Role("#e9ecf1", "#333a44")
WRONG = Role("#fdeee5", "#3d261a")  # a value that is not admitted, an error
WARNED = Role("#fff6dc", "#372e17")
INFO = Role("#e8f2f9", "#1c3040")
CHOSEN = Role("#d5e7f3", "#1e4563")
ACCENT = Role("#0072b2", "#1b6fa8")  # what is selected, and the one button that a panel is for
ACCENT_HOVER = Role("#0a7abb", "#2478b2")
ACCENT_PRESSED = Role("#005a8e", "#155a8a")
INACTIVE = Role("#e6e9ee", "#2a3038")  # a button that cannot be pressed

# Texts
_NEUTRAL = (PANEL, FIELD, STRIPE, BUTTON)
TEXT = Role("#1f2630", "#e3e7ed", on=(*_NEUTRAL, HOVER, WRONG, WARNED, INFO))
MUTED = Role("#56606d", "#a7b0bc", on=_NEUTRAL)
ON_ACCENT = Role("#ffffff", "#ffffff", on=(ACCENT, ACCENT_HOVER, ACCENT_PRESSED))
ON_CHOSEN = Role("#003f66", "#d3e9fb", on=(CHOSEN,))
FAINT = Role("#a3abb6", "#69737f")  # what is disabled

# Okabe and Ito's colours, which all kinds of colour vision tell apart; BETTER and WORSE are their bluish green and
# vermilion, darkened or lightened until they can be read.
BLUE = Role("#0072b2", "#6cb9f0", on=(*_NEUTRAL, INFO))
BETTER = Role("#00745a", "#45c4a0", on=_NEUTRAL)
WORSE = Role("#b34400", "#ff9d63", on=(*_NEUTRAL, WRONG))
AMBER = Role("#8a5a00", "#e6b450", on=(*_NEUTRAL, WARNED))
INVERTED_TEXT = Role("#b80f6c", "#ff85c6", on=_NEUTRAL)

#: What inverted hexes have in the view, whatever the theme: in no map of ours.
INVERTED = "#e6198a"

# Lines and areas
FRAME = Role("#f7f8fa", "#8b95a3")  # Fusion frames what can be pressed or typed in by a darker shade of this
GLEAM = Role("#ffffff", "#39404a")  # the bright side of Fusion's grooves, and what is between it and the panel
SHEEN = Role("#f4f5f7", "#2e343d")
SHADOW = Role("#9a9da3", "#14171c")
LINE = Role("#c3c9d2", "#434b57")
GREY = Role("#8f98a3", "#8f98a3")
RIM = Role("#11151c", "#8b95a3")  # of what shows a colour of the view

# The 3D view
BACKGROUND = Role("#eef1f5", "#323943")  # one colour: a gradient costs software rendering a fifth of the frame
AXES = Role("#39414d", "#d5dae1", on=(BACKGROUND,))
GHOST = Role("#6f7b8b", "#aab4c1")
ORIGINAL = Role("#0072b2", "#6cb9f0")  # the boundary as it was opened
OTHER_CELLS = Role("#5f6670", "#b9bfc8")  # tetrahedra and the like beside the hexes
SHARP = Role("#1b1f2a", "#0c0e13")
SILHOUETTE = Role("#7d8797", "#8d97a5")
SHADE = Role("#d9dfe8", "#3e4651")  # a little apart from the background
PLANE_EDGE = Role("#4d5c73", "#b4c0d0")
PLANE = Role("#5c7394", "#9fb2cc")
PLANE_HELD = Role("#0072b2", "#6cb9f0")

# A node's step, in the view, in its plot and in its legend: Okabe and Ito's colours too
UPHILL = Role("#e69f00", "#f0b53c")
SEARCH = Role("#3d9bd8", "#6cb9f0")
TAKEN = Role("#00b883", "#2ee6ac")
TRIED = Role("#d55e00", "#ff8a4a")
PATCH = Role("#ffffff", "#ffffff")
OTHERWISE = Role("#9a80f0", "#b3a0ff")  # where the patch would be, or was

#: Colours of what is kept, by slot: Okabe and Ito's without the blue of what is now, and without their yellow, which is
#: too pale for a line.
KEPT = (
    Role("#d55e00", "#d55e00"),
    Role("#009e73", "#009e73"),
    Role("#e69f00", "#e69f00"),
    Role("#56b4e9", "#56b4e9"),
    Role("#000000", "#ffffff"),
    Role("#cc79a7", "#cc79a7"),
)
