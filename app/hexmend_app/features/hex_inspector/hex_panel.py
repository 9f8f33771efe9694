"""Panel of one hex: metrics, corners, nodes and neighbours."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont
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

from hexmend.quality import METRICS, HexDetails, NodeDetails
from hexmend_app.theme.style import (
    INVERTED_TEXT,
    MUTED,
    TEXT,
    WORSE,
    icon,
    note,
    on_theme_change,
    set_help,
    tabular,
    tint,
)
from hexmend_app.widgets.metric_texts import described, metrics_offered
from hexmend_app.widgets.wording import counted, figure

_FACES = ("x−", "x+", "y−", "y+", "z−", "z+")
_HINT = (
    "Click a hex in the view, or choose one from the list of the worst (N). "
    "Here you will see its figures, its nodes, the quality at each corner, and its neighbours."
)

#: Pixels of what is said in words.
_WIDTH = 270


class ElementPanel(QWidget):
    """Shows the metrics, corners, nodes and neighbours of a hex.

    Signals
    -------
    chosen(int)
        The user wants to see this neighbour.
    fly_requested
        The user moves the camera to the hex.
    corners_toggled(bool)
        The user wants the corners' qualities in the view, or not.
    node_chosen(int)
        The user wants to see this node of the element.
    pin_toggled(int, bool)
        The user wants this node pinned, or free.
    """

    chosen = Signal(int)
    fly_requested = Signal()
    corners_toggled = Signal(bool)
    node_chosen = Signal(int)
    pin_toggled = Signal(int, bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._stack = QStackedLayout(self)
        hint = note(_HINT)
        hint.setAlignment(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop)
        hint.setMargin(24)
        self._stack.addWidget(hint)
        page = QWidget()
        self._stack.addWidget(page)
        self._title = QLabel()
        font = QFont(self._title.font())
        font.setBold(True)
        self._title.setFont(font)
        self._title.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._state = QLabel()
        tint(self._state, INVERTED_TEXT)
        self._in_view = QCheckBox("Corner qualities in the view")
        set_help(self._in_view, "Corner qualities in the view", "Show q(T) at the corners of the hex in the view.")
        self._in_view.toggled.connect(self.corners_toggled)
        self._fly = QPushButton(icon("target"), "Fly to it")
        set_help(
            self._fly,
            "Fly to it",
            "Move the camera to the hex; Enter or a double-click in the list of the worst does the same.",
        )
        self._fly.clicked.connect(self.fly_requested)
        self._values = {name: self._number() for name in METRICS}
        self._corners = [tuple(self._number() for _ in range(3)) for _ in range(8)]
        self._neighbours = QLabel()
        self._neighbours.setTextFormat(Qt.TextFormat.RichText)
        self._neighbours.setTextInteractionFlags(
            Qt.TextInteractionFlag.LinksAccessibleByMouse | Qt.TextInteractionFlag.LinksAccessibleByKeyboard
        )
        set_help(self._neighbours, "Neighbours", "The hexes across the six faces; click one to select it.")
        self._neighbours.linkActivated.connect(lambda link: self.chosen.emit(int(link)))
        self._node: NodeDetails | None = None
        self._about_node = QLabel()
        self._about_node.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        set_help(
            self._about_node,
            "Node",
            "The energy of its hexes is the sum of η(H)² (3.3). The arrow in the view points where that falls fastest: "
            "minus its gradient, whose size is given in mean edge lengths.",
        )
        self._pin = QCheckBox("Pinned")
        set_help(
            self._pin,
            "Pinned",
            "Keep this node where it is, whatever smooths the mesh. Nodes of the boundary stay anyway where that is "
            "fixed; where it slides, pinned ones do.",
        )
        self._pin.clicked.connect(lambda on: self.pin_toggled.emit(self._node.number, on))
        for corner, (node, _, _) in enumerate(self._corners):
            node.setAccessibleName(f"Node at corner {corner}")
            node.setTextFormat(Qt.TextFormat.RichText)
            node.setTextInteractionFlags(
                Qt.TextInteractionFlag.LinksAccessibleByMouse | Qt.TextInteractionFlag.LinksAccessibleByKeyboard
            )
            node.linkActivated.connect(lambda link: self.node_chosen.emit(int(link)))
        self._lay_out(page)
        on_theme_change(self, self._paint_links)

    def _paint_links(self) -> None:
        for label in (self._neighbours, *(node for node, _, _ in self._corners)):
            text = label.text()
            label.clear()  # Qt colours links as the text is set, and not again for the same text
            label.setText(text)

    def _number(self) -> QLabel:
        label = QLabel()
        label.setFont(tabular(label.font()))
        label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        return label

    def _lay_out(self, page: QWidget) -> None:
        head = QHBoxLayout()
        head.addWidget(self._title, 1)
        head.addWidget(self._fly)
        figures = QGridLayout()
        figures.setVerticalSpacing(2)
        offered = metrics_offered()
        rows = -(-len(offered) // 2)
        figures.setColumnMinimumWidth(2, 18)
        for at, metric in enumerate(offered):
            row, left = at % rows, 3 * (at // rows)
            title = QLabel(metric.title)
            set_help(title, metric.title, described(metric).removeprefix("<qt>").removesuffix("</qt>"))
            figures.addWidget(title, row, left)
            figures.addWidget(self._values[metric.name], row, left + 1)
        corners = QGridLayout()
        corners.setVerticalSpacing(2)
        corners.setHorizontalSpacing(14)
        for column, text in enumerate(("Node", "", "q(T)")):
            title = QLabel(text)
            title.setAlignment(Qt.AlignmentFlag.AlignRight)
            tint(title, MUTED)
            corners.addWidget(title, 0, column)
        for row, labels in enumerate(self._corners, start=1):
            for column, label in enumerate(labels):
                corners.addWidget(label, row, column)
        for words in (self._state, self._neighbours, self._about_node):
            words.setWordWrap(True)
        about = QVBoxLayout()
        about.addLayout(head)
        for part in (self._state, self._in_view, self._neighbours, self._about_node, self._pin):
            about.addWidget(part)
        adjacent = QFlowLayout(page)
        adjacent.setContentsMargins(8, 6, 8, 6)
        adjacent.setHorizontalSpacing(36)
        adjacent.setVerticalSpacing(8)
        for layout in (about, corners, figures):
            layout.setContentsMargins(0, 0, 0, 0)
            block = QWidget()
            block.setLayout(layout)
            adjacent.addWidget(block)
            if layout is about:
                block.setFixedWidth(_WIDTH)  # its words wrap

    @property
    def corners_in_view(self) -> bool:
        """True if the qualities of the corners are shown in the view."""
        return self._in_view.isChecked()

    def set_corners_in_view(self, on: bool) -> None:
        """Want the corners' qualities in the view, or not."""
        self._in_view.setChecked(on)

    def show_element(self, one: HexDetails | None, tags: Sequence[str] = ()) -> None:
        """Show an element and the tags that it has, or how to choose one."""
        self._stack.setCurrentIndex(0 if one is None else 1)
        if one is None:
            return
        self._title.setText(f"Hex {one.number:,}" + (f": {', '.join(tags)}" if tags else ""))
        state = "inverted, and its fixed nodes keep it so" if one.locked else "inverted" if one.inverted else ""
        self._state.setText(state)
        for name, label in self._values.items():
            bad = bool(METRICS[name].unacceptable(np.array(one.values[name])))
            label.setText("∞" if one.values[name] == np.inf else figure(one.values[name]))
            tint(label, WORSE if bad else TEXT)
        worst = int(one.corners.argmin()) if np.ptp(one.corners) > 1e-9 else -1
        for k, (node, kind, quality) in enumerate(self._corners):
            # Nothing, and yet before the link: from one at the very beginning Shift+Tab does not get away.
            node.setText(f'&#8203;<a href="{one.nodes[k]}">{one.nodes[k]:,}</a>')
            kind.setText("fixed" if one.fixed[k] else "free")
            tint(kind, MUTED)
            quality.setText(figure(float(one.corners[k]), 3))
            tint(quality, WORSE if one.corners[k] == 0 or k == worst else TEXT)
        links = (
            f'{face}&nbsp;<a href="{h}">{h:,}</a>' if h >= 0 else f"{face}&nbsp;–"
            for face, h in zip(_FACES, one.neighbours.tolist(), strict=True)
        )
        self._neighbours.setText("Neighbours: " + " &nbsp;&nbsp;".join(links))

    def show_node(self, one: NodeDetails | None, busy: bool = False, slides: str = "") -> None:
        """Show a node of the element, or how to choose one; nothing can be pinned while a run is `busy`.

        Parameters
        ----------
        one : Node, optional
        busy : bool
        slides : str
            Of a node of the boundary, what it may do where that slides; "" where that is not known.
        """
        self._node = one
        self._pin.setVisible(one is not None)
        if one is None:
            self._about_node.setText("Click nearer to a corner, or on a node's number, to see that node.")
            return
        kind = f"{one.kind}, pinned" if one.pinned and one.kind == "boundary" else one.kind
        parts = [f"Node {one.number:,}: {kind}", slides, counted(one.ring.size, "hex")]
        if np.isfinite(one.energy):
            parts.append(f"energy {figure(one.energy)}, gradient {figure(float(np.linalg.norm(one.downhill)))}")
        else:
            parts.append("energy infinite: a hex here is inverted")
        self._about_node.setText(", ".join(filter(None, parts)))
        self._pin.setChecked(one.pinned)
        self._pin.setEnabled(one.kind != "unused" and not busy)
