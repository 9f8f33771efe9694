"""Reasons why no step or sweep is available, and the node that is explained by default."""

from __future__ import annotations

import numpy as np

from hexmend.smoothers import METHODS, Smoother
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.session import Session
from hexmend_app.translation import tr

_HINT = (
    "Click a hex in the view and select one of its free nodes, or press D for a node of the worst hex, to see how the "
    "selected method moves it, and why. F11 runs a sweep node by node."
)
_INVALID = "Correct the marked parameter of the method first."
_NO_FREE_NODES = (
    "The hex has no free nodes. Peel, cut (C) or hide hexes (Ctrl+click) to reach the hexes inside, or clear the "
    "selection and press D."
)


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
    has_free = bool(mesh.free[mesh.hexes[selection.hex]].any())
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


def worst_free_node(state: State, hexes: np.ndarray) -> tuple[int, int] | None:
    """Find the free node to explain by default.

    Parameters
    ----------
    state : State
    hexes : (k,) int
        Hexes to search, in this order.

    Returns
    -------
    (hex, node) or None
        The first hex with a free node, and its free node with the lowest sum of scaled Jacobians of the adjacent
        hexes; None if no node is free.
    """
    mesh, jacobian = state.mesh, state.figures.scaled_jacobian
    with_free = hexes[mesh.free[mesh.hexes[hexes]].any(axis=1)]
    if not with_free.size:
        return None
    h = int(with_free[0])
    nodes = mesh.hexes[h][mesh.free[mesh.hexes[h]]].tolist()
    return h, min(nodes, key=lambda node: float(jacobian[mesh.topology.node_corners[node] // 8].sum()))
