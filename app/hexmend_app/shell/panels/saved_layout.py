"""Arrangement of panels as stored in the settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import QByteArray

from hexmend_app.feature import PanelGroup

#: Version of the saved arrangement; one of another version is ignored.
LAYOUT = 1

_MINIMUM_DRAWER = 60


@dataclass(frozen=True)
class SavedLayout:
    """Saved arrangement.

    Parameters
    ----------
    docks : QByteArray
        State of the main window.
    closed : tuple of str
        Ids of closed panels.
    fronts : tuple of str
        Titles of the docks in front.
    folded, hidden : bool
        The drawer is closed; all panels are hidden.
    group : PanelGroup
        Of the docks in the drawer.
    shares : (float, float) or None
        Shares of tools and of figures in the height of the window; None for the default.
    drawer, column : int
        Height of the drawer and width of the right column in pixels; 0 for the default width.
    """

    docks: QByteArray
    closed: tuple[str, ...]
    fronts: tuple[str, ...]
    folded: bool
    hidden: bool
    group: PanelGroup
    shares: tuple[float, float] | None
    drawer: int
    column: int

    @classmethod
    def read(cls, data: Mapping[str, object]) -> SavedLayout | None:
        """Read the stored value; return None if it is of another version or invalid."""
        if data.get("layout") != LAYOUT:
            return None
        try:
            return cls(
                docks=QByteArray(data["state"]),
                closed=tuple(map(str, data["closed"])),
                fronts=tuple(map(str, data["fronts"])),
                folded=bool(data["folded"]),
                hidden=bool(data["hidden"]),
                group=PanelGroup(data["group"]),
                shares=_shares(data["shares"]),
                drawer=max(int(data["drawer"]), _MINIMUM_DRAWER),
                column=int(data["column"]),
            )
        except (KeyError, TypeError, ValueError):
            return None


def _shares(data: object) -> tuple[float, float] | None:
    if data is None:
        return None
    tools, figures = (min(max(float(share), 0.05), 0.9) for share in data)
    return tools, figures
