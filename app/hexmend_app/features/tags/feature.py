"""Tagging elements: the lines between the mesh's groups of elements and the panel that shows them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend_app.features.inspect.worst_list import WorstList
from hexmend_app.features.tags.tag_panel import TagPanel, TagRow
from hexmend_app.state.commands import Commands
from hexmend_app.state.session import Session


class Tagging:
    """Gives elements tags, takes them away, and shows who has them.

    Parameters
    ----------
    session : Session
        The window's state.
    commands : Commands
    panel : TagPanel
    worst_list : WorstList
    shown : callable
        The elements that are shown in the view, (m,) bool; None for all.
    """

    def __init__(
        self,
        session: Session,
        commands: Commands,
        panel: TagPanel,
        worst_list: WorstList,
        shown: Callable[[], np.ndarray | None],
    ):
        document = self._document = session.document
        self._session, self._selection = session, session.selection
        self._commands = commands
        self._panel = panel
        self._shown = shown
        panel.toggle_requested.connect(self._toggle)
        panel.shown_requested.connect(lambda name: commands.tag(name, self._all_shown()))
        panel.listed_requested.connect(lambda name: commands.tag(name, worst_list.elements))
        panel.isolate_requested.connect(lambda name: session.view.isolate(document.now.mesh.hex_sets[name]))
        panel.remove_requested.connect(commands.remove_tag)
        panel.renamed.connect(commands.rename_tag)
        session.selection.changed.connect(self._enable)
        session.smoothing.phase_changed.connect(self._enable)
        for told in (session.opener.began, session.opener.cancelled, session.opener.failed):
            told.connect(self._enable)

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {"tag": self._panel.toggle}

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        return {"tag": self._panel.can_toggle}

    def refresh(self) -> None:
        """Show the tags as they are now."""
        now = self._document.now
        self._panel.set_tags([
            TagRow(
                name,
                len(members),
                int(np.count_nonzero(now.figures.inverted[members])),
                float(now.figures.q[members].min()) if len(members) else None,
            )
            for name, members in now.mesh.hex_sets.items()
        ])  # fmt: skip
        self._enable()

    def _enable(self) -> None:
        self._panel.set_state(self._selection.hex is not None, not self._session.editable)

    def _toggle(self, name: str) -> None:
        chosen = self._selection.hex
        members = self._document.now.mesh.hex_sets.get(name, ())
        self._commands.tag(name, [chosen], on=chosen not in members)

    def _all_shown(self) -> np.ndarray:
        shown = self._shown()
        return np.arange(self._document.now.mesh.n_hexes) if shown is None else np.flatnonzero(shown)
