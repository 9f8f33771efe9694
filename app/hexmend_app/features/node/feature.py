"""Looking at what a method does to one node: the lines between node, method, sweep and what shows the step."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QDockWidget

from hexmend.errors import ParameterError
from hexmend.node_step import NodeStep
from hexmend.smoothers import METHODS, Smoother
from hexmend_app.features.inspect.worst_list import WorstList
from hexmend_app.features.node.panel import NodePanel
from hexmend_app.features.node.reasons import why_no_step, why_no_sweep, worst_free_node
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.state.look import Isolation
from hexmend_app.state.session import Session

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas

#: Milliseconds after which it is said that an answer takes its time.
_PATIENCE = 200


class Debugging:
    """Asks for the step of the chosen node, shows it, and goes through sweeps.

    Parameters
    ----------
    session : Session
        The window's state.
    panel : NodePanel
    dock : QDockWidget
        The panel's; a step is worked out and drawn only while it is in front.
    smoothing_panel, worst_list
        Where the method is chosen, and the worst element is found.
    """

    def __init__(
        self,
        session: Session,
        panel: NodePanel,
        dock: QDockWidget,
        smoothing_panel: SmoothingPanel,
        worst_list: WorstList,
    ):
        self._session, self._document, self._selection = session, session.document, session.selection
        self._explainer, self._stepping, self._view = session.explainer, session.stepping, session.view
        self._panel, self._dock = panel, dock
        self._smoothing_panel, self._worst_list = smoothing_panel, worst_list
        self._canvas: Canvas | None = None
        self._asked: tuple | None = None
        self._shown: NodeStep | None = None
        self._isolation: Isolation | None = None
        self._soon, self._patience = QTimer(panel), QTimer(panel)
        for timer, wait, act in ((self._soon, 0, self._refresh), (self._patience, _PATIENCE, self._say_it_takes_time)):
            timer.setSingleShot(True)
            timer.setInterval(wait)
            timer.timeout.connect(act)
        for told in (
            session.selection.changed,
            session.stepping.changed,
            session.smoothing.phase_changed,
            smoothing_panel.method_changed,
            smoothing_panel.form.changed,
            dock.visibilityChanged,
        ):
            told.connect(self.refresh)
        session.explainer.answered.connect(self._on_answered)
        session.view.look_changed.connect(self._on_look_changed)
        panel.node_chosen.connect(lambda node: self._selection.choose(self._selection.hex, node))
        panel.patch_toggled.connect(self._on_patch)
        panel.requested.connect(self._go)

    def set_canvas(self, canvas: Canvas) -> None:
        """Take the 3D view, which comes later than the rest."""
        self._canvas = canvas

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {
            "explain_node": self._explain_one,
            "next_node": lambda: self._go("next"),
            "ten_nodes": lambda: self._go("ten"),
            "finish_sweep": lambda: self._go("finish"),
        }

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        can = not self._why_no_sweep()
        return {"explain_node": True, "next_node": can, "ten_nodes": can, "finish_sweep": can}

    def refresh(self, *_: object) -> None:
        """Show the step of what is chosen as it is now, once all that happens at this moment has happened."""
        self._soon.start()

    # What is shown

    def _refresh(self) -> None:
        sweep = self._stepping.sweep
        self._panel.set_stepping(self._why_no_sweep(), *((sweep.done, sweep.nodes.size) if sweep else ()))
        if not self._panel.isVisible():
            self._draw(None)
            return
        self._list_nodes()
        smoother, node = self._smoother(), self._selection.node
        reason = why_no_step(self._session, smoother)
        made = self._stepping.made_by(smoother)
        if reason:
            self._say(reason)
        elif made is not None and made.node == node:
            self._show(made, made=True)
        elif sweep is not None and sweep.smoother == smoother:
            self._show(sweep.look(node), made=False)
        else:
            self._ask(self._document.now.mesh, smoother, node)

    def _ask(self, *question: object) -> None:
        if question != self._asked:
            self._asked = question
            self._explainer.ask(*question)
            self._patience.start()
        elif self._explainer.step is not None:
            self._show(self._explainer.step, made=False)

    def _on_answered(self) -> None:
        self._patience.stop()
        if self._explainer.error is not None:
            self._say(f"This could not be worked out: {self._explainer.error}.")
            return
        self._refresh()

    def _say_it_takes_time(self) -> None:
        self._draw_message("Working it out… A global method takes some seconds for it on a large mesh.")

    def _say(self, sentence: str) -> None:
        """Show no step, and why."""
        self._await_nothing()
        self._draw_message(sentence)

    def _draw_message(self, sentence: str) -> None:
        node = self._selection.node
        self._panel.show_message(sentence, "" if node is None else f"Node {node:,}")
        self._draw(None)

    def _show(self, step: NodeStep, made: bool) -> None:
        if self._stepping.sweep is not None or made:
            self._await_nothing()
        self._panel.show_step(step, METHODS[step.method].title, made)
        self._draw(step)
        if self._panel.patch_alone and self._isolation != _isolation(step):
            self._isolate(step)

    def _await_nothing(self) -> None:
        self._asked = None
        self._explainer.forget()
        self._patience.stop()

    def _draw(self, step: NodeStep | None) -> None:
        if step is not self._shown:
            self._shown = step
            if self._canvas is not None and self._document.is_open:
                self._canvas.show_node_step(step)

    def _list_nodes(self) -> None:
        chosen = self._selection
        if chosen.hex is None or not self._document.is_open:
            self._panel.set_nodes(None)
        else:
            mesh = self._document.now.mesh
            nodes = mesh.hexes[chosen.hex]
            self._panel.set_nodes(nodes[mesh.free[nodes]].tolist(), chosen.node)

    def _smoother(self) -> Smoother | None:
        """The method at hand with its values; None while one of them is wrong."""
        if self._smoothing_panel.form.problems():
            return None
        try:
            return METHODS[self._smoothing_panel.method()](**self._smoothing_panel.form.values())
        except ParameterError:
            return None

    # One node

    def _explain_one(self) -> None:
        """Come to the front with a node that has a step: that which is chosen, or the worst of the worst element."""
        self._dock.raise_()
        chosen, free = self._selection, self._document.now.mesh.free
        if chosen.node is not None and free[chosen.node]:
            return
        hexes = self._worst_list.elements if chosen.hex is None else np.array([chosen.hex])
        found = worst_free_node(self._document.now, hexes)
        if found is not None:
            chosen.choose(*found)

    def _on_patch(self, on: bool) -> None:
        if not on:
            self._view.end_isolation()
        elif self._shown is not None:
            self._isolate(self._shown)

    def _isolate(self, step: NodeStep) -> None:
        self._isolation = _isolation(step)
        self._view.change(isolation=self._isolation)
        if self._canvas is not None:
            self._canvas.fly_to(*step.hexes.tolist())

    def _on_look_changed(self) -> None:
        if self._view.look.isolation != self._isolation:
            self._isolation = None
            self._panel.set_patch(False)

    # A sweep

    def _go(self, what: str) -> None:
        """Visit the next node of the sweep, ten of them, or all that are left."""
        self._dock.raise_()
        if self._why_no_sweep():
            return
        smoother = self._smoother()
        if what == "finish":
            self._stepping.finish(smoother)
        else:
            self._stepping.advance(smoother, 10 if what == "ten" else 1)
        step, now = self._stepping.last, self._document.now
        chosen = self._selection.hex
        h = chosen if chosen in step.hexes else int(step.hexes[now.figures.scaled_jacobian[step.hexes].argmin()])
        self._selection.choose(h, step.node)

    def _why_no_sweep(self) -> str:
        return why_no_sweep(self._session, self._smoother())


def _isolation(step: NodeStep) -> Isolation:
    return Isolation(tuple(step.hexes.tolist()), 0)
