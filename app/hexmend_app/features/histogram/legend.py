"""Legend of the histogram, in which snapshots can be renamed and removed."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget
from superqt import QFlowLayout

from hexmend_app.theme.palette import BLUE, GREY, KEPT, MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import cross_button, set_help, set_variant, smaller, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.legend import Swatch, legend_entry

_MAX_NAME_WIDTH, _HEIGHT = 150, 18


class HistogramLegend(QWidget):
    """Title of the axis and names of the distributions, in one or more rows.

    Signals
    -------
    renamed(slot, name)
        The user renamed a snapshot.
    removed(slot)
        The user removed a snapshot.
    """

    renamed = Signal(int, str)
    removed = Signal(int)

    def __init__(self, help: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._flow = QFlowLayout(self)
        self._flow.setContentsMargins(0, 0, 0, 0)
        self._flow.setHorizontalSpacing(4)
        self._flow.setVerticalSpacing(0)
        self.entries: dict[int, SnapshotEntry] = {}
        self._title = ElidingLabel()
        self._title.setFont(smaller(self._title.font()))
        tint(self._title, MUTED)
        self._title.setSizePolicy(self.sizePolicy())
        self._title.setMinimumHeight(_HEIGHT)
        self._title.setContentsMargins(0, 0, 8, 0)
        set_help(self._title, tr("Axis of values"), help)
        self._flow.addWidget(self._title)
        for text, colour in ((tr("at the start"), GREY), (tr("now"), BLUE)):
            entry = legend_entry(text, colour)
            set_help(entry, text, help)
            entry.setMinimumHeight(_HEIGHT)  # aligns it with the entries of snapshots
            self._flow.addWidget(entry)

    def set_title(self, title: str) -> None:
        """Set the title of the axis of values."""
        self._title.setText(title)

    def size_within(self, width: int) -> QSize:
        """Return the size for a maximum width: one row if it fits, or more rows."""
        self._title.setMaximumWidth(max(width, 1))  # shortened in a narrow plot
        widths = [self._flow.itemAt(index).sizeHint().width() for index in range(self._flow.count())]
        width = min(sum(widths) + (len(widths) - 1) * self._flow.horizontalSpacing() + 1, max(width, 1))
        return QSize(width, self._flow.heightForWidth(width))

    def set_snapshots(self, snapshots: Sequence[tuple[int, str]]) -> None:
        """Show snapshots by slot and name."""
        for slot in self.entries.keys() - {slot for slot, _ in snapshots}:
            entry = self.entries.pop(slot)
            self._flow.removeWidget(entry)
            entry.hide()
            entry.deleteLater()  # not now: the signal may come from its own button
        for slot, name in snapshots:
            if slot not in self.entries:
                entry = self.entries[slot] = SnapshotEntry(slot)
                entry.name.renamed.connect(lambda name, slot=slot: self.renamed.emit(slot, name))
                entry.cross.clicked.connect(lambda _=False, slot=slot: self.removed.emit(slot))
                self._flow.addWidget(entry)
            self.entries[slot].name.show_name(name)
            set_help(
                self.entries[slot].cross,
                tr("Remove {name}", name=name),
                tr("Remove {name} from the histogram.", name=name),
            )
        self.updateGeometry()


class SnapshotEntry(QWidget):
    """Colour, editable name and remove button of a snapshot."""

    def __init__(self, slot: int):
        super().__init__()
        self.name = _Name()
        self.cross = cross_button()
        self.setFixedHeight(max(_HEIGHT, self.fontMetrics().height()))
        fill(QHBoxLayout(self), Swatch(KEPT[slot]), self.name, self.cross, margins=(0, 0, 4, 0), spacing=4)


class _Name(QLineEdit):
    """Editable name as wide as its text, up to a limit; Return or the loss of focus ends editing."""

    renamed = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self._name = ""
        set_variant(self, "name")
        self.setFont(smaller(self.font()))
        self.setTextMargins(0, 0, 0, 0)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.textChanged.connect(self._fit)
        self.returnPressed.connect(self.clearFocus)

    def show_name(self, name: str) -> None:
        """Show a name without emitting a signal."""
        self._name = name
        self.setText(name)
        self.setCursorPosition(0)
        set_help(self, tr("Name of {name}", name=name), tr("Distribution of {name}; click to rename it.", name=name))

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Announce a new name; an empty one is ignored."""
        super().focusOutEvent(event)
        name = self.text().strip()
        if name and name != self._name:
            self.renamed.emit(name)
        self.setText(self._name)
        self.setCursorPosition(0)
        self.deselect()

    def _fit(self) -> None:
        self.ensurePolished()
        width = self.fontMetrics().horizontalAdvance(self.text())
        self.setFixedWidth(min(max(width, 24) + 8, _MAX_NAME_WIDTH))
        self.updateGeometry()
