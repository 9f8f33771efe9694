"""Tags: named groups of hexes in the mesh, and the strip that edits them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QComboBox, QWidget

from hexmend_app.feature import Action, Feature, Host, StatePart
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.style import labelled, push_button, set_help, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_new_name
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.view_strip import ViewStrip
from hexmend_app.widgets.wording import counted, figure

_BUSY = "Hexes cannot be tagged during a run, even a paused one. Stop the run; its result is kept."
_NAMELESS = "Enter a tag name in “Tag”."
_NONE_SELECTED = "No hex selected: click a hex in the view, or press N for the worst, then press T to tag it."


class FeatureTags(Feature):
    """Adds, removes and renames tags of hexes."""

    def __init__(self, host: Host):
        super().__init__(host)
        session, commands = self.session, self.session.commands
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

    def canvas_ready(self) -> None:
        """Add the strip below the view."""
        self.canvas.frame.addWidget(self.strip)

    def refresh(self) -> None:
        """Show the tags of the mesh."""
        self.strip.set_state(self.session.selection.hex is not None, not self.session.editable)
        if not self.session.document.is_open:
            return
        now = self.session.document.now
        if self._seen.changed("tags", now):
            self.strip.set_tags({name: describe(now, members) for name, members in now.mesh.hex_sets.items()})

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
        return np.arange(self.session.document.now.mesh.n_elements) if shown is None else np.flatnonzero(shown)


def describe(state: MeasuredMesh, members: np.ndarray) -> str:
    """Return the number of hexes of a tag, of inverted hexes, and the minimum q (none without hexes)."""
    least = float(state.quality.q[members].min()) if len(members) else None
    inverted = int(np.count_nonzero(state.quality.inverted[members]))
    values = {"hexes": counted(len(members), "hex"), "inverted": f"{inverted:,}", "q": figure(least)}
    return tr("{hexes}, {inverted} inverted, q min {q}", **values)


class TagStrip(ViewStrip):
    """Strip with the name of a tag, and buttons that add hexes to it, isolate, rename or remove it.

    Attributes
    ----------
    hex_button, shown_button, listed_button, isolate_button, rename_button, remove_button : QPushButton
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(tr("Tags"), parent)
        self._tags: dict[str, str] = {}  # descriptions by name
        self._busy = self._hex_selected = False
        self._name = QComboBox()
        self._name.setEditable(True)
        self._name.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)  # the list contains existing tags only
        self._name.completer().setCaseSensitivity(Qt.CaseSensitivity.CaseSensitive)
        self._name.setMinimumContentsLength(12)
        self._name.setCurrentText("tagged")
        set_help(self._name, tr("Tag"), tr("Name of a tag; tags are saved with the mesh in VTK and VTU files."))
        self.hex_button = push_button(tr("Hex"), tr("Tag the selected hex, or remove the tag (T)."))
        self.shown_button = push_button(tr("Shown"), tr("Tag all hexes shown in the view, except hidden ones."))
        self.listed_button = push_button(tr("Worst"), tr("Tag all hexes in the list of the worst."))
        self.isolate_button = push_button(tr("Isolate"), tr("Show only the hexes with this tag and their neighbours."))
        self.rename_button = push_button(tr("Rename…"), tr("Give the tag another name."))
        self.remove_button = push_button(tr("Remove"), tr("Remove this tag from all hexes."))
        self._about = ElidingLabel()
        self._about.setAccessibleName(tr("About the tag"))
        tint(self._about, MUTED)
        buttons = (self.hex_button, self.shown_button, self.listed_button)
        of_tag = (self.isolate_button, self.rename_button, self.remove_button)
        self.add(labelled(tr("Tag"), self._name), self._name, *buttons, (self._about, 1), *of_tag)
        self._name.editTextChanged.connect(self._refresh)
        self._refresh()

    @property
    def name(self) -> str:
        """Name of the tag; "" if empty."""
        return self._name.currentText().strip()

    def set_name(self, name: str) -> None:
        """Set the name of the tag."""
        self._name.setCurrentText(name)

    @property
    def obstacle(self) -> str:
        """Reason why the selected hex cannot be tagged, as a sentence; "" if it can."""
        if self._busy:
            return tr(_BUSY)
        if not self.name:
            return tr(_NAMELESS)
        return "" if self._hex_selected else tr(_NONE_SELECTED)

    def set_tags(self, tags: Mapping[str, str]) -> None:
        """Set the tags of the mesh: their descriptions by name."""
        name = self._name.currentText()
        self._tags = dict(tags)
        with QSignalBlocker(self._name):
            self._name.clear()
            self._name.addItems(list(self._tags))
            self._name.setCurrentText(name)
        self._refresh()

    def set_state(self, hex_selected: bool, busy: bool) -> None:
        """Set whether a hex is selected, and whether a run prevents tagging."""
        self._hex_selected, self._busy = hex_selected, busy
        self._refresh()

    def _refresh(self) -> None:
        possible, tag = bool(self.name) and not self._busy, self._tags.get(self.name)
        self.hex_button.setEnabled(not self.obstacle)
        self.shown_button.setEnabled(possible)
        self.listed_button.setEnabled(possible)
        self.isolate_button.setEnabled(tag is not None)
        for button in (self.rename_button, self.remove_button):
            button.setEnabled(tag is not None and not self._busy)
        about = tag if tag is not None and not self._busy else self.obstacle
        self._about.setText(about)
        self._about.setToolTip(about)
