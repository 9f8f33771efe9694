"""Counts in the status bar: hexes, inverted and isolated ones, and the selected hex."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QLabel, QWidget

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session


class Counts(QLabel):
    """Label with counts of the open mesh."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName("Counts")

    def refresh(self, session: Session) -> None:
        """Show the present mesh."""
        summary = session.document.now.summary
        inverted = f"{summary.inverted:,} inverted" if summary.inverted else "none inverted"
        self.setText(f"{summary.hexes:,} hexes, {inverted}{_isolated(session)}{_chosen(session)}")


def _isolated(session: Session) -> str:
    """Number of isolated hexes, and the key that shows all again."""
    isolation = session.view.look.isolation
    return "" if isolation is None else f"  ·  {len(isolation.hexes):,} isolated (Esc)"


def _chosen(session: Session) -> str:
    """The selected hex and its quality."""
    chosen, now = session.selection.hex, session.document.now
    if chosen is None:
        return ""
    state = "inverted" if now.figures.inverted[chosen] else f"q {now.figures.q[chosen]:.3f}"
    return f"  ·  hex {chosen:,}: {state}"
