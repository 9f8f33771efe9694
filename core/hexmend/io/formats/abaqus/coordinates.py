"""Coordinates of an Abaqus file in the data lines of its *NODE cards, also of files that it includes."""

from __future__ import annotations

import os
import shutil
from collections.abc import Collection, Mapping
from itertools import count
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.io.base.cursor import quoted
from hexmend.io.coordinates.edits import Edits
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.replacement import IncludedFileError, is_same_file
from hexmend.io.coordinates.text_coordinates import TextCoordinates, TextFields
from hexmend.io.formats.abaqus.deck import Card, Deck, Reference
from hexmend.io.formats.abaqus.includes import included_files, read_deck
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
                    ids[card], self._rows[card], self._fields[card] = card.deck.nodes(card)
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
        edits = {deck: self._edits(deck, new_rows) for deck in dict.fromkeys(card.deck for card in new_rows)}
        return write_files(self._deck, edits, target, files)

    def _edits(self, deck: Deck, new_rows: dict[Card, np.ndarray]) -> Edits:
        """Edits of the coordinates in one file."""
        cards = [card for card in new_rows if card.deck is deck]
        given, rows = (np.concatenate([table[card] for card in cards]) for table in (self._rows, new_rows))
        arrays = ([getattr(self._fields[card], name) for card in cards] for name in ("begin", "end", "absent"))
        fields = TextFields(*map(np.concatenate, arrays))
        return TextCoordinates(deck.given, given, fields, _WIDTH).edits(rows)


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


def write_files(root: Deck, edits: Mapping[Deck, Edits], target: Path, files: AtomicFiles) -> tuple[str, ...]:
    """Write a deck and the files that it includes with other coordinates.

    Where the deck replaces itself, so do its files. Else a file with moved nodes is written next to the new deck with
    the name of that deck behind its own, which the new deck refers to; others are copied where they are missing.

    Parameters
    ----------
    root : Deck
    edits : mapping of Deck to Edits
        Of the deck and the files that it includes.
    target : Path
    files : AtomicFiles
        As of `LocatedCoordinates.write`.

    Returns
    -------
    tuple of str
        Notes about the files.

    Raises
    ------
    CoordinatesError
        If a file with moved nodes is included twice.
    IncludedFileError
        If the copy of the deck would include itself.
    """
    file = files.add(target)  # the first, which is replaced last
    own = {one: part for one, part in edits.items() if len(part)}
    paths = [one.path.resolve() for one in root.walk()]
    if twice := [one for one in own if paths.count(one.path.resolve()) > 1]:
        raise CoordinatesError(f"{twice[0].path.name} is included twice, and its nodes have moved")
    if is_same_file(root.path, target):
        for one, part in own.items():
            if one is not root:
                part.write(files.add(one.path), one.given)
        own.get(root, Edits()).write(file, root.given)
        changed = sorted(one.path.name for one in own if one is not root)
        return (f"Coordinates are replaced in {', '.join(changed)} too.",) if changed else ()
    renamed = _new_names(root, own, target)
    notes = []
    for one in reversed(list(root.walk())[1:]):  # included files before those that include them
        if one in renamed:
            part = _with_names(own.get(one, Edits()), _references(one, renamed))
            part.write(files.add(_place(target, renamed[one])), one.given)
            notes.append(f"{one.reference.name} is written as {renamed[one]}.")
        else:
            notes += _copied(one, renamed, target, files)
    _with_names(own.get(root, Edits()), _references(root, renamed)).write(file, root.given)
    return tuple(dict.fromkeys(reversed(notes)))


def _references(file: Deck, renamed: dict[Deck, str]) -> list[tuple[Reference, str]]:
    """Places in a file that name files with another name in the copy, and these names."""
    return [(one.reference, renamed[one]) for one in file.included if one in renamed]


def _with_names(edits: Edits, names: list[tuple[Reference, str]]) -> Edits:
    """Edits and the new names of included files."""
    parts = [edits]
    for reference, name in names:
        quote = b'"' if reference.parent.given[reference.begin : reference.begin + 1] == b'"' else b""
        place = np.array([reference.begin]), np.array([reference.end])
        parts.append(Edits(*place, [quote + name.encode() + quote]))
    begin, end = (np.concatenate([getattr(part, name) for part in parts]) for name in ("begin", "end"))
    return Edits(begin, end, [text for part in parts for text in part.texts]).in_order()


def _new_names(root: Deck, own: Collection[Deck], target: Path) -> dict[Deck, str]:
    """Names of the copies of included files with moved nodes, and of files that include them.

    No other file has the name, save one that the deck at the target includes, which these copies replace.
    """
    given = {one.path.resolve() for one in root.walk()}
    free, renamed = included_files(target) - given, {}
    taken = {target.resolve()}
    for one in list(root.walk())[1:]:
        if not any(file in own for file in one.walk()):
            continue
        for number in count(1):
            name = _renamed(one, f"-{target.stem}" if number == 1 else f"-{target.stem}-{number}")
            path = (target.parent / name).resolve()
            if path not in taken and (path in free or not os.path.lexists(path)):
                break
        taken.add(path)
        renamed[one] = name
    return renamed


def _renamed(file: Deck, suffix: str) -> str:
    """Name of the copy of an included file, with letters behind its own; a file elsewhere comes next to the deck."""
    name = PurePosixPath(file.reference.name.replace("\\", "/"))
    name = name.with_name(f"{name.stem}{suffix}{name.suffix}")
    return name.name if name.is_absolute() or ".." in name.parts else str(name)


def _place(target: Path, name: str) -> Path:
    """Path of a file next to the new deck, in a folder that exists."""
    path = target.parent / name
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def _copied(file: Deck, renamed: dict[Deck, str], target: Path, files: AtomicFiles) -> list[str]:
    """Copy an included file that stays as it is to where the new deck looks for it; returns notes.

    Raises `IncludedFileError` where the new deck has the name of this file: it would include itself.
    """
    name, parent = Path(file.reference.name), file.reference.parent
    folder = Path(renamed.get(parent, parent.reference.name if parent.reference else "")).parent
    if name.is_absolute():
        return []
    places = [target.parent / at / name for at in ("", folder)]
    if target.resolve() in [path.resolve() for path in places]:
        deck = file.reference.parent.path.name
        raise IncludedFileError(target, f"has the name of a file that {deck} includes", "Choose another name.")
    found = next((path for path in places if path.is_file()), None)
    if found is not None or ".." in name.parts:
        same = found is not None and (is_same_file(file.path, found) or found.read_bytes() == file.given)
        return [] if same else [f"The new deck includes {name}, which was not copied: check that it is the right file."]
    shutil.copyfile(file.path, files.add(_place(target, str(name))))
    return [f"{name} is copied next to the new deck."]
