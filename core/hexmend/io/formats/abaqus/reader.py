"""Reader of Abaqus and CalculiX input files: the cards that define the mesh.

Coordinates of an Abaqus file in the data lines of its *NODE cards, also of files that it includes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import is_number, quoted
from hexmend.io.base.remedies import check_suffix, some_names, unread_note
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.text_coordinates import TextFields
from hexmend.io.formats.abaqus.content import to_mesh
from hexmend.io.formats.abaqus.deck import NODE_FIELDS, Card, Deck, read_deck, unquoted
from hexmend.io.formats.abaqus.model import (
    ElementCard,
    Instance,
    Part,
    SetDefinition,
    merged,
    name_key,
    placement,
)
from hexmend.io.formats.decks.coordinates import DeckCoordinates
from hexmend.io.storage.atomic import AtomicFiles
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

#: Cards that generate nodes or elements from others.
_GENERATING = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM")
_EXPAND = "Write the file with all nodes and elements expanded, as Abaqus/CAE does."
#: Cards of conditions at nodes, which hold wherever the nodes are.
_CONDITIONS = ("BOUNDARY", "CLOAD", "EQUATION", "MPC")
#: Cards without data of the mesh, which no note mentions.
_IGNORED = ("HEADING", "INCLUDE", "PREPRINT", "ASSEMBLY", "END ASSEMBLY")
#: Cards that say to what the next ones belong.
_STRUCTURE = ("PART", "END PART", "INSTANCE", "END INSTANCE")
#: Cards by which bodies touch or are joined.
_JOINING = {
    "CONTACT", "CONTACT INCLUSIONS", "CONTACT PAIR", "TIE", "EQUATION", "MPC", "COUPLING", "KINEMATIC COUPLING",
    "DISTRIBUTING COUPLING", "RIGID BODY", "EMBEDDED ELEMENT", "CYCLIC SYMMETRY MODEL", "SHELL TO SOLID COUPLING",
}  # fmt: skip
#: Fields of the data lines that name nodes, by card.
_NODE_FIELDS = {
    "BOUNDARY": slice(1), "CLOAD": slice(1), "EQUATION": slice(None, None, 3), "MPC": slice(1, None),
    "DISTRIBUTING COUPLING": slice(1), "KINEMATIC COUPLING": slice(1),
}  # fmt: skip
#: Parameters that name a node.
_NODE_OPTIONS = ("REF NODE", "ROT NODE", "NODE", "CONTROL NODE")
#: Number that no node or element exceeds.
_LARGEST = 2**62
#: Nodes of all instances that are never too many; more need a file of as many bytes.
_ALWAYS_ALLOWED = 1_000_000


def read(path: Path) -> Mesh:
    """Read the mesh of an input file: the nodes, elements, sets and surfaces of all instances of its parts.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        For a malformed card, one that generates nodes or elements, or an included file that cannot be read.
    MeshError
        From `Mesh`.
    """
    deck = read_deck(path)
    return to_mesh(deck, *_Reader(deck).model())


def read_node_cards(deck: Deck) -> list[Instance]:
    """Read the placements of all instances, and last the assembly: an instance without a name.

    Of their parts, only `node_cards` are known.
    """
    reader = _Reader(deck)
    for card in deck.cards:
        if card.name == "NODE":
            reader.part.node_cards.append(card)
        elif card.name in _STRUCTURE:
            _CARDS[card.name](reader, card)
    return [*(replace(one, part=merged(one.part, one.own)) for one in reader.placed), Instance("", reader.assembly)]


class _Reader:
    """Model data of the cards read so far; the current card adds to `part`."""

    def __init__(self, deck: Deck):
        self.deck = deck
        self.assembly = Part("")
        self.parts: dict[str, Part] = {}
        self.instances: list[Instance] = []
        self.part = self.assembly
        self.other_cards = Counter()

    def model(self) -> tuple[list[Instance], Part, list[str], list[str]]:
        """Read all cards; return the instances, the assembly, notes, and the names of the cards in `_JOINING`."""
        for card in self.deck.cards:
            reader = _CARDS.get(card.name)
            if card.name in _GENERATING:
                problem = f"*{card.name} in {card.place} generates nodes or elements from others"
                raise self.deck.error(problem, _EXPAND)
            if reader is not None:
                reader(self, card)
            elif card.name not in _IGNORED:
                self.other_cards[card.name] += 1
                self._add_named_nodes(card)
        if not self.deck.cards:
            raise self.deck.error("has no line that begins with *", check_suffix("an Abaqus file"))
        notes = []
        if self.other_cards:
            names = some_names(f"*{quoted(name)[1:-1]}" for name in self.other_cards)
            notes.append(unread_note(f"keywords that define no mesh ({names})"))
        conditions = [f"*{name}" for name in _CONDITIONS if name in self.other_cards]
        if conditions:
            notes.append(f"Nodes named in {', '.join(conditions)} move with the mesh: these keywords fix no node.")
        instances = self.placed
        unused = sum(all(instance.part is not part for instance in instances) for part in self.parts.values())
        if unused:
            notes.append(unread_note(count_phrase(unused, "part without an instance", "parts without an instance")))
        instances = [replace(one, part=merged(one.part, one.own)) for one in instances]
        return instances, self.assembly, notes, sorted(self.other_cards.keys() & _JOINING)

    @property
    def placed(self) -> list[Instance]:
        """The instances; where there are none, all parts as they are."""
        return self.instances or [Instance(part.name, part) for part in self.parts.values()]

    def read_node(self, card: Card) -> None:
        """*NODE, NSET=..."""
        if card.options.get("SYSTEM", "R").upper() not in ("R", ""):
            raise self.deck.error(f"*NODE in {card.place} has other coordinates than x, y and z", _EXPAND)
        ids, points = card.deck.nodes(card)
        self.part.node_ids.append(ids)
        self.part.points.append(points)
        if "NSET" in card.options:
            _definition(self.part.node_sets, card.options["NSET"]).ids.append(ids)

    def _add_named_nodes(self, card: Card) -> None:
        """Add the nodes that a card which is not read needs, such as the reference node of *RIGID BODY."""
        words = [card.options.get(name, "") for name in _NODE_OPTIONS]
        if card.name in _NODE_FIELDS:
            words += [word for row in card.fields() for word in row[_NODE_FIELDS[card.name]]]
        self.part.named_nodes += [word for word in words if is_number(word)]

    def read_element(self, card: Card) -> None:
        """*ELEMENT, TYPE=..., ELSET=..."""
        elements = ElementCard.of(card)
        self.part.element_cards.append(elements)
        if "ELSET" in card.options:
            _definition(self.part.element_sets, card.options["ELSET"]).ids.append(elements.ids)

    def read_set(self, card: Card) -> None:
        """*NSET, NSET=..., GENERATE, INSTANCE=..., ELSET=...; or *ELSET, ELSET=..."""
        sets = self.part.node_sets if card.name == "NSET" else self.part.element_sets
        name = card.options.get(card.name, "")
        if not name:
            raise self.deck.error(f"*{card.name} in {card.place} has no name")
        definition = _definition(sets, name)
        if "INSTANCE" in card.options:
            instance = name_key(card.options["INSTANCE"])
            definition = definition.by_instance.setdefault(instance, SetDefinition(definition.title))
        if card.name == "NSET" and "ELSET" in card.options:
            definition.elements.append(card.options["ELSET"])
        for row in card.fields():
            if "GENERATE" not in card.options:
                definition.entries += [word for word in row if word]
                continue
            numbers = [int(word) for word in row if is_number(word)]
            if len(numbers) != len(row) or not 2 <= len(numbers) <= 3 or 0 in numbers[2:]:
                problem = f"*{card.name} in {card.place} holds {quoted(', '.join(row))}"
                raise self.deck.error(f"{problem}: expected first, last and step")
            definition.ranges.append((*numbers, 1)[:3])

    def read_surface(self, card: Card) -> None:
        """*SURFACE, NAME=..., TYPE=ELEMENT or NODE."""
        name, type = card.options.get("NAME", ""), card.options.get("TYPE", "ELEMENT").upper()
        if type == "NODE":
            _definition(self.part.node_surfaces, name).entries += [row[0] for row in card.fields() if row[0]]
        elif type == "ELEMENT":
            rows = self.part.surfaces.setdefault(unquoted(name), [])
            rows += [(row[0], (row[1:] or [""])[0].upper()) for row in card.fields() if row[0]]
        else:
            self.other_cards[card.name] += 1

    def read_part(self, card: Card) -> None:
        """*PART, NAME=..."""
        name = card.options.get("NAME", "")
        self.part = self.parts[name_key(name)] = Part(unquoted(name))

    def read_instance(self, card: Card) -> None:
        """*INSTANCE, NAME=, PART=, NSET=, ELSET=: the cards up to *END INSTANCE belong to the instance alone."""
        part = self.parts.get(name_key(card.options.get("PART", "")))
        if part is None:
            name = quoted(card.options.get("PART", ""))
            raise self.deck.error(f"*INSTANCE in {card.place} refers to the part {name}, which does not exist")
        self.part = Part(part.name)
        translation, rotation = placement(self.deck, card.fields())
        name = unquoted(card.options.get("NAME", ""))
        self.instances.append(Instance(name, part, translation, rotation, self.part))
        for option, sets in ("NSET", self.assembly.node_sets), ("ELSET", self.assembly.element_sets):
            if option in card.options:
                whole = _definition(sets, card.options[option]).by_instance
                whole[name_key(name)] = SetDefinition("", ranges=[(0, _LARGEST, 1)])
        n_nodes = sum(len(ids) for instance in self.instances for ids in instance.part.node_ids)
        if n_nodes > _ALWAYS_ALLOWED + len(self.deck.data):
            problem = f"its {len(self.instances)} instances have more nodes than a file of its size can define"
            raise self.deck.error(problem)

    def end(self, card: Card) -> None:
        """*END PART, *END INSTANCE: the next cards belong to the assembly."""
        self.part = self.assembly


def _definition(sets: dict[str, SetDefinition], name: str) -> SetDefinition:
    """Definition of the set of a name, new where there is none."""
    return sets.setdefault(name_key(name), SetDefinition(unquoted(name)))


_CARDS: dict[str, Callable[[_Reader, Card], None]] = {
    "NODE": _Reader.read_node, "ELEMENT": _Reader.read_element, "NSET": _Reader.read_set, "ELSET": _Reader.read_set,
    "SURFACE": _Reader.read_surface, "PART": _Reader.read_part, "INSTANCE": _Reader.read_instance,
    "END PART": _Reader.end, "END INSTANCE": _Reader.end,
}  # fmt: skip


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
        ids: dict[Card, np.ndarray] = {}
        for instance in instances:
            for card in instance.part.node_cards:
                if card not in self._rows:
                    ids[card], self._rows[card] = deck.nodes(card)
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
        fields = [self._deck.node_lines(card).fields(NODE_FIELDS) for card in cards]
        located = DeckCoordinates(self._deck.files, given, TextFields.joined(fields, slice(1, 4)))
        return located.write(files, target, rows)


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
