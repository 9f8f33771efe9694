"""Coordinates of an Abaqus file in the data lines of its *NODE cards."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import quoted
from hexmend.io.coordinates.edits import Edits
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.text_coordinates import TextCoordinates, TextFields, parse_fields
from hexmend.io.formats.abaqus.deck import Card, Deck
from hexmend.io.formats.abaqus.included_output import write_files
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
        self._unparsed: set[Card] = set()
        for instance in instances:
            for card in instance.part.node_cards:
                if card not in self._rows:
                    self._rows[card] = self._parse(card)
                instance.part.points.append(self._rows[card])
        self.points = np.concatenate([instance.points() for instance in instances])

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the deck and its files with new coordinates; see `LocatedCoordinates.write`."""
        new_rows: dict[Card, np.ndarray] = {}
        first = 0
        for instance in self._instances:
            for card in instance.part.node_cards:
                own = slice(first, first + len(self._rows[card]))
                first = own.stop
                rows = _in_part(instance, self.points[own], points[own], self._rows[card])
                if card in new_rows and not _same(new_rows[card], rows):
                    name = quoted(instance.part.name)
                    raise CoordinatesError(f"instances of the part {name} share its nodes and have moved differently")
                new_rows.setdefault(card, rows)
        edits = {deck: self._edits(deck, new_rows) for deck in dict.fromkeys(card.deck for card in new_rows)}
        return write_files(self._deck, edits, target, files)

    def _edits(self, deck: Deck, new_rows: dict[Card, np.ndarray]) -> Edits:
        """Edits of the coordinates in one file."""
        cards = [card for card in new_rows if card.deck is deck]
        given, rows = (np.concatenate([table[card] for card in cards]) for table in (self._rows, new_rows))
        arrays = ([getattr(self._fields[card], name) for card in cards] for name in ("begin", "end", "absent"))
        fields = TextFields(*map(np.concatenate, arrays))
        return TextCoordinates(deck.given, given, fields, _WIDTH, self._unparsed.isdisjoint(cards)).edits(rows)

    def _parse(self, card: Card) -> np.ndarray:
        """Coordinates of a card's nodes, (k, 3), from the fields that will be replaced, or else as the reader does."""
        fields = self._fields[card] = node_fields(card.deck.data, card.begin, card.end)
        rows = parse_fields(card.deck.given, fields.begin.ravel(), fields.end.ravel())
        if rows is None:
            self._unparsed.add(card)
        return card.deck.nodes(card)[1] if rows is None else rows.reshape(-1, 3)


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


def node_fields(data: bytes, begin: int, end: int) -> TextFields:
    """Fields of the coordinates in the data lines of a *NODE card, which follow the number of the node.

    Parameters
    ----------
    data : bytes
    begin, end : int
        Byte range of the data lines.

    Returns
    -------
    TextFields
        A row for each line that is not blank.
    """
    letters = np.frombuffer(data, np.uint8, end - begin, begin)
    if not (letters > ord(" ")).any():
        none = np.zeros((0, 3), np.int64)
        return TextFields(none, none, none.astype(bool))
    breaks, commas = np.flatnonzero(letters == ord("\n")), np.flatnonzero(letters == ord(","))
    start, stop = np.append(0, breaks + 1), np.append(breaks, len(letters))
    start, stop = start[start < len(letters)], stop[start < len(letters)]
    first = np.searchsorted(commas, start)
    count = np.searchsorted(commas, stop) - first
    if not count.all():  # lines without a comma may be blank
        filled = np.logical_or.reduceat(letters > ord(" "), start)
        start, stop, first, count = start[filled], stop[filled], first[filled], count[filled]
    commas = np.append(commas, [0] * 4)  # never read for fields that are absent
    _, last = _trimmed(letters, start, stop)
    low, high = np.empty((len(start), 3), np.int64), np.empty((len(start), 3), np.int64)
    absent = count[:, None] <= np.arange(3)
    for k in range(3):
        low[:, k] = np.where(absent[:, k], last, commas[first + k] + 1)
        high[:, k] = np.where(absent[:, k], last, np.where(count > k + 1, commas[first + k + 1], last))
    begins, ends = _trimmed(letters, low, np.maximum(low, high))
    blank = begins == ends
    begins, ends = np.where(blank, low, begins), np.where(blank, low, ends)  # a blank field is written at its begin
    return TextFields(begins + begin, ends + begin, absent)


def _trimmed(letters: np.ndarray, begin: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ranges without blanks at their ends."""
    begin, end = begin.copy(), end.copy()
    while (blank := (begin < end) & (letters[np.minimum(begin, len(letters) - 1)] <= ord(" "))).any():
        begin += blank
    while (blank := (begin < end) & (letters[end - 1] <= ord(" "))).any():
        end -= blank
    return begin, end
