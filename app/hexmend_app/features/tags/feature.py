"""Tags: named groups of hexes in the mesh, and their panel."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelGroup, PanelPlace, StatePart
from hexmend_app.features.tags.tag_panel import TagPanel, TagRow
from hexmend_app.translation import tr


class FeatureTags(Feature):
    """Adds and removes tags of hexes, and lists them."""

    order = 54
    shows_iterations = True

    def __init__(self, host: Host):
        super().__init__(host)
        session, commands = self.session, self.session.commands
        self._seen = ChangeTracker()
        panel = self.panel = TagPanel()
        panel.toggle_requested.connect(self._toggle)
        panel.shown_requested.connect(lambda name: commands.tag(name, self._all_shown()))
        panel.listed_requested.connect(lambda name: commands.tag(name, session.selection.worst_hexes()))
        panel.isolate_requested.connect(lambda name: session.view.isolate(session.document.now.mesh.hex_sets[name]))
        panel.remove_requested.connect(commands.remove_tag)
        panel.renamed.connect(commands.rename_tag)
        panel.refused.connect(host.messages.show_info)

    def actions(self) -> Sequence[Action]:
        """Return the action that tags the selected hex."""
        return (
            Action(
                id="tag",
                text=tr("&Tag hex"),
                menu="Hex",
                part=2,
                keys="T",
                icon="tag-outline",
                help=tr(
                    "Add the tag in the Tags panel to the selected hex, or remove it; tags are saved with the mesh."
                ),
                handle=self.panel.toggle,
                in_view=True,
            ),
        )

    def states(self) -> Sequence[StatePart]:
        """Return the name for the next tag."""
        return (StatePart(name="tag", data=str, to_data=lambda: self.panel.name, restore=self.panel.set_name),)

    def panels(self) -> Sequence[Panel]:
        """Return the panel with the tags."""
        return (
            Panel(
                id="tags",
                title=tr("Tags"),
                widget=self.panel,
                place=PanelPlace.DRAWER,
                group=PanelGroup.FIND,
                order=60,
                help=tr("Named groups of hexes, saved with the mesh."),
            ),
        )

    def refresh(self) -> None:
        """Show the tags of the mesh."""
        self.panel.setEnabled(self.session.document.is_open)
        self.panel.set_state(self.session.selection.hex is not None, not self.session.editable)
        if not self.session.document.is_open:
            return
        now = self.session.document.now
        if self._seen.changed("tags", now):
            self.panel.set_tags([
                TagRow(
                    name,
                    len(members),
                    int(np.count_nonzero(now.figures.inverted[members])),
                    float(now.figures.q[members].min()) if len(members) else None,
                )
                for name, members in now.mesh.hex_sets.items()
            ])  # fmt: skip

    def _toggle(self, name: str) -> None:
        selected = self.session.selection.hex
        members = self.session.document.now.mesh.hex_sets.get(name, ())
        self.session.commands.tag(name, [selected], on=selected not in members)

    def _all_shown(self) -> np.ndarray:
        shown = None if self.canvas is None else self.canvas.viewport.remaining_after_cut()
        return np.arange(self.session.document.now.mesh.n_hexes) if shown is None else np.flatnonzero(shown)
