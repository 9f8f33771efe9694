"""Tags: named groups of hexes in the mesh, and the strip that edits them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from hexmend_app.feature import Action, ChangeTracker, Feature, Host, StatePart
from hexmend_app.features.tags.tag_strip import Tag, TagStrip
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_new_name

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class FeatureTags(Feature):
    """Adds, removes and renames tags of hexes."""

    def __init__(self, host: Host):
        super().__init__(host)
        session, commands = self.session, self.session.commands
        self._seen = ChangeTracker()
        strip = self.strip = TagStrip(host.dialog_parent)
        strip.closed.connect(strip.hide)
        strip.hex_button.clicked.connect(self._toggle)
        strip.shown_button.clicked.connect(lambda: commands.tag(strip.name, self._all_shown()))
        strip.listed_button.clicked.connect(lambda: commands.tag(strip.name, session.selection.worst_hexes()))
        strip.isolate_button.clicked.connect(
            lambda: session.view.isolate(session.document.now.mesh.hex_sets[strip.name])
        )
        strip.rename_button.clicked.connect(self._ask_name)
        strip.remove_button.clicked.connect(lambda: commands.remove_tag(strip.name))

    def actions(self) -> Iterable[Action]:
        """Yield the actions that tag the selected hex and show the strip."""
        yield Action(
            id="tag",
            text=tr("&Tag hex"),
            menu="Hex",
            section=2,
            keys="T",
            icon="tag-outline",
            help=tr("Add the tag named below the view to the selected hex, or remove it; saved with the mesh."),
            handle=self._tag_selected,
            in_view=True,
        )
        yield Action(
            id="tags",
            text=tr("Ta&gs"),
            menu="Hex",
            section=2,
            help=tr("Show a bar that tags, isolates, renames and removes named groups of hexes."),
            handle=lambda on: self.strip.setVisible(on),
            checked=lambda: not self.strip.isHidden(),
            in_view=True,
        )

    def states(self) -> Iterable[StatePart]:
        """Yield the name for the next tag."""
        yield StatePart(name="tag", data=str, to_data=lambda: self.strip.name, restore=self.strip.set_name)

    def canvas_ready(self, canvas: Canvas) -> None:
        """Add the strip below the view."""
        canvas.frame.addWidget(self.strip)

    def refresh(self) -> None:
        """Show the tags of the mesh."""
        self.strip.set_state(self.session.selection.hex is not None, not self.session.editable)
        if not self.session.document.is_open:
            return
        now = self.session.document.now
        if self._seen.changed("tags", now):
            self.strip.set_tags([
                Tag(
                    name,
                    len(members),
                    int(np.count_nonzero(now.figures.inverted[members])),
                    float(now.figures.q[members].min()) if len(members) else None,
                )
                for name, members in now.mesh.hex_sets.items()
            ])  # fmt: skip

    def _tag_selected(self) -> None:
        """Show the strip, and tag or untag the selected hex, or tell why that is not possible."""
        self.strip.show()
        if self.strip.obstacle:
            self.host.messages.show_info(self.strip.obstacle)
        else:
            self._toggle()

    def _toggle(self) -> None:
        selected, name = self.session.selection.hex, self.strip.name
        members = self.session.document.now.mesh.hex_sets.get(name, ())
        self.session.commands.tag(name, [selected], on=selected not in members)

    def _ask_name(self) -> None:
        """Ask for another name of the tag; that of another tag is refused."""
        before, others = self.strip.name, self.session.document.now.mesh.hex_sets
        name = ask_new_name(self.host.dialog_parent, tr("Rename tag"), before)
        if name in others and name != before:
            self.host.messages.show_info(tr("There is a tag “{name}” already.", name=name))
        elif name and name != before:
            self.session.commands.rename_tag(before, name)
            self.strip.set_name(name)

    def _all_shown(self) -> np.ndarray:
        shown = None if self.canvas is None else self.canvas.viewport.remaining_after_cut()
        return np.arange(self.session.document.now.mesh.n_hexes) if shown is None else np.flatnonzero(shown)
