"""Panel of one node's step, with buttons that run a sweep node by node."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import (
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QStackedLayout,
    QVBoxLayout,
    QWidget,
)

from hexmend.node_step import NodeStep, StepStatus
from hexmend_app.features.node_step.figures import NodeFigures
from hexmend_app.features.node_step.step_plot import NodePlot
from hexmend_app.features.node_step.step_texts import rows, verdict
from hexmend_app.theme.palette import OTHERWISE, SEARCH, TAKEN, TRIED, UPHILL
from hexmend_app.theme.style import MUTED, WORSE, note, on_theme_change, set_help, tabular, tint
from hexmend_app.widgets.legend import legend_entry

_BUTTONS = {
    "next": ("Next node", "Move the next node of the sweep, and look at its step (F11)."),
    "ten": ("10 nodes", "Move the next ten nodes of the sweep (Shift+F11)."),
    "finish": ("Finish", "Move all nodes that are left of the sweep (Ctrl+F11)."),
}
_LEGEND = (
    ("gradient", UPHILL, "The gradient of the energy by this node: uphill. Its length in the view means nothing."),
    ("direction", SEARCH, "Where the method looks for the step; its length in the view means nothing."),
    ("step", TAKEN, "The step that is taken, in its true length, and the trial that led to it."),
    ("tried", TRIED, "Trial steps that were cut, where they would have put the node; or where it did not go."),
)


class NodePanel(QWidget):
    """Shows a node's step, or why there is none.

    Signals
    -------
    node_chosen(int)
        The user wants to see this node.
    patch_toggled(bool)
        The user wants the node's elements alone in the view, or not.
    requested(name)
        "next", "ten" or "finish".
    """

    node_chosen = Signal(int)
    patch_toggled = Signal(bool)
    requested = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._title, self._verdict = QLabel(), QLabel()
        font = QFont(self._title.font())
        font.setBold(True)
        self._title.setFont(font)
        self._verdict.setWordWrap(True)
        self._verdict.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        for label, name in ((self._title, "Node"), (self._verdict, "What becomes of it")):
            label.setAccessibleName(name)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._message = note()
        self._message.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._message.setMargin(16)
        self.plot = NodePlot()
        self.figures = NodeFigures()
        self._nodes = QLabel()
        self._nodes.setTextFormat(Qt.TextFormat.RichText)
        self._nodes.setTextInteractionFlags(
            Qt.TextInteractionFlag.LinksAccessibleByMouse | Qt.TextInteractionFlag.LinksAccessibleByKeyboard
        )
        self._nodes.setWordWrap(True)
        self._nodes.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._nodes.linkActivated.connect(lambda link: self.node_chosen.emit(int(link)))
        set_help(self._nodes, "Free nodes", "The nodes of the chosen hex that methods may move; a click goes there.")
        self._patch = QCheckBox("Patch alone")
        set_help(
            self._patch,
            "Patch alone",
            "Show nothing but the node's hexes, before the camera; Esc brings back the rest.",
        )
        self._patch.toggled.connect(self.patch_toggled)
        self._buttons = {name: QPushButton(text) for name, (text, _) in _BUTTONS.items()}
        for name, button in self._buttons.items():
            text = button.fontMetrics().horizontalAdvance(button.text())
            button.setMinimumWidth(text + 16)  # less than the style's, which a narrow window has no room for
            button.clicked.connect(lambda _=False, name=name: self.requested.emit(name))
        self._progress = QLabel()
        self._progress.setFont(tabular(self._progress.font()))
        self._progress.setAccessibleName("Progress of the sweep")
        tint(self._progress, MUTED)
        self._legend = self._make_legend()
        self._lay_out()
        on_theme_change(self, self._paint_links)
        self.set_stepping("")
        self.show_message("")

    def _paint_links(self) -> None:
        text = self._nodes.text()
        self._nodes.clear()  # Qt colours links as the text is set, and not again for the same text
        self._nodes.setText(text)

    def _make_legend(self) -> QWidget:
        row = QWidget()
        layout = QHBoxLayout(row)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        for text, role, help in _LEGEND:
            entry = legend_entry(text, role)
            set_help(entry, text, help)
            layout.addWidget(entry)
        self._otherwise = {text: legend_entry(text, OTHERWISE) for text in ("after", "before")}
        for text, entry in self._otherwise.items():
            set_help(entry, text, f"The edges at the node, {text} the step.")
            layout.addWidget(entry)
        row.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)  # of the last two one is shown
        layout.addStretch()
        return row

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.addWidget(self._title)
        head.addWidget(self._verdict, 1)
        head.addWidget(self._progress)
        self._stack = QStackedLayout()
        self._stack.addWidget(self._message)
        page = QWidget()
        middle = QHBoxLayout(page)
        middle.setContentsMargins(0, 0, 0, 0)
        middle.addWidget(self.plot, 1)
        middle.addWidget(self.figures, 1)
        self._stack.addWidget(page)
        foot = QHBoxLayout()
        foot.setSpacing(6)
        foot.addWidget(self._patch)
        foot.addStretch()
        for button in self._buttons.values():
            foot.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 4, 6, 4)
        column.setSpacing(3)
        column.addLayout(head)
        column.addLayout(self._stack, 1)
        column.addWidget(self._legend)
        column.addWidget(self._nodes)
        column.addLayout(foot)

    def show_message(self, sentence: str, title: str = "") -> None:
        """Say why there is no step."""
        self._title.setText(title)
        self._verdict.clear()
        self._message.setText(sentence)
        self._stack.setCurrentIndex(0)
        self._legend.hide()
        self.plot.show_step(None)

    def show_step(self, step: NodeStep, method: str, made: bool) -> None:
        """Show a step by a method, of which the title is given, that would be made or was `made`."""
        self._title.setText(f"Node {step.node:,}")
        became = verdict(step)
        moved = became in (StepStatus.MOVED, StepStatus.SHORTENED)
        sentence = became.value if made or not moved else became.value.replace("Moved", "Will be moved")
        self._verdict.setText(f"{method}. {sentence}")
        tint(self._verdict, MUTED if moved else WORSE)
        self.plot.show_step(step)
        self.plot.setVisible(self.plot.drawn)
        self.figures.show_rows(rows(step))
        self._otherwise["before"].setVisible(made and step.move > 0)
        self._otherwise["after"].setVisible(not made and step.move > 0)
        self._legend.show()
        self._stack.setCurrentIndex(1)

    def set_nodes(self, nodes: Sequence[int] | None, chosen: int | None = None) -> None:
        """List the free nodes of the chosen element, of which one may be the chosen one; None while none is chosen."""
        self._nodes.setVisible(nodes is not None)
        if nodes is None:
            return
        links = (f"<b>{i:,}</b>" if i == chosen else f'<a href="{i}">{i:,}</a>' for i in nodes)
        # Nothing, and yet before the first link: from one at the very beginning Shift+Tab does not get away.
        self._nodes.setText(f"&#8203;Free nodes: {' '.join(links) or 'none'}")

    def set_stepping(self, reason: str, done: int = 0, total: int = 0) -> None:
        """Offer to go through a sweep, or say for what `reason` not; how far one under way is."""
        for name, button in self._buttons.items():
            button.setEnabled(not reason)
            set_help(button, _BUTTONS[name][0], reason or _BUTTONS[name][1])
        self._progress.setText(f"{done:,} of {total:,} nodes" if done else "")

    def set_patch(self, on: bool) -> None:
        """Show whether the patch is alone in the view; without a signal."""
        with QSignalBlocker(self._patch):
            self._patch.setChecked(on)

    @property
    def patch_alone(self) -> bool:
        """True if the hexes of the node are isolated in the view."""
        return self._patch.isChecked()
