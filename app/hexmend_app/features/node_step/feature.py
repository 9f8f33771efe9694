"""Node debugger: explains the step of the selected node, and runs a sweep node by node."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import Any

import numpy as np
from PySide6.QtCore import QTimer

from hexmend.smoothers import METHODS
from hexmend_app.feature import Action, ButtonAppearance, Feature, Host, Panel, PanelPlace
from hexmend_app.features.node_step.panel import SWEEP, NodePanel
from hexmend_app.features.node_step.reasons import reason_for_no_step, reason_for_no_sweep, worst_free_node
from hexmend_app.picture.visibility import Isolate
from hexmend_app.state.node_step import NodeStep
from hexmend_app.translation import tr

#: Milliseconds until the panel reports that the step is being computed.
_COMPUTING_DELAY = 200


#: Actions of a sweep: id, amount, text in the menu, keys, text on the button, help.
_SWEEP = (
    ("next_node", "next", "Next &node of sweep", "F11", "Next node", "Move the next node of a local method's sweep."),
    ("ten_nodes", "ten", "Ten nodes of s&weep", "Shift+F11", "10 nodes", "Move the next ten nodes of the sweep."),
    ("finish_sweep", "finish", "&Finish sweep", "Ctrl+F11", "Finish", "Move all remaining nodes of the sweep."),
)


class FeatureNodeStep(Feature):
    """Shows the step of the selected node, and runs sweeps node by node.

    A step is computed and drawn only while the panel is in front.
    """

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._document, self._selection = session.document, session.selection
        self._task, self._node_sweep, self._view = session.node_step_task, session.node_sweep, session.view
        self._request: tuple | None = None
        self._shown: NodeStep | None = None
        panel = self.panel = NodePanel()
        self._computing_timer = QTimer(panel, singleShot=True, interval=_COMPUTING_DELAY)
        self._computing_timer.timeout.connect(
            lambda: self._draw_message(tr("Computing… A global method takes several seconds on a large mesh."))
        )
        session.node_step_task.found.connect(self._computing_timer.stop)
        panel.nodes.followed.connect(lambda node: self._selection.choose(self._selection.hex, node))
        panel.isolate_button.clicked.connect(self._isolate_patch)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that explain a node and run a sweep node by node."""
        yield Action(
            id="explain_node",
            text=tr("&Explain node step"),
            menu="Hex",
            section=2,
            keys="D",
            help=tr("Explain the step of the selected method at the selected node, or at a node of the worst hex."),
            handle=self._explain_node,
            in_view=True,
        )
        yield from self._sweep_actions()

    def _sweep_actions(self) -> Iterable[Action]:
        for id, amount, text, keys, label, help in _SWEEP:
            yield Action(
                id=id,
                text=tr(text),
                menu="Smooth",
                section=3,
                keys=keys,
                help=tr(help),
                handle=partial(self._advance, amount),
                enabled=lambda: not self._reason_for_no_sweep(),
                appearance=lambda label=label, help=help: ButtonAppearance(
                    tr(label), "", self._reason_for_no_sweep() or tr(help)
                ),
            )

    def actions_ready(self) -> None:
        """Show actions on the buttons of the panel."""
        self.panel.show_actions({id: self.host.action(id) for id in SWEEP})

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of the node's step."""
        yield Panel(
            id="node",
            title=tr("Node"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            order=40,
            help=tr("Step of the selected method at the selected node."),
        )

    # Display

    def refresh(self) -> None:
        """Show the step of the selected node, or the reason why it has none."""
        sweep = self._node_sweep.sweep
        self.panel.set_sweep(*((sweep.done, sweep.nodes.size) if sweep else ()))
        if not self.panel.isVisible():
            self._draw(None)
            return
        self._list_nodes()
        smoother, node = self.session.run_setup.smoother, self._selection.node
        reason = reason_for_no_step(self.session, smoother)
        last_step = self._node_sweep.last_step_of(smoother)
        if reason:
            self._cancel_request()
            self._draw_message(reason)
        elif last_step is not None and last_step.node == node:
            self._show(last_step, done=True)
        elif sweep is not None and sweep.smoother == smoother:
            self._show(sweep.preview(node), done=False)
        else:
            self._request_step(self._document.now.mesh, smoother, node)

    def _request_step(self, *request: Any) -> None:
        """Compute a step in the background, or show it if it has been computed."""
        if request != self._request:
            self._request = request
            self._task.forget()
            self._task.ask(*request)
            self._computing_timer.start()
        elif self._task.error is not None:
            self._draw_message(tr("Step not computed: {error}.", error=str(self._task.error).rstrip(".")))
        elif self._task.result is not None:
            self._show(self._task.result, done=False)

    def _cancel_request(self) -> None:
        self._request = None
        self._task.forget()
        self._computing_timer.stop()

    def _draw_message(self, message: str) -> None:
        node = self._selection.node
        self.panel.show_message(message, "" if node is None else tr("Node {node}", node=node))
        self._draw(None)

    def _show(self, step: NodeStep, done: bool) -> None:
        if self._node_sweep.sweep is not None or done:
            self._cancel_request()
        self.panel.show_step(step, tr(METHODS[step.method].title), done)
        self._draw(step)

    def _draw(self, step: NodeStep | None) -> None:
        if step is not self._shown:
            self._shown = step
            if self.canvas is not None and self._document.is_open:
                self.canvas.show_node_step(step)

    def _list_nodes(self) -> None:
        selection = self._selection
        if selection.hex is None or not self._document.is_open:
            self.panel.set_nodes(None)
        else:
            mesh = self._document.now.mesh
            nodes = mesh.hexes[selection.hex]
            self.panel.set_nodes(nodes[mesh.free[nodes]].tolist(), selection.node)

    # Node

    def _explain_node(self) -> None:
        """Show the panel with the selected node if it is free, else with the worst free node of the worst hex."""
        self.host.show_panel("node")
        chosen, free = self._selection, self._document.now.mesh.free
        if chosen.node is not None and free[chosen.node]:
            chosen.visit(chosen.hex)
            return
        hexes = self._selection.worst_hexes() if chosen.hex is None else np.array([chosen.hex])
        hex_and_node = worst_free_node(self._document.now, hexes)
        if hex_and_node is not None:
            chosen.choose(*hex_and_node)
            chosen.visit(hex_and_node[0])

    def _isolate_patch(self) -> None:
        """Show only the hexes of the node, none of which a range or peeled layers may hide."""
        hexes = self._shown.hexes.tolist()
        self._view.change(show={"isolate": Isolate(tuple(hexes), 0), "quality": None, "peel": 0})
        self._selection.visit(*hexes)

    # Sweep

    def _advance(self, amount: str) -> None:
        """Move the "next" node of the sweep, the next "ten", or "finish" it; then select the last node moved."""
        self.host.show_panel("node")
        if self._reason_for_no_sweep():
            return
        smoother: Any = self.session.run_setup.smoother
        if amount == "finish":
            self._node_sweep.finish(smoother)
        else:
            self._node_sweep.advance(smoother, 10 if amount == "ten" else 1)
        step, jacobian, h = self._node_sweep.last, self._document.now.figures.scaled_jacobian, self._selection.hex
        if h not in step.hexes:
            h = int(step.hexes[jacobian[step.hexes].argmin()])
        self._selection.choose(h, step.node)

    def _reason_for_no_sweep(self) -> str:
        return reason_for_no_sweep(self.session, self.session.run_setup.smoother)
