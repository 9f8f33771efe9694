"""Coordinates of an Abaqus file in the data lines of its *NODE cards, also of files that it includes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import quoted
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.text_coordinates import TextCoordinates, TextFields
from hexmend.io.formats.abaqus.deck import Card, Deck
from hexmend.io.formats.abaqus.includes import read_deck
from hexmend.io.formats.abaqus.model import Instance
from hexmend.io.formats.abaqus.reader import read_node_cards
from hexmend.io.storage.atomic import AtomicFiles

#: Characters of a real number that Abaqus and CalculiX read.
_WIDTH = 20
#: Differences of a part's instances that count as rounding, relative to the size of the part.
_ROUNDING = 1e-9


def locate(path: Path) -> AbaqusCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    deck = read_deck(path)
    return AbaqusCoordinates(deck, read_node_cards(deck))


class AbaqusCoordinates:
    """Coordinates of all instances, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    deck : Deck
    instances : list of Instance
        With their *NODE cards, in the order of the mesh's nodes.
    """

    def __init__(self, deck: Deck, instances: list[Instance]):
        self._deck, self._instances = deck, instances
        self._rows: dict[Card, np.ndarray] = {}
        self._fields: dict[Card, TextFields] = {}
        ids: dict[Card, np.ndarray] = {}
        for instance in instances:
            for card in instance.part.node_cards:
                if card not in self._rows:
                    ids[card], self._rows[card], self._fields[card] = deck.nodes(card)
                instance.part.points.append(self._rows[card])
                instance.part.node_ids.append(ids[card])
        self._given = np.concatenate([instance.points() for instance in instances])
        self._kept = np.concatenate([instance.part.last_given() for instance in instances])
        self.points = self._given[self._kept]

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the deck and its files with new coordinates; see `LocatedCoordinates.write`."""
        new_rows: dict[Card, np.ndarray] = {}
        first, new = 0, self._given.copy()
        new[self._kept] = points
        for instance in self._instances:
            for card in instance.part.node_cards:
                own = slice(first, first + len(self._rows[card]))
                first = own.stop
                rows = _in_part(instance, self._given[own], new[own], self._rows[card])
                if card in new_rows and not _same(new_rows[card], rows):
                    name = quoted(instance.part.name)
                    raise CoordinatesError(f"instances of the part {name} share its nodes and have moved differently")
                new_rows.setdefault(card, rows)
        cards = list(new_rows)
        given, rows = (np.concatenate([table[card] for card in cards]) for table in (self._rows, new_rows))
        arrays = ([getattr(self._fields[card], name) for card in cards] for name in ("begin", "end", "absent"))
        located = TextCoordinates(self._deck.files.data, given, TextFields(*map(np.concatenate, arrays)), _WIDTH)
        return self._deck.files.write(files, target, located.edits(rows))


def _in_part(instance: Instance, before: np.ndarray, after: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Convert coordinates from the assembly to the part, (k, 3); unchanged ones are as in the file."""
    if np.array_equal(instance.rotation, np.eye(3)):
        return np.where(before == after, rows, after - instance.translation)
    moved = ~(before == after).all(axis=1)
    return np.where(moved[:, None], (after - instance.translation) @ instance.rotation, rows)


def _same(a: np.ndarray, b: np.ndarray) -> bool:
    """Return True if nodes coincide up to rounding."""
    size = np.ptp(a, axis=0).max(initial=0.0)
    return bool((np.abs(a - b) <= _ROUNDING * size).all())
