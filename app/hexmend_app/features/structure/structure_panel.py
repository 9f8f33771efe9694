"""The panel of the mesh's structure: irregular and sharp edges, and fixed, free and locked nodes, each shown or not."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QWidget

from hexmend.boundary import NodeClass
from hexmend.mesh.structure import SHARP_DEGREES as DEGREES
from hexmend.mesh.structure import Structure as Found
from hexmend_app.features.structure.layer_row import Entry, LayerRow
from hexmend_app.scene.layers.structure import (
    BOUNDARY,
    FREE,
    IRREGULAR_NODE,
    KINDS,
    LOCKED,
    OTHER,
    PINNED,
    SHARP,
    VALENCES,
)  # fmt: skip
from hexmend_app.scene.palette import ORIGINAL, OTHER_CELLS
from hexmend_app.state.classer import PIN, WHISKER, Classes
from hexmend_app.state.look import Structure
from hexmend_app.widgets.wording import counted

_LAYERS: dict[str, tuple[str, str, str]] = {
    "irregular": (
        "Irregular, inside",
        "Edges inside the mesh that not four hexes share, also called singular: the angles around one are 360° by "
        "their number at best, 120° at three and 72° at five, so that no method brings all hexes beside it to "
        "quality 1. Drawn through the mesh, thick where nothing hides them; points are nodes where they end or fork.",
        "None: inside the mesh, four hexes share every edge.",
    ),
    "boundary": (
        "Irregular, boundary",
        "Edges of the boundary that not two hexes share although it is smooth there. One hex alone has an angle "
        "of up to 180° there, three share it: neither reaches quality 1.",
        "None: two hexes share every edge at which the boundary is smooth.",
    ),
    "sharp": (
        "Sharp edges",
        f"Edges at which the boundary turns by more than {DEGREES:g}°, or that more than two of its faces share.",
        "None: the boundary is smooth all round.",
    ),
    "fixed": (
        "Fixed nodes",
        "Nodes that no method moves, of the hexes in sight: those of the boundary, and others that are pinned.",
        "None: the mesh has no boundary.",
    ),
    "free": (
        "Free nodes",
        "Nodes that methods may move, of the hexes in sight. They are inside: cut or peel the mesh to see them.",
        "None: all nodes are on the boundary or pinned.",
    ),
    "locked": (
        "Locked nodes",
        "Nodes of inverted hexes that fixed nodes alone keep inverted: no method that leaves these where they are "
        "can mend them. How many of them can be freed where the boundary slides is counted too: nothing holds "
        "these in inversion then.",
        "None: no hex is kept inverted by fixed nodes alone.",
    ),
    "kinds": (
        "Kinds of nodes",
        "What nodes of the boundary may do where it slides (boundary = slide), by the method's feature angle: pinned "
        "nodes and corners stay, others slide along their curve or on their patch. Where that is not enough, Mend may "
        "take nodes off the surface within its tolerance, corners found by the angle alone too. A whisker is a sharp "
        "edge that ends amid a patch: its nodes slide on that. Shift+P pins the chosen node.",
        "None: the mesh has no boundary.",
    ),
    "others": (
        "Other cells",
        "Tetrahedra, pyramids and wedges beside the hexes: the outside of them, see-through. Their nodes are fixed.",
        "None: the mesh has hexes alone.",
    ),
    "original": (
        "Original surface",
        "The boundary as it was when the mesh was opened, see-through, where the boundary has left it.",
        "None: the mesh has no boundary.",
    ),
}
_EDGES = ("irregular", "boundary", "sharp")
#: What nodes are called by what they are to the boundary.
_CALLED = {
    NodeClass.CORNER: "corners", NodeClass.CURVE: "on curves", NodeClass.PATCH: "on patches",
    WHISKER: "on whiskers", PIN: "pinned",
}  # fmt: skip
#: Layers that can be chosen before it is known what there is of them: somebody has to want it first.
_AT_ONCE = ("kinds",)
#: Layers that are on unless they are switched off: a mesh that has nothing of them does not offer them.
_UNLESS = ("others",)


class StructurePanel(QWidget):
    """Chooses what is drawn of the structure, and counts it.

    Attributes
    ----------
    layers : dict of str to LayerRow
        What there is of each, by the names of `Structure`'s fields.

    Signals
    -------
    structure_changed(Structure)
        The user chose.
    """

    structure_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._structure = Structure()
        self._counts: tuple[int, ...] = ()
        self._classes: Classes | None = None
        self.layers = {
            name: LayerRow(*texts, at_once=name in _AT_ONCE, unless=name in _UNLESS) for name, texts in _LAYERS.items()
        }
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(6)
        grid.setVerticalSpacing(5)
        grid.setColumnStretch(1, 1)
        for row, (name, layer) in enumerate(self.layers.items()):
            grid.addWidget(layer.box, row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(layer.entries, row, 1)
            layer.box.clicked.connect(lambda on, name=name: self._choose(name, on))
        self.set_structure(self._structure)  # of no mesh there is nothing to count

    def offered(self) -> dict[str, bool]:
        """Which layers can be switched, by the names of `Structure`'s fields."""
        return {name: layer.box.isEnabled() for name, layer in self.layers.items()}

    def set_structure(self, structure: Structure) -> None:
        """Show a choice, without a signal."""
        self._structure = structure
        for name, layer in self.layers.items():
            layer.set_on(getattr(structure, name))

    def set_found(self, found: Found | None) -> None:
        """Take the edges of a mesh; None while they are being found."""
        if found is None:
            for name in _EDGES:
                self.layers[name].set_entries(None)
            return
        nodes: list[Entry] = []
        if len(found.nodes):
            nodes = [(IRREGULAR_NODE, False, counted(len(found.nodes), "node"))]
        self.layers["irregular"].set_entries(_by_valence(found.interior_valence) + nodes)
        self.layers["boundary"].set_entries(_by_valence(found.boundary_valence))
        self.layers["sharp"].set_entries([(SHARP, True, f"{len(found.sharp):,}")] if len(found.sharp) else [])

    def set_nodes(self, boundary: int, pinned: int, free: int, locked: int) -> None:
        """Take the numbers of nodes on the boundary, pinned and free, and of locked elements."""
        counts = (boundary, pinned, free, locked)
        if counts == self._counts:
            return
        self._counts = counts
        fixed = [(BOUNDARY, False, f"{boundary:,} boundary")] if boundary else []
        if pinned:
            fixed.append((PINNED, False, f"{pinned:,} pinned"))
        self.layers["fixed"].set_entries(fixed)
        self.layers["free"].set_entries([(FREE, False, f"{free:,}")] if free else [])
        self.layers["original"].set_entries([(ORIGINAL, True, "as opened")] if boundary else [])
        self._show_locked()

    def set_others(self, counts: Mapping[str, int]) -> None:
        """Take the numbers of cells beside the hexes that fill space, by their kind."""
        entries: list[Entry] = [(OTHER_CELLS, False, f"{count:,} {kind}") for kind, count in counts.items()]
        self.layers["others"].set_entries(entries)

    def set_classes(self, classes: Classes | None, error: BaseException | None = None) -> None:
        """Take what the nodes of the boundary are; None while that is being found, or with the error why not."""
        self._classes = classes
        entries: list[Entry] | None = None
        if classes is not None:
            counts = {kind: classes.count(kind) for kind in _CALLED}
            entries = [(KINDS[kind], False, f"{count:,} {_CALLED[kind]}") for kind, count in counts.items() if count]
        self.layers["kinds"].set_entries(entries, error)
        self._show_locked()

    def _show_locked(self) -> None:
        """How many elements are locked, and, once it is known, how many of them sliding can free."""
        locked, classes = self._counts[-1] if self._counts else 0, self._classes
        entries = [(LOCKED, False, f"of {counted(locked, 'hex')}")] if locked else []
        if locked and classes is not None and classes.locked == locked:
            entries.append((None, False, f"{classes.freed:,} freed by sliding"))
        self.layers["locked"].set_entries(entries)

    def _choose(self, name: str, on: bool) -> None:
        self._structure = dataclasses.replace(self._structure, **{name: on})
        self.layers[name].set_on(on)
        self.structure_changed.emit(self._structure)


def _by_valence(valence: np.ndarray) -> list[Entry]:
    """Edges with so many elements around each, counted by what has a colour of its own."""
    numbers, counts = np.unique(valence, return_counts=True)
    own = [(VALENCES[n], True, f"{count:,} of {n}") for n, count in zip(numbers, counts, strict=True) if n in VALENCES]
    others = [(n, count) for n, count in zip(numbers, counts, strict=True) if n not in VALENCES]
    if len(others) == 1:
        own.append((OTHER, True, f"{others[0][1]:,} of {others[0][0]}"))
    elif others:
        own.append((OTHER, True, f"{sum(count for _, count in others):,} others"))
    return own
