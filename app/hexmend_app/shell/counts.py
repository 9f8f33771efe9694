"""The line beside the drawer's tabs: how many hexes there are, are inverted, are shown alone, and which is chosen."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QLabel, QWidget

if TYPE_CHECKING:
    from hexmend_app.state.session import Session


class Counts(QLabel):
    """Says it in short, wherever the panels are."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName("Counts")

    def refresh(self, session: Session) -> None:
        """Show the mesh that is open as it is now."""
        summary = session.document.now.summary
        inverted = f"{summary.inverted:,} inverted" if summary.inverted else "none inverted"
        self.setText(f"{summary.hexes:,} hexes, {inverted}{_isolated(session)}{_chosen(session)}")


def _isolated(session: Session) -> str:
    """That only a part is shown, and what brings back the rest."""
    isolation = session.view.look.isolation
    return "" if isolation is None else f"  ·  {len(isolation.hexes):,} isolated (Esc)"


def _chosen(session: Session) -> str:
    """The hex that is chosen, in short."""
    chosen, now = session.selection.hex, session.document.now
    if chosen is None:
        return ""
    state = "inverted" if now.figures.inverted[chosen] else f"q {now.figures.q[chosen]:.3f}"
    return f"  ·  hex {chosen:,}: {state}"
