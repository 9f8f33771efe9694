"""Looking at what a method does to one node: the lines between node, method, sweep and what shows the step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QTimer

from hexmend.node_step import NodeStep
from hexmend.smoothers import METHODS
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.node_step.panel import NodePanel
from hexmend_app.features.node_step.reasons import reason_for_no_step, reason_for_no_sweep, worst_free_node
from hexmend_app.picture.appearance import Isolation

#: Milliseconds after which it is said that an answer takes its time.
_PATIENCE = 200


class FeatureNode(Feature):
    """Asks for the step of the chosen node, shows it, and goes through sweeps.

    A step is worked out and drawn only while the panel is in front.
    """

    order = 43

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._document, self._selection = session.document, session.selection
        self._explainer, self._stepping, self._view = session.node_step_task, session.node_sweep, session.view
        self._asked: tuple | None = None
        self._shown: NodeStep | None = None
        self._isolation: Isolation | None = None
        panel = self.panel = NodePanel()
        self._patience = QTimer(panel, singleShot=True, interval=_PATIENCE)
        self._patience.timeout.connect(self._say_it_takes_time)
        session.node_step_task.answered.connect(self._patience.stop)
        panel.node_chosen.connect(lambda node: self._selection.choose(self._selection.hex, node))
        panel.patch_toggled.connect(self._on_patch)
        panel.requested.connect(self._go)

    def actions(self) -> Sequence[Action]:
        """Explain a node, and step through a sweep."""
        return (
            Action(
                id="explain_node",
                text="&Explain a node's step",
                menu="Hex",
                part=2,
                keys="D",
                help="Show what the chosen method does to the chosen node, or to one of the worst hex, and why.",
                handle=self._explain_one,
                in_view=True,
            ),
            *(
                Action(
                    id=id,
                    text=text,
                    menu="Smooth",
                    part=3,
                    keys=keys,
                    help=help,
                    handle=lambda label=topic: self._go(label),
                    enabled=lambda: not self._reason_for_no_sweep(),
                )
                for id, topic, text, keys, help in (
                    (
                        "next_node",
                        "next",
                        "Next &node of a sweep",
                        "F11",
                        "Let a local method move one node, and look at its step.",
                    ),
                    (
                        "ten_nodes",
                        "ten",
                        "Ten nodes of a s&weep",
                        "Shift+F11",
                        "Let a local method move ten nodes.",
                    ),
                    (
                        "finish_sweep",
                        "finish",
                        "&Finish the sweep",
                        "Ctrl+F11",
                        "Let a local method move all nodes that are left.",
                    ),
                )
            ),
        )

    def states(self) -> Sequence[StatePart]:
        """The isolation of the patch of the node."""
        return (StatePart(name="patch", data=bool, to_data=lambda: self.panel.patch_alone, restore=self._take_patch),)

    def panels(self) -> Sequence[Panel]:
        """The node's step."""
        return (
            Panel(
                id="node",
                title="Node",
                widget=self.panel,
                place=PanelPlace.DRAWER,
                order=40,
                help="What the chosen method does to the chosen node, and why.",
            ),
        )

    # What is shown

    def refresh(self) -> None:
        """Show the step of what is chosen as it is now."""
        sweep = self._stepping.sweep
        self.panel.set_stepping(self._reason_for_no_sweep(), *((sweep.done, sweep.nodes.size) if sweep else ()))
        if self._view.look.isolation != self._isolation:
            self._isolation = None
            self.panel.set_patch(False)
        if not self.panel.isVisible():
            self._draw(None)
            return
        self._list_nodes()
        smoother, node = self.session.run_setup.smoother, self._selection.node
        reason = reason_for_no_step(self.session, smoother)
        made = self._stepping.made_by(smoother)
        if reason:
            self._say(reason)
        elif made is not None and made.node == node:
            self._show(made, made=True)
        elif sweep is not None and sweep.smoother == smoother:
            self._show(sweep.preview(node), made=False)
        else:
            self._ask(self._document.now.mesh, smoother, node)

    def _ask(self, *question: object) -> None:
        if question != self._asked:
            self._asked = question
            self._explainer.ask(*question)
            self._patience.start()
        elif self._explainer.error is not None:
            self._draw_message(f"This could not be worked out: {self._explainer.error}.")
        elif self._explainer.step is not None:
            self._show(self._explainer.step, made=False)

    def _say_it_takes_time(self) -> None:
        self._draw_message("Working it out… A global method takes some seconds for it on a large mesh.")

    def _say(self, sentence: str) -> None:
        """Show no step, and why."""
        self._await_nothing()
        self._draw_message(sentence)

    def _draw_message(self, sentence: str) -> None:
        node = self._selection.node
        self.panel.show_message(sentence, "" if node is None else f"Node {node:,}")
        self._draw(None)

    def _show(self, step: NodeStep, made: bool) -> None:
        if self._stepping.sweep is not None or made:
            self._await_nothing()
        self.panel.show_step(step, METHODS[step.method].title, made)
        self._draw(step)
        if self.panel.patch_alone and self._isolation != _isolation(step):
            self._isolate(step)

    def _await_nothing(self) -> None:
        self._asked = None
        self._explainer.forget()
        self._patience.stop()

    def _draw(self, step: NodeStep | None) -> None:
        if step is not self._shown:
            self._shown = step
            if self.canvas is not None and self._document.is_open:
                self.canvas.show_node_step(step)

    def _list_nodes(self) -> None:
        chosen = self._selection
        if chosen.hex is None or not self._document.is_open:
            self.panel.set_nodes(None)
        else:
            mesh = self._document.now.mesh
            nodes = mesh.hexes[chosen.hex]
            self.panel.set_nodes(nodes[mesh.free[nodes]].tolist(), chosen.node)

    # One node

    def _explain_one(self) -> None:
        """Come to the front with a node that has a step: that which is chosen, or the worst of the worst element."""
        self.host.show_panel("node")
        chosen, free = self._selection, self._document.now.mesh.free
        if chosen.node is not None and free[chosen.node]:
            chosen.visit(chosen.hex)
            return
        hexes = self._selection.worst_hexes() if chosen.hex is None else np.array([chosen.hex])
        found = worst_free_node(self._document.now, hexes)
        if found is not None:
            chosen.choose(*found)
            chosen.visit(found[0])

    def _on_patch(self, on: bool) -> None:
        if not on:
            self._view.end_isolation()
        elif self._shown is not None:
            self._isolate(self._shown)

    def _take_patch(self, on: bool) -> None:
        """Restore from a session whether the isolated hexes are the node's patch."""
        self._isolation = self._view.look.isolation if on else None
        self.panel.set_patch(on)

    def _isolate(self, step: NodeStep) -> None:
        self._isolation = _isolation(step)
        self._view.change(isolation=self._isolation, quality_range=None, peel=0)  # which would hide some of it
        self._selection.visit(*step.hexes.tolist())

    # A sweep

    def _go(self, subject: str) -> None:
        """Visit the next node of the sweep, ten of them, or all that are left."""
        self.host.show_panel("node")
        if self._reason_for_no_sweep():
            return
        smoother = self.session.run_setup.smoother
        if subject == "finish":
            self._stepping.finish(smoother)
        else:
            self._stepping.advance(smoother, 10 if subject == "ten" else 1)
        step, now = self._stepping.last, self._document.now
        chosen = self._selection.hex
        h = chosen if chosen in step.hexes else int(step.hexes[now.figures.scaled_jacobian[step.hexes].argmin()])
        self._selection.choose(h, step.node)

    def _reason_for_no_sweep(self) -> str:
        return reason_for_no_sweep(self.session, self.session.run_setup.smoother)


def _isolation(step: NodeStep) -> Isolation:
    return Isolation(tuple(step.hexes.tolist()), 0)
