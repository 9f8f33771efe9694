"""Panel of one hex: metrics, corners, nodes and neighbours."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QStackedLayout,
    QVBoxLayout,
    QWidget,
)
from superqt import QFlowLayout

from hexmend.quality import METRICS, Metric
from hexmend_app.state.mesh.inspection import HexDetails, NodeDetails
from hexmend_app.theme.palette import INVERTED_TEXT, MUTED, TEXT, WORSE
from hexmend_app.theme.spacing import fill, on_grid
from hexmend_app.theme.style import bold, icon, note, set_help, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.metric_texts import described, metrics_offered, value_text
from hexmend_app.widgets.wording import counted, figure

_FACES = ("x−", "x+", "y−", "y+", "z−", "z+")
_HINT = "Click a hex in the view, or press N for the worst hex, to see its metrics, nodes, corners and neighbours."

#: Columns of metrics; a narrow panel shows them one below the other.
_METRIC_COLUMNS = 3

#: Width of the column with the wrapped texts, in pixels.
_TEXT_WIDTH = 270


class HexPanel(QWidget):
    """Shows the metrics, corners, nodes and neighbours of a hex.

    Signals
    -------
    node_chosen(int)
        The user selected this node of the hex.
    pin_toggled(int, bool)
        The user pinned or unpinned this node.
    """

    node_chosen = Signal(int)
    pin_toggled = Signal(int, bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._stack = QStackedLayout(self)
        hint = note(tr(_HINT))
        hint.setAlignment(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop)
        hint.setMargin(24)
        self._stack.addWidget(hint)
        page = QWidget()
        self._stack.addWidget(page)
        self._title = QLabel()
        self._title.setFont(bold(self._title.font()))
        self._title.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._state = QLabel()
        tint(self._state, INVERTED_TEXT)
        self.corners_box = QCheckBox(tr("Corner qualities in the view"))
        set_help(
            self.corners_box, tr("Corner qualities in the view"), tr("Show q(T) at the corners of the hex in the view.")
        )
        self.zoom_button = QPushButton(icon("target"), tr("Zoom to hex"))
        set_help(
            self.zoom_button,
            tr("Zoom to hex"),
            tr("Move the camera to the hex; Enter or a double-click in the list of the worst does the same."),
        )
        self._values = {name: self._number() for name in METRICS}
        self._corners = [(LinkLabel(), self._number(), self._number()) for _ in range(8)]
        self.neighbours = LinkLabel()
        set_help(self.neighbours, tr("Neighbours"), tr("The hexes across the six faces; click one to select it."))
        self._about_node = QLabel()
        self._about_node.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        set_help(
            self._about_node,
            tr("Node"),
            tr(
                "The energy is the sum of η(H)² over the hexes of the node (3.3). The arrow in the view is the "
                "direction of steepest descent; the gradient is given per mean edge length."
            ),
        )
        self._pin = QCheckBox(tr("Pinned"))
        set_help(self._pin, tr("Pinned"), tr("Keep this node in place in every method, also on a sliding boundary."))
        self._pin.clicked.connect(lambda on: self.pin_toggled.emit(self._node.number, on))
        self._node: NodeDetails | None = None
        for corner, (node, _, _) in enumerate(self._corners):
            node.setAccessibleName(tr("Node at corner {corner}", corner=corner))
            _align_digits(node)
            node.followed.connect(self.node_chosen)
        self._lay_out(page)

    def _number(self) -> QLabel:
        label = QLabel()
        _align_digits(label)
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        return label

    def _lay_out(self, page: QWidget) -> None:
        head = fill(QHBoxLayout(), (self._title, 1), self.zoom_button)
        metrics = metrics_offered()
        rows = -(-len(metrics) // _METRIC_COLUMNS)
        values = [self._metric_grid(metrics[first : first + rows]) for first in range(0, len(metrics), rows)]
        corners = QGridLayout()
        corners.setVerticalSpacing(4)
        corners.setHorizontalSpacing(16)
        for column, text in enumerate((tr("Node"), "", "q(T)")):
            title = QLabel(text)
            title.setAlignment(Qt.AlignmentFlag.AlignRight)
            tint(title, MUTED)
            corners.addWidget(title, 0, column)
        for row, labels in enumerate(self._corners, start=1):
            for column, label in enumerate(labels):
                corners.addWidget(label, row, column)
        for label in (self._state, self.neighbours, self._about_node):
            label.setWordWrap(True)
        texts = fill(QVBoxLayout(), head, self._state, self.corners_box, self.neighbours, self._about_node, self._pin)
        columns = QFlowLayout(page)
        columns.setContentsMargins(8, 8, 8, 8)
        columns.setHorizontalSpacing(20)
        columns.setVerticalSpacing(8)
        for layout in (texts, corners, *values):
            layout.setContentsMargins(0, 0, 0, 0)
            part = QWidget()
            part.setLayout(layout)
            columns.addWidget(part)
            if layout is texts:
                part.setFixedWidth(_TEXT_WIDTH)

    def _metric_grid(self, metrics: Sequence[Metric]) -> QGridLayout:
        """Lay out titles and values of metrics, one below the other."""
        grid = on_grid(QGridLayout())
        grid.setVerticalSpacing(4)
        for row, metric in enumerate(metrics):
            title = QLabel(tr(metric.title))
            set_help(title, tr(metric.title), described(metric).removeprefix("<qt>").removesuffix("</qt>"))
            grid.addWidget(title, row, 0)
            grid.addWidget(self._values[metric.name], row, 1)
        return grid

    def show_hex(self, details: HexDetails | None, tags: Sequence[str] = ()) -> None:
        """Show a hex and its tags; for None, the hint how to select a hex."""
        self._stack.setCurrentIndex(0 if details is None else 1)
        if details is None:
            return
        self._title.setText(tr("Hex {number}", number=details.number) + (f": {', '.join(tags)}" if tags else ""))
        self._state.setText(_state_text(details))
        for name, label in self._values.items():
            value = details.values[name]
            label.setText("∞" if value == np.inf else value_text(METRICS[name], value))
            tint(label, WORSE if METRICS[name].unacceptable(np.array(value)) else TEXT)
        worst = int(details.corners.argmin()) if np.ptp(details.corners) > 1e-9 else -1
        for k, (node, kind, quality) in enumerate(self._corners):
            node.setText(f'&#8203;<a href="{details.nodes[k]}">{details.nodes[k]}</a>')
            kind.setText(tr("fixed") if details.fixed[k] else tr("free"))
            tint(kind, MUTED)
            quality.setText(figure(float(details.corners[k]), 3))
            tint(quality, WORSE if details.corners[k] == 0 or k == worst else TEXT)
        links = (
            f'{face}:&nbsp;<a href="{h}">{h}</a>' if h >= 0 else f"{face}:&nbsp;{tr('boundary')}"
            for face, h in zip(_FACES, details.neighbours.tolist(), strict=True)
        )
        of_file = "" if details.file_id is None else tr("Number in the file: {id}", id=details.file_id) + "<br>"
        self.neighbours.setText(of_file + tr("Neighbours: {links}", links=" &nbsp;&nbsp;".join(links)))

    def show_node(self, details: NodeDetails | None, busy: bool = False, boundary_class: str = "") -> None:
        """Show a node of the hex; for None, a hint how to select a node.

        Parameters
        ----------
        details : NodeDetails, optional
        busy : bool
            True while the mesh cannot be edited, so that the node cannot be pinned.
        boundary_class : str
            Class of a boundary node, such as "on a curve"; "" if unknown.
        """
        self._node = details
        self._pin.setVisible(details is not None)
        if details is None:
            self._about_node.setText(tr("Click near a corner or on a node number to select a node."))
            return
        kind = f"{details.kind}, pinned" if details.pinned and details.kind == "boundary" else details.kind
        name = tr("Node {number}", number=details.number)
        if details.file_id is not None:
            name = tr("{name} ({id} in the file)", name=name, id=details.file_id)
        parts = [
            f"{name}: {kind}",
            boundary_class,
            counted(details.ring.size, "hex"),
        ]
        if np.isfinite(details.energy):
            gradient = float(np.linalg.norm(details.downhill))
            parts.append(
                tr("energy {energy}, gradient {gradient}", energy=figure(details.energy), gradient=figure(gradient))
            )
        else:
            parts.append(tr("infinite energy (inverted hex)"))
        self._about_node.setText(", ".join(filter(None, parts)))
        self._pin.setChecked(details.pinned)
        self._pin.setEnabled(details.kind != "unused" and not busy)


def _state_text(details: HexDetails) -> str:
    """Return what makes a hex invalid, and how negative its Jacobian is; "" for a valid hex."""
    if not details.invalid:
        return ""
    state = tr("inverted") if details.inverted else tr("invalid inside")
    if details.locked:
        state = tr("inverted, locked by its fixed nodes")
    return tr("{state}; det J min / max {least}", state=state, least=figure(details.least_jacobian))


def _align_digits(label: QLabel) -> None:
    """Right-align a label, with digits of equal width."""
    label.setFont(tabular(label.font()))
    label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
