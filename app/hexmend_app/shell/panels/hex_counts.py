"""Label in the status bar with the numbers of hexes, invalid and isolated hexes, and the selected hex."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from hexmend_app.state.mesh.inspection import kind_name
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.wording import counted_cells, noun_of

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
        text = counted_cells(summary)
        if summary.invalid:
            text = tr("{hexes}, {invalid:,} invalid", hexes=text, invalid=summary.invalid)
        self.setText("  ·  ".join(filter(None, (text, _isolated_text(session), _selected_text(session)))))
        self.setToolTip(self.text())


def _isolated_text(session: Session) -> str:
    """Return the number of isolated hexes and the key that shows all hexes; "" if none are isolated."""
    isolation = session.view.look.show.isolate
    return "" if isolation is None else tr("{count:,} isolated (Esc)", count=len(isolation.hexes))


def _selected_text(session: Session) -> str:
    """Return the selected hex and its quality; "" if none is selected."""
    selected, now = session.selection.hex, session.document.now
    if selected is None:
        return ""
    quality, kind = now.quality, tr(noun_of(kind_name(now.mesh, selected)))
    state = tr("inverted") if quality.inverted[selected] else tr("invalid") if quality.invalid[selected] else ""
    return f"{kind} {selected}: {state or f'q {quality.q[selected]:.3f}'}"
