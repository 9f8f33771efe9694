"""Why a node has no step to look at, and why there is no sweep to go through; and which node to look at first."""

from __future__ import annotations

import numpy as np

from hexmend.smoothers import METHODS, Smoother
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.session import Session

_HINT = (
    "Click a hex in the view and choose one of its free nodes, or press D for one at the worst hex. Here you "
    "will see what the chosen method does to it, and why; F11 goes through a sweep node by node."
)
_WRONG = "Correct the marked value of the method's parameters first."
_REACH = "Peel, cut (C) or dig (Ctrl and a click) to reach hexes inside, or choose none and press D."


def reason_for_no_step(session: Session, smoother: Smoother | None) -> str:
    """Why there is no step of the chosen node to show, in a sentence; "" where there is one.

    Parameters
    ----------
    session : Session
    smoother : Smoother, optional
        The method at hand; None while one of its values is wrong.
    """
    chosen, smoothing = session.selection, session.run
    if not session.document.is_open:
        return "Open a mesh to see what a method does to its nodes."
    if smoothing.busy and smoothing.phase is not Phase.PAUSED:
        return "A run is under way. Pause it (F5) to look at a node's step."
    if smoother is None:
        return _WRONG
    if chosen.hex is None:
        return _HINT
    mesh = session.document.now.mesh
    some_free = bool(mesh.free[mesh.hexes[chosen.hex]].any())
    choose = "Choose a free one, below." if some_free else f"Its hex has no free node. {_REACH}"
    if chosen.node is None:
        return "Choose one of the hex's free nodes, below." if some_free else choose
    if not mesh.fixed[chosen.node]:
        return ""
    if smoother.slides and mesh.topology.boundary[chosen.node]:
        return f"Node {chosen.node:,} lies on the boundary, which slides: steps are shown of nodes inside. {choose}"
    where = "lies on the boundary" if mesh.topology.boundary[chosen.node] else "is pinned"
    return f"Node {chosen.node:,} {where}: no method moves it. {choose}"


def reason_for_no_sweep(session: Session, smoother: Smoother | None) -> str:
    """Why there is no sweep to go through node by node, in a sentence; "" where there is one."""
    if not session.document.is_open:
        return "Open a mesh first."
    if session.run.busy:
        return "A run is under way: end it first. While it is paused, steps can be looked at."
    if not session.editable:
        return "Another mesh is being read."
    if smoother is None:
        return _WRONG
    if not isinstance(smoother, LocalDescent):
        local = ", ".join(one.title for one in METHODS.values() if issubclass(one, LocalDescent))
        return f"Only a local method goes from node to node: choose one of these: {local}."
    return "" if session.document.now.mesh.free.any() else "Every node of the mesh is fixed."


def worst_free_node(state: State, hexes: np.ndarray) -> tuple[int, int] | None:
    """The first of some hexes (k,) that has a free node, and that of its free nodes with the worst hexes around it."""
    mesh, jacobian = state.mesh, state.figures.scaled_jacobian
    with_free = hexes[mesh.free[mesh.hexes[hexes]].any(axis=1)]
    if not with_free.size:
        return None
    h = int(with_free[0])
    nodes = mesh.hexes[h][mesh.free[mesh.hexes[h]]].tolist()
    return h, min(nodes, key=lambda node: float(jacobian[mesh.topology.node_corners[node] // 8].sum()))
