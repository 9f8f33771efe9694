"""Parts and instances of an Abaqus file.

Sets of an Abaqus file: their definitions, and the members that they have once everything is read.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from hexmend.io.base.content import node_count
from hexmend.io.base.cursor import is_number, quoted
from hexmend.io.base.memory_budget import MemoryBudget
from hexmend.io.base.numbering import lookup
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.abaqus.deck import Card, Deck

#: Levels of sets that are members of sets.
_MAX_DEPTH = 100


def name_key(name: str) -> str:
    """Key by which names are compared: quoted names as they are, others in upper case."""
    name = name.strip()
    return name[1:-1] if len(name) > 1 and name[0] == name[-1] == '"' else name.upper()


def unquoted(name: str) -> str:
    """Name without the quotes around it."""
    return name.strip().strip('"')


@dataclass(eq=False)
class SetDefinition:
    """Data lines of a set, whose members are looked up once everything is read.

    Parameters
    ----------
    title : str
        Name of the set as the file has it, without quotes.
    entries : list of str
        Numbers of members and names of other sets.
    ranges : list of (first, last, step)
        Data lines of GENERATE.
    ids : list of (k,) int64 arrays
        Numbers of the nodes or elements whose card names the set.
    by_instance : mapping of str to SetDefinition
        Data lines under INSTANCE=, by the instance's key.
    """

    title: str
    entries: list[str] = field(default_factory=list)
    ranges: list[tuple[int, int, int]] = field(default_factory=list)
    ids: list[np.ndarray] = field(default_factory=list)
    by_instance: dict[str, SetDefinition] = field(default_factory=dict)

    def merged(self, other: SetDefinition) -> SetDefinition:
        """Return a definition with the lines of both."""
        lists = (self.entries + other.entries, self.ranges + other.ranges, self.ids + other.ids)
        return SetDefinition(self.title, *lists, merged_sets(self.by_instance, other.by_instance))


def merged_sets(first: dict[str, SetDefinition], second: dict[str, SetDefinition]) -> dict[str, SetDefinition]:
    """Merge two tables of definitions by key."""
    return first | {key: first[key].merged(more) if key in first else more for key, more in second.items()}


class SetLookup:
    """Members of the sets of one instance, or of the assembly, as positions among all nodes or elements.

    Parameters
    ----------
    deck : Deck
    ids : (n,) int64
        Numbers of the instance's nodes or elements.
    sets : mapping of str to SetDefinition
        By key.
    first : int
        Position of the first of `ids`.
    budget : MemoryBudget
    instances : mapping of str to SetLookup, optional
        Lookups of the instances that sets of the assembly may name, by key.

    Attributes
    ----------
    n_unknown : int
        Members that do not exist in the file.
    """

    def __init__(
        self,
        deck: Deck,
        ids: np.ndarray,
        sets: dict[str, SetDefinition],
        first: int,
        budget: MemoryBudget,
        instances: Mapping[str, SetLookup] | None = None,
    ):
        self.deck, self.sets, self.budget, self.instances = deck, sets, budget, instances or {}
        self.order = np.argsort(ids, kind="stable") + first
        self.ids = np.sort(ids)
        self.n_unknown = 0
        self._members: dict[str, np.ndarray] = {}

    def resolve(self, entry: str, parents: tuple[str, ...] = ()) -> np.ndarray:
        """Positions of an entry, (k,) int64: a number, the name of a set, or either after an instance and a point."""
        if is_number(entry):
            return self._positions(np.array([int(entry)]))
        if name_key(entry) not in self.sets and "." in entry:
            instance, _, rest = entry.partition(".")
            if name_key(instance) in self.instances:
                return self.instances[name_key(instance)].resolve(rest)
        return self.members(name_key(entry), parents)

    def members(self, key: str, parents: tuple[str, ...] = ()) -> np.ndarray:
        """Positions of the members of a set, (k,) int64 ascending; `parents` are the sets whose entry it is."""
        if key not in self._members:
            if key not in self.sets:
                raise self.deck.error(f"refers to the set {quoted(key)}, which does not exist")
            if key in parents or len(parents) > _MAX_DEPTH:
                raise self.deck.error(f"the set {quoted(key)} is a member of itself")
            self._members[key] = self._evaluate(self.sets[key], (*parents, key))
        return self._members[key]

    def _evaluate(self, definition: SetDefinition, parents: tuple[str, ...] = ()) -> np.ndarray:
        """Positions of the members that a definition lists, ascending."""
        numbers = np.array([int(entry) for entry in definition.entries if is_number(entry)], np.int64)
        found = [self._positions(np.concatenate([numbers, *definition.ids]))]
        for first, last, step in dict.fromkeys(definition.ranges):
            begin, end = np.searchsorted(self.ids, [first, last + 1])
            found.append(self.order[begin:end][(self.ids[begin:end] - first) % step == 0])
            self.budget.charge(found[-1].nbytes, "its sets")
        for entry in dict.fromkeys(definition.entries):
            if not is_number(entry):
                found.append(self.resolve(entry, parents))
                self.budget.charge(found[-1].nbytes, "its sets")
        for instance, lines in definition.by_instance.items():
            if instance not in self.instances:
                raise self.deck.error(f"a set refers to the instance {quoted(instance)}, which does not exist")
            found.append(self.instances[instance]._evaluate(lines))
        positions = np.unique(np.concatenate(found))
        self.budget.charge(positions.nbytes, "its sets")
        return positions

    def _positions(self, numbers: np.ndarray) -> np.ndarray:
        """Positions of the numbers that exist; the others are counted."""
        at, exists = lookup(self.ids, numbers, np.arange(len(self.ids)))
        self.n_unknown += int((~exists).sum())
        return self.order[at[exists]]


@dataclass(eq=False)
class ElementCard:
    """Elements of one *ELEMENT card.

    Parameters
    ----------
    type : str
        Element type, such as "C3D8R".
    kind : str or None
        Kind of cell; None for types that are not read, of which only the numbers are known.
    ids : (k,) int64
    nodes : (k, width) int64
        Numbers of nodes, in Abaqus's order.
    """

    type: str
    kind: str | None
    ids: np.ndarray
    nodes: np.ndarray

    @classmethod
    def of(cls, deck: Deck, card: Card, type: str, kind: str) -> ElementCard:
        """Elements of a card whose type is known.

        Raises
        ------
        FileError
            Unless its numbers are those of whole elements.
        """
        numbers = card.deck.numbers(card, "*ELEMENT", np.int64)
        width = 1 + node_count(kind)
        if numbers.size % width:
            problem = f"*ELEMENT of type {quoted(type)} in {card.place} holds {numbers.size} numbers"
            raise deck.error(f"{problem}: expected {width} an element, its number and {width - 1} nodes", DAMAGED)
        rows = numbers.reshape(-1, width)
        return cls(type, kind, rows[:, 0].copy(), rows[:, 1:])


@dataclass(eq=False)
class Part:
    """Model data of a *PART, of an *INSTANCE itself, or of the lines outside of both (the assembly, or a flat file)."""

    name: str
    #: *NODE cards that were not parsed, see `reader.read_node_cards`.
    node_cards: list[Card] = field(default_factory=list)
    node_ids: list[np.ndarray] = field(default_factory=list)
    points: list[np.ndarray] = field(default_factory=list)
    element_cards: list[ElementCard] = field(default_factory=list)
    node_sets: dict[str, SetDefinition] = field(default_factory=dict)
    element_sets: dict[str, SetDefinition] = field(default_factory=dict)
    #: Entries (element or set, face identifier) of each surface by name.
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=dict)

    def merged(self, other: Part) -> Part:
        """Return a part with the data of both."""
        return Part(
            self.name,
            self.node_cards + other.node_cards,
            self.node_ids + other.node_ids,
            self.points + other.points,
            self.element_cards + other.element_cards,
            merged_sets(self.node_sets, other.node_sets),
            merged_sets(self.element_sets, other.element_sets),
            self.surfaces | {name: self.surfaces.get(name, []) + rows for name, rows in other.surfaces.items()},
        )


@dataclass(eq=False)
class Instance:
    """A part and its placement: points @ rotation.T + translation.

    Parameters
    ----------
    name : str
        Empty for the assembly.
    part : Part
    translation : (3,) float64
    rotation : (3, 3) float64
    own : Part
        Nodes, elements, sets and surfaces between *INSTANCE and *END INSTANCE.
    """

    name: str
    part: Part
    translation: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))
    own: Part = field(default_factory=lambda: Part(""))

    def points(self) -> np.ndarray:
        """Coordinates of the instance's nodes in the assembly, (n, 3) float64."""
        points = np.concatenate([*self.part.points, np.zeros((0, 3))])
        if np.array_equal(self.rotation, np.eye(3)):  # exact coordinates where nothing moves them
            return points + self.translation if self.translation.any() else points
        return points @ self.rotation.T + self.translation


def placement(deck: Deck, lines: list[list[str]]) -> tuple[np.ndarray, np.ndarray]:
    """Translation (3,) and rotation (3, 3) of an instance.

    Parameters
    ----------
    deck : Deck
    lines : list of list of str
        Fields of the data lines of *INSTANCE: a translation, then two points of an axis and an angle in degrees.

    Raises
    ------
    FileError
        For fields that are not numbers, or an axis without a direction.
    """
    try:
        values = [[float(word) if word else 0.0 for word in line] for line in lines[:2]]
    except ValueError:
        raise deck.error("an *INSTANCE has a data line with other words than numbers") from None
    translation, rotation = np.zeros(3), np.eye(3)
    if values:
        translation[: len(values[0][:3])] = values[0][:3]
    if len(values) > 1:
        if len(values[1]) != 7:
            problem = f"an *INSTANCE has a rotation of {len(values[1])} numbers"
            raise deck.error(f"{problem}: expected two points and an angle")
        begin, end, angle = np.array(values[1][:3]), np.array(values[1][3:6]), np.deg2rad(values[1][6])
        axis = end - begin
        length = np.linalg.norm(axis)
        if not (np.isfinite(values[1]).all() and length > 0):
            raise deck.error("an *INSTANCE has a rotation about an axis without a direction")
        x, y, z = axis / length
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        rotation = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross  # Rodrigues's formula
        translation = rotation @ (translation - begin) + begin  # the translation comes before the rotation
    return translation, rotation
