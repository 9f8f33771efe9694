"""Node debugger: explains the step of the selected node, and runs a sweep node by node."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import Any

import numpy as np
from PySide6.QtCore import QTimer

from hexmend.smoothers import METHODS, Smoother
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.feature import Action, ButtonAppearance, Feature, Host, Panel, PanelPlace
from hexmend_app.features.node_step.panel import NodePanel
from hexmend_app.picture.visibility import Isolate
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.node_step import NodeStep
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.session import Session
from hexmend_app.translation import tr

#: Milliseconds until the panel reports that the step is being computed.
_COMPUTING_DELAY = 200
#: Actions of a sweep: id, amount, text in the menu, keys, text on the button, help.
_SWEEP = (
    ("next_node", "next", "Next &node of sweep", "F11", "Next node", "Move the next node of a local method's sweep."),
    ("ten_nodes", "ten", "Ten nodes of s&weep", "Shift+F11", "10 nodes", "Move the next ten nodes of the sweep."),
    ("finish_sweep", "finish", "&Finish sweep", "Ctrl+F11", "Finish", "Move all remaining nodes of the sweep."),
)
_HINT = (
    "Click a hex in the view and select one of its free nodes, or press D for a node of the worst hex, to see how the "
    "selected method moves it, and why. F11 runs a sweep node by node."
)
_INVALID = "Correct the marked parameter of the method first."
_NO_FREE_NODES = (
    "The hex has no free nodes. Peel, cut (C) or hide hexes (Ctrl+click) to reach the hexes inside, or clear the "
    "selection and press D."
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
            nodes = mesh.elements[selection.hex]
            self.panel.set_nodes([*dict.fromkeys(nodes[mesh.free[nodes]].tolist())], selection.node)

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
        step, jacobian, h = self._node_sweep.last, self._document.now.quality.scaled_jacobian, self._selection.hex
        if h not in step.hexes:
            h = int(step.hexes[jacobian[step.hexes].argmin()])
        self._selection.choose(h, step.node)

    def _reason_for_no_sweep(self) -> str:
        return reason_for_no_sweep(self.session, self.session.run_setup.smoother)


def reason_for_no_step(session: Session, smoother: Smoother | None) -> str:
    """Return the reason why the step of the selected node cannot be shown; "" if it can.

    Parameters
    ----------
    session : Session
    smoother : Smoother, optional
        The selected method; None while one of its parameters is invalid.
    """
    selection, run = session.selection, session.run
    if not session.document.is_open:
        return tr("Open a mesh to see how a method moves its nodes.")
    if run.busy and run.phase is not Phase.PAUSED:
        return tr("A run is in progress. Pause it (F5) to see the step of a node.")
    if smoother is None:
        return tr(_INVALID)
    if selection.hex is None:
        return tr(_HINT)
    mesh, node = session.document.now.mesh, selection.node
    has_free = bool(mesh.free[mesh.elements[selection.hex]].any())
    remedy = tr("Select a free node below.") if has_free else tr(_NO_FREE_NODES)
    if node is None:
        return remedy
    if not mesh.fixed[node]:
        return ""
    boundary = bool(mesh.topology.boundary[node])
    if smoother.slides and boundary:
        reason = tr("Node {node} is on the sliding boundary: only steps of interior nodes are shown.", node=node)
    elif boundary:
        reason = tr("Node {node} is on the boundary: no method moves it.", node=node)
    elif mesh.interfaces is not None and mesh.interfaces.interface_nodes[node] and not mesh.immovable[node]:
        reason = tr("Node {node} is on an interface between materials, which is kept: no method moves it.", node=node)
    elif mesh.pinned is not None and mesh.pinned[node]:
        reason = tr("Node {node} is pinned: no method moves it.", node=node)
    else:
        reason = tr(
            "Node {node} is fixed, by a rule of motion or by a fixed node of higher order: no method moves it.",
            node=node,
        )
    return f"{reason} {remedy}"


def reason_for_no_sweep(session: Session, smoother: Smoother | None) -> str:
    """Return the reason why a sweep cannot be run node by node; "" if it can. See `reason_for_no_step`."""
    if not session.document.is_open:
        return tr("Open a mesh first.")
    if session.run.busy:
        return tr("A run is in progress: stop it first. While it is paused, steps can be inspected but not applied.")
    if not session.editable:
        return tr("Another mesh is being opened.")
    if smoother is None:
        return tr(_INVALID)
    if not isinstance(smoother, LocalDescent):
        local = ", ".join(tr(method.title) for method in METHODS.values() if issubclass(method, LocalDescent))
        return tr("Only local methods move one node at a time. Select one of: {methods}.", methods=local)
    return "" if session.document.now.mesh.free.any() else tr("All nodes of the mesh are fixed.")


def worst_free_node(state: MeasuredMesh, hexes: np.ndarray) -> tuple[int, int] | None:
    """Find the free node to explain by default.

    Parameters
    ----------
    state : MeasuredMesh
    hexes : (k,) int
        Hexes to search, in this order.

    Returns
    -------
    (hex, node) or None
        The first hex with a free node, and its free node with the lowest sum of scaled Jacobians of the adjacent
        hexes; None if no node is free.
    """
    mesh, jacobian = state.mesh, state.quality.scaled_jacobian
    with_free = hexes[mesh.free[mesh.elements[hexes]].any(axis=1)]
    if not with_free.size:
        return None
    h = int(with_free[0])
    nodes = mesh.elements[h][mesh.free[mesh.elements[h]]].tolist()
    return h, min(nodes, key=lambda node: float(jacobian[mesh.topology.node_corners[node] // 8].sum()))
