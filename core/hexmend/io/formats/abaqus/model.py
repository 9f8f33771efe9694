"""Parts and instances of an Abaqus file.

Sets of an Abaqus file: their definitions, and the members that they have once everything is read.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import TypeVar

import numpy as np

from hexmend.io.base.content import node_count
from hexmend.io.base.cursor import is_number, quoted
from hexmend.io.base.numbering import lookup
from hexmend.io.base.remedies import MemoryBudget
from hexmend.io.formats.abaqus.deck import Card, Deck
from hexmend.io.formats.abaqus.elements import kind_of

T = TypeVar("T")

#: Levels of sets that are members of sets.
_MAX_DEPTH = 100


def name_key(name: str) -> str:
    """Key by which names are compared: quoted names as they are, others in upper case."""
    name = name.strip()
    return name[1:-1] if len(name) > 1 and name[0] == name[-1] == '"' else name.upper()


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
    elements : list of str
        Names of element sets whose nodes are members.
    by_instance : mapping of str to SetDefinition
        Data lines under INSTANCE=, by the instance's key.
    """

    title: str
    entries: list[str] = field(default_factory=list)
    ranges: list[tuple[int, int, int]] = field(default_factory=list)
    ids: list[np.ndarray] = field(default_factory=list)
    elements: list[str] = field(default_factory=list)
    by_instance: dict[str, SetDefinition] = field(default_factory=dict)


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
    nodes_of : callable, optional
        nodes_of(entry) returns the positions of the nodes of an element set; of node sets.

    Attributes
    ----------
    n_unknown : int
        Members that do not exist in the file.
    unknown_sets : set of str
        Keys of sets and instances that do not exist in the file.
    """

    def __init__(
        self,
        deck: Deck,
        ids: np.ndarray,
        sets: dict[str, SetDefinition],
        first: int,
        budget: MemoryBudget,
        instances: Mapping[str, SetLookup] | None = None,
        nodes_of: Callable[[str], np.ndarray] | None = None,
    ):
        self.deck, self.sets, self.budget, self.instances = deck, sets, budget, instances or {}
        self.nodes_of, self.unknown_sets = nodes_of, set[str]()
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
                self.unknown_sets.add(key)
                return np.zeros(0, np.int64)
            if key in parents or len(parents) > _MAX_DEPTH:
                raise self.deck.error(f"the set {quoted(key)} is a member of itself")
            self._members[key] = self.evaluate(self.sets[key], (*parents, key))
        return self._members[key]

    def evaluate(self, definition: SetDefinition, parents: tuple[str, ...] = ()) -> np.ndarray:
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
        found += [self.nodes_of(name) for name in definition.elements if self.nodes_of]
        for instance, lines in definition.by_instance.items():
            if instance in self.instances:
                found.append(self.instances[instance].evaluate(lines))
            else:
                self.unknown_sets.add(instance)
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
        Kind of cell; None for types that are not read.
    ids : (k,) int64
    nodes : (k, width) int64
        Numbers of nodes, in Abaqus's order; of types that are not read -1 behind the last.
    n_longer : int
        Elements whose lines hold more numbers.
    """

    type: str
    kind: str | None
    ids: np.ndarray
    nodes: np.ndarray
    n_longer: int = 0

    @classmethod
    def of(cls, card: Card) -> ElementCard:
        """Elements of a card; raises `FileError` for one that has too few nodes for its type."""
        type = card.options.get("TYPE", "").upper()
        kind = kind_of(type)
        if kind is not None:
            rows, n_longer = card.deck.element_rows(card, 1 + node_count(kind))
            return cls(type, kind, rows[:, 0].copy(), rows[:, 1:], n_longer)
        lists, continued = [], False  # a line continues one that ends in a comma
        for line in card.lines():
            words = [word.strip() for word in line.split(",")]
            numbers = [int(word) for word in words if is_number(word)]
            if continued and lists:
                lists[-1] += numbers
            elif is_number(words[0]):
                lists.append(numbers)
            continued = line.endswith(",")
        rows = np.full((len(lists), max(map(len, lists), default=1)), -1, np.int64)
        for row, numbers in zip(rows, lists, strict=True):
            row[: len(numbers)] = numbers
        return cls(type, None, rows[:, 0].copy(), rows[:, 1:])


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
    node_surfaces: dict[str, SetDefinition] = field(default_factory=dict)
    #: Numbers of nodes, and names of node sets, in cards that are not read.
    named_nodes: list[str] = field(default_factory=list)
    #: Entries (element or set, face identifier) of each surface by name.
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=dict)

    def last_given(self) -> np.ndarray:
        """True for the nodes whose number no later line gives again, (n,) bool."""
        ids = np.concatenate([*self.node_ids, np.zeros(0, np.int64)])
        last = np.ones(len(ids), dtype=bool)
        if (np.diff(ids) <= 0).any():
            last[:] = False
            last[len(ids) - 1 - np.unique(ids[::-1], return_index=True)[1]] = True
        return last


def merged(first: T, second: T) -> T:
    """Merge two parts, or what they hold: lists one behind the other, tables key by key; the first gives the name."""
    if isinstance(first, list):
        return first + second
    if isinstance(first, dict):
        return first | {key: merged(first[key], more) if key in first else more for key, more in second.items()}
    if isinstance(first, Part | SetDefinition):
        return type(first)(*(merged(getattr(first, one.name), getattr(second, one.name)) for one in fields(first)))
    return first


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
