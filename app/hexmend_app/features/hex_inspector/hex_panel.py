"""Panel of one hex: metrics, corners, nodes and neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QStackedLayout, QVBoxLayout, QWidget
from superqt import QFlowLayout

from hexmend.quality import Metric
from hexmend_app.state.mesh.inspection import HexDetails, NodeDetails
from hexmend_app.theme.palette import INVERTED_TEXT, MUTED, TEXT, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, check_box, on_theme_change, push_button, set_help, small_label, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.metric_texts import described, metrics_offered, value_text
from hexmend_app.widgets.wording import counted, figure, noun_of

#: Names of the faces of hexes; those of other cells are numbered.
_FACES = {"hexahedron": ("x−", "x+", "y−", "y+", "z−", "z+")}
_HINT = "Click a hex in the view, or press N for the worst hex, to see its metrics, nodes, corners and neighbours."
_NODE_HELP = (
    "The energy is the sum of η(H)² over the hexes of the node (3.3). The arrow in the view is the direction of "
    "steepest descent; the gradient is given per mean edge length."
)

#: Cells of a table: HTML with its colour.
_Row = Sequence[tuple[str, Role]]

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
        self._details: HexDetails | None = None
        self._node: NodeDetails | None = None
        self._title, self._state, self._about_node = QLabel(), QLabel(), QLabel()
        self._title.setFont(bold(self._title.font()))
        tint(self._state, INVERTED_TEXT)
        text = tr("Show q(T) at the corners of the hex in the view.")
        self.corners_box = check_box(tr("Corner qualities in the view"), text)
        text = tr("Move the camera to the hex; Enter or a double-click in the list of the worst does the same.")
        self.zoom_button = push_button(tr("Zoom to hex"), text, "target")
        self.neighbours, self._corners = LinkLabel(), LinkLabel()
        set_help(self.neighbours, tr("Neighbours"), tr("The hexes across the six faces; click one to select it."))
        set_help(self._corners, tr("Corners"), tr("The nodes at the corners, and q(T) there; click one to select it."))
        self._corners.followed.connect(self.node_chosen)
        metrics = metrics_offered()
        rows = -(-len(metrics) // _METRIC_COLUMNS)
        self._metrics = [(metrics[first : first + rows], QLabel()) for first in range(0, len(metrics), rows)]
        set_help(self._about_node, tr("Node"), tr(_NODE_HELP))
        text = tr("Keep this node in place in every method, also on a sliding boundary.")
        self._pin = check_box(tr("Pinned"), text)
        self._pin.clicked.connect(self._on_pin)
        self._lay_out()
        on_theme_change(self, self._show_tables)

    def _lay_out(self) -> None:
        self._stack = QStackedLayout(self)
        hint, page, texts = small_label(tr(_HINT)), QWidget(), QWidget()
        hint.setAlignment(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop)
        hint.setMargin(24)
        self._stack.addWidget(hint)
        self._stack.addWidget(page)
        selectable = Qt.TextInteractionFlag.TextSelectableByMouse
        for label in (self._title, self._state, self._about_node):
            label.setTextInteractionFlags(selectable)
        for label in (self._state, self.neighbours, self._about_node):
            label.setWordWrap(True)
        for label in (self._corners, *(label for _, label in self._metrics)):
            label.setFont(tabular(label.font()))
            label.setTextFormat(Qt.TextFormat.RichText)
            label.setTextInteractionFlags(label.textInteractionFlags() | selectable)
        head = fill(QHBoxLayout(), (self._title, 1), self.zoom_button)
        parts = (head, self._state, self.corners_box, self.neighbours, self._about_node, self._pin)
        fill(QVBoxLayout(texts), *parts, margins=(0, 0, 0, 0))
        texts.setFixedWidth(_TEXT_WIDTH)
        columns = QFlowLayout(page)
        columns.setContentsMargins(8, 8, 8, 8)
        columns.setHorizontalSpacing(20)
        columns.setVerticalSpacing(8)
        for part in (texts, self._corners, *(label for _, label in self._metrics)):
            columns.addWidget(part)

    def show_hex(self, details: HexDetails | None, tags: Sequence[str] = ()) -> None:
        """Show a hex and its tags; for None, the hint how to select a hex."""
        self._details = details
        self._stack.setCurrentIndex(0 if details is None else 1)
        if details is None:
            return
        title = f"{tr(noun_of(details.kind)).capitalize()} {details.number}"
        self._title.setText(title + (f": {', '.join(tags)}" if tags else ""))
        self._state.setText(_state_text(details))
        self._show_tables()
        no_links = {-1: tr("boundary"), details.number: tr("two cells")}
        links = (
            f'{face}:&nbsp;<a href="{h}">{h}</a>' if h not in no_links else f"{face}:&nbsp;{no_links[h]}"
            for face, h in zip(_FACES.get(details.kind, "12345"), details.neighbours.tolist(), strict=False)
        )
        of_file = "" if details.file_id is None else tr("Number in the file: {id}", id=details.file_id) + "<br>"
        self.neighbours.setText(of_file + tr("Neighbours: {links}", links=" &nbsp;&nbsp;".join(links)))

    def _on_pin(self, on: bool) -> None:
        if self._node is not None:
            self.pin_toggled.emit(self._node.number, on)

    def _show_tables(self) -> None:
        """Show the metrics and the corners, in the colours of the theme."""
        if self._details is None:
            return
        for metrics, label in self._metrics:
            label.setText(_table([_metric_row(metric, self._details.values[metric.name]) for metric in metrics]))
            label.setToolTip("<br>".join(described(metric) for metric in metrics))
        self._corners.setText(_table(_corner_rows(self._details)))

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
        energy = tr("infinite energy (inverted {hex})", hex=tr(details.noun))
        if np.isfinite(details.energy):
            values = {"energy": figure(details.energy), "gradient": figure(float(np.linalg.norm(details.downhill)))}
            energy = tr("energy {energy}, gradient {gradient}", **values)
        parts = (f"{name}: {kind}", boundary_class, counted(details.ring.size, details.noun), energy)
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


def _metric_row(metric: Metric, value: float) -> _Row:
    text = "∞" if value == np.inf else value_text(metric, value)
    colour = WORSE if not np.isnan(value) and metric.unacceptable(np.array(value)) else TEXT
    return (escape(tr(metric.title)), TEXT), (text, colour)


def _corner_rows(details: HexDetails) -> list[_Row]:
    """Return the head of the table of corners, and for each corner a link to its node, its kind and its quality."""
    worst = int(np.nanargmin(details.corners)) if np.ptp(details.corners[~np.isnan(details.corners)]) > 1e-9 else -1
    rows: list[_Row] = [((f"&#8203;{tr('Node')}", MUTED), ("", MUTED), ("q(T)", MUTED))]
    for k, (node, fixed, quality) in enumerate(zip(details.nodes, details.fixed, details.corners, strict=True)):
        link, kind = f'<a href="{node}">{node}</a>', tr("fixed") if fixed else tr("free")
        colour = WORSE if quality == 0 or k == worst else TEXT
        rows.append(((link, TEXT), (kind, MUTED), (figure(float(quality), 3), colour)))
    return rows


def _table(rows: Sequence[_Row]) -> str:
    """Return rows of cells, HTML with a colour, as an HTML table; all but the first cell are right-aligned."""
    lines = ""
    for row in rows:
        cells = (
            f'<td align="{"right" if at else "left"}" style="color: {colour}; padding-right: 12px">{text}</td>'
            for at, (text, colour) in enumerate(row)
        )
        lines += f"<tr>{''.join(cells)}</tr>"
    return f'<table cellspacing="0" cellpadding="2">{lines}</table>'
