"""Label in the status bar with the numbers of hexes, invalid and isolated hexes, and the selected hex."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session


class HexCounts(ElidingLabel):
    """Label with counts of the open mesh."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName(tr("Counts"))
        self.setContentsMargins(8, 0, 8, 0)

    def refresh(self, session: Session) -> None:
        """Show the counts of the current mesh."""
        summary = session.document.now.summary
        text = _counts_text(summary.hexes, summary.invalid)
        self.setText("  ·  ".join(filter(None, (text, _isolated_text(session), _selected_text(session)))))
        self.setToolTip(self.text())


def _counts_text(hexes: int, invalid: int) -> str:
    """Return the number of hexes, and that of invalid ones if there are any.

    >>> _counts_text(4788, 0), _counts_text(4788, 5)
    ('4,788 hexes', '4,788 hexes, 5 invalid')
    """
    if invalid:
        return tr("{hexes:,} hexes, {invalid:,} invalid", hexes=hexes, invalid=invalid)
    return tr("{hexes:,} hexes", hexes=hexes)


def _isolated_text(session: Session) -> str:
    """Return the number of isolated hexes and the key that shows all hexes; "" if none are isolated."""
    isolation = session.view.look.show.isolate
    return "" if isolation is None else tr("{count:,} isolated (Esc)", count=len(isolation.hexes))


def _selected_text(session: Session) -> str:
    """Return the selected hex and its quality; "" if none is selected."""
    selected, now = session.selection.hex, session.document.now
    if selected is None:
        return ""
    if now.quality.inverted[selected]:
        return tr("hex {hex}: inverted", hex=selected)
    if now.quality.invalid[selected]:
        return tr("hex {hex}: invalid", hex=selected)
    return tr("hex {hex}: q {q:.3f}", hex=selected, q=now.quality.q[selected])
