"""Panel of one node's step, with buttons that run a sweep node by node."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QStackedLayout,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.features.node_step.step_plot import NodePlot
from hexmend_app.features.node_step.step_texts import Row, rows
from hexmend_app.state.node_step import NodeStep, StepStatus
from hexmend_app.theme.palette import DESCENT, MUTED, OTHERWISE, SEARCH, TAKEN, TEXT, TRIED, WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, on_theme_change, push_button, set_help, small_label, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import ActionButton
from hexmend_app.widgets.legend import legend_entry
from hexmend_app.widgets.link_label import LinkLabel

#: Actions of a sweep.
SWEEP = ("next_node", "ten_nodes", "finish_sweep")
_LEGEND = (
    (
        "steepest descent",
        DESCENT,
        "Downhill: the negative gradient of the energy with respect to the node. Its length has no meaning. There is "
        "no arrow if the gradient is within rounding.",
    ),
    ("direction", SEARCH, "Search direction, or the direction to the target position. Its length has no meaning."),
    ("step", TAKEN, "Accepted step, drawn to scale, and its trial in the plot."),
    ("rejected", TRIED, "Rejected trial steps, at the positions that they would give the node."),
    ("after", OTHERWISE, "Edges at the node after the step."),
    ("before", OTHERWISE, "Edges at the node before the step."),
)
_NO_PLOT = "No plot: along the direction, the energy changes by rounding only."


_ROW = (
    '<table width="100%" cellspacing="0" cellpadding="0" style="margin-top: 5px">'
    '<tr><td style="color: {text}">{name}</td>'
    '<td align="right" style="color: {colour}">{value}</td></tr></table>'
    '<p style="color: {muted}; font-size: {size}pt; margin: 0">{meaning}</p>'
)


class NodePanel(QWidget):
    """Shows the step of a node, or the reason why it has none."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._title, self._status = QLabel(), QLabel()
        self._title.setFont(bold(self._title.font()))
        self._status.setWordWrap(True)
        self._status.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        for label, name in ((self._title, tr("Node")), (self._status, tr("Outcome of the step"))):
            label.setAccessibleName(name)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._message = small_label()
        self._message.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._message.setMargin(16)
        self.plot = NodePlot()
        self._no_plot = small_label(tr(_NO_PLOT))
        self._no_plot.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._no_plot.setMargin(16)
        self.figures = NodeFigures()
        self.nodes = LinkLabel()
        self.nodes.setWordWrap(True)
        self.nodes.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        set_help(
            self.nodes, tr("Free nodes"), tr("Nodes of the selected hex that methods may move; click one to select it.")
        )
        text, help = tr("Isolate patch"), tr("Show only the hexes of the node; Esc shows all hexes again.")
        self.isolate_button = push_button(text, help)
        self._buttons = [ActionButton(id, with_text=True) for id in SWEEP]
        self._progress = QLabel()
        self._progress.setFont(tabular(self._progress.font()))
        self._progress.setAccessibleName(tr("Progress of the sweep"))
        tint(self._progress, MUTED)
        self._legend = self._make_legend()
        self._lay_out()
        self.show_message("")

    def _make_legend(self) -> QWidget:
        row = QWidget()
        entries = {text: legend_entry(tr(text), role) for text, role, _ in _LEGEND}
        for text, _, help in _LEGEND:
            set_help(entries[text], tr(text), tr(help))
        self._edges = {name: entries[name] for name in ("after", "before")}  # one of them is shown
        row.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        fill(QHBoxLayout(row), *entries.values(), None, margins=(0, 0, 0, 0), spacing=4)
        return row

    def _lay_out(self) -> None:
        head = fill(QHBoxLayout(), self._title, (self._status, 1), self._progress, spacing=None)
        self._stack = QStackedLayout()
        self._stack.addWidget(self._message)
        page = QWidget()
        fill(QHBoxLayout(page), (self.plot, 1), (self._no_plot, 1), (self.figures, 1), margins=(0, 0, 0, 0))
        self._stack.addWidget(page)
        foot = fill(QHBoxLayout(), self.isolate_button, None, *self._buttons)
        fill(QVBoxLayout(self), head, (self._stack, 1), self._legend, self.nodes, foot, margins=(8, 4, 8, 4), spacing=4)

    def show_message(self, message: str, title: str = "") -> None:
        """Show a message instead of a step."""
        self._title.setText(title)
        self._status.clear()
        self._message.setText(message)
        self._stack.setCurrentIndex(0)
        self._legend.hide()
        self.isolate_button.setEnabled(False)
        self.plot.show_step(None)

    def show_step(self, step: NodeStep, method: str, done: bool) -> None:
        """Show a step.

        Parameters
        ----------
        step : NodeStep
        method : str
            Title of the method.
        done : bool
            True if the node has been moved, False for a preview of the step.
        """
        self._title.setText(tr("Node {node}", node=step.node))
        status = step.outcome
        moves = status in (StepStatus.MOVED, StepStatus.SHORTENED)
        outcome = status.value if done or not moves else status.value.replace("Moved", "Will be moved")
        self._status.setText(tr("{method}. {outcome}", method=method, outcome=tr(outcome)))
        tint(self._status, MUTED if moves else WORSE)
        self.plot.show_step(step)
        self.plot.setVisible(self.plot.drawn)
        self._no_plot.setVisible(len(step.curve) > 0 and not self.plot.drawn)
        self.figures.show_rows(rows(step))
        self._edges["before"].setVisible(done and step.move > 0)
        self._edges["after"].setVisible(not done and step.move > 0)
        self._legend.show()
        self.isolate_button.setEnabled(True)
        self._stack.setCurrentIndex(1)

    def set_nodes(self, nodes: Sequence[int] | None, selected: int | None = None) -> None:
        """List the free nodes of the selected hex as links, the `selected` node in bold; None hides the list."""
        self.nodes.setVisible(nodes is not None)
        if nodes is None:
            return
        links = (f"<b>{i}</b>" if i == selected else f'<a href="{i}">{i}</a>' for i in nodes)
        self.nodes.setText(tr("Free nodes: {nodes}", nodes=" ".join(links) or tr("none")))

    def set_sweep(self, done: int = 0, total: int = 0) -> None:
        """Show the progress of the sweep."""
        self._progress.setText(tr("{done:,} of {total:,} steps", done=done, total=total) if done else "")


class NodeFigures(QTextBrowser):
    """Shows the figures of a node's step."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._rows: Sequence[Row] = ()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setTabChangesFocus(True)
        self.viewport().setAutoFillBackground(False)
        self.document().setDocumentMargin(3)
        set_help(self, tr("Values of the step"), "")
        on_theme_change(self, self._render)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Replace the figures and scroll to the top."""
        self._rows = rows
        self._render()

    def _render(self) -> None:
        size = smaller(self.font()).pointSizeF()
        self.setHtml(
            "".join(
                _ROW.format(
                    name=escape(row.name),
                    value=escape(row.value).replace("  ", " &nbsp;"),
                    meaning=escape(row.meaning),
                    text=TEXT,
                    muted=MUTED,
                    colour=row.colour,
                    size=size,
                )
                for row in self._rows
            )
        )
