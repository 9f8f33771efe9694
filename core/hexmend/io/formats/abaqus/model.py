"""The parts and instances of an Abaqus file, and how they are joined into one mesh."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.io.base.cursor import quoted
from hexmend.io.formats.abaqus.deck import Deck
from hexmend.io.formats.abaqus.elements import width_of

#: Beside so many bytes of a file a set may have one member: what keeps a small file from filling the memory.
_MEMBERS_A_BYTE = 20


@dataclass(eq=False)
class Members:
    """What the lines of a set say, to be looked up once everything is read.

    Parameters
    ----------
    words : list of str
        Numbers and names of other sets.
    ranges : list of (first, last, step)
    ids : list of int arrays
        Those of the nodes or elements whose card names the set.
    within : mapping of an instance's key to Members
        What is said of a set with INSTANCE=.
    """

    title: str
    words: list[str] = field(default_factory=list)
    ranges: list[tuple[int, int, int]] = field(default_factory=list)
    ids: list[np.ndarray] = field(default_factory=list)
    within: dict[str, Members] = field(default_factory=dict)

    def joined(self, other: Members) -> Members:
        """A set of what both say."""
        lists = (self.words + other.words, self.ranges + other.ranges, self.ids + other.ids)
        return Members(self.title, *lists, _joined(self.within, other.within))


@dataclass(eq=False)
class Chunk:
    """Elements of one card; `kind` is None for those that are not read, whose numbers alone are known."""

    type: str
    kind: str | None
    ids: np.ndarray
    nodes: np.ndarray


@dataclass(eq=False)
class Part:
    """What stands between *PART and *END PART, between *INSTANCE and *END INSTANCE, or in a file without parts."""

    name: str
    node_ids: list[np.ndarray] = field(default_factory=list)
    points: list[np.ndarray] = field(default_factory=list)
    chunks: list[Chunk] = field(default_factory=list)
    node_sets: dict[str, Members] = field(default_factory=dict)
    element_sets: dict[str, Members] = field(default_factory=dict)
    #: Title of a surface to (element or set, side).
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=dict)

    def joined(self, other: Part) -> Part:
        """A part of what both say; what neither adds to is shared."""
        return Part(
            self.name,
            self.node_ids + other.node_ids,
            self.points + other.points,
            self.chunks + other.chunks,
            _joined(self.node_sets, other.node_sets),
            _joined(self.element_sets, other.element_sets),
            self.surfaces | {name: self.surfaces.get(name, []) + rows for name, rows in other.surfaces.items()},
        )


def _joined(one: dict[str, Members], other: dict[str, Members]) -> dict[str, Members]:
    return one | {key: one[key].joined(more) if key in one else more for key, more in other.items()}


@dataclass(eq=False)
class Instance:
    """A part and where it is put: points @ rotation.T + shift.

    Parameters
    ----------
    name : str
    part : Part
    shift : (3,) float64
    rotation : (3, 3) float64
    own : Part
        The nodes, elements, sets and surfaces that stand in the instance itself.
    """

    name: str
    part: Part
    shift: np.ndarray
    rotation: np.ndarray
    own: Part = field(default_factory=lambda: Part(""))


class Budget:
    """How many members all sets of a file may have together, so that a small file cannot fill the memory."""

    def __init__(self, deck: Deck):
        self.deck, self.left = deck, 1_000_000 + _MEMBERS_A_BYTE * len(deck.data)

    def spend(self, members: int) -> None:
        """Raise `FileError` where it is too much."""
        self.left -= members
        if self.left < 0:
            raise self.deck.error("its sets have far more members than so small a file can mean")


class Names:
    """Looks up numbers and names of sets of one instance, or of what stands outside of all.

    Parameters
    ----------
    deck : Deck
    ids : (n,) int64
        What may be a member, from place `first` on.
    sets : mapping of key to Members
    first : int
    budget : Budget
    instances : mapping of key to Names
    """

    def __init__(
        self,
        deck: Deck,
        ids: np.ndarray,
        sets: dict[str, Members],
        first: int,
        budget: Budget,
        instances: dict[str, Names] | None = None,
    ):
        self.deck, self.sets, self.budget, self.instances = deck, sets, budget, instances or {}
        self.order = np.argsort(ids, kind="stable") + first
        self.ids = np.sort(ids)
        self.unknown = 0
        self._known: dict[str, np.ndarray] = {}

    def of(self, word: str, within: tuple[str, ...] = ()) -> np.ndarray:
        """Places that a word means: a number, the name of a set, or either of an instance."""
        if _is_number(word):
            return self._of_numbers(np.array([int(word)]))
        if key_of(word) not in self.sets and "." in word:
            instance, _, rest = word.partition(".")
            if key_of(instance) in self.instances:
                return self.instances[key_of(instance)].of(rest)
        return self.set_named(key_of(word), within)

    def set_named(self, key: str, within: tuple[str, ...] = ()) -> np.ndarray:
        """Places of the members of a set, in order and each once."""
        if key not in self._known:
            if key not in self.sets:
                raise self.deck.error(f"names the set {quoted(key)}, which is not there")
            if key in within or len(within) > 100:
                raise self.deck.error(f"the set {quoted(key)} is a member of itself")
            self._known[key] = self.members(self.sets[key], (*within, key))
        return self._known[key]

    def members(self, members: Members, within: tuple[str, ...] = ()) -> np.ndarray:
        """Places of what the lines of a set say, in order and each once."""
        numbers = np.array([int(word) for word in members.words if _is_number(word)], np.int64)
        found = [self._of_numbers(np.concatenate([numbers, *members.ids]))]
        for first, last, step in dict.fromkeys(members.ranges):
            begin, end = np.searchsorted(self.ids, [first, last + 1])
            found.append(self.order[begin:end][(self.ids[begin:end] - first) % step == 0])
            self.budget.spend(len(found[-1]))
        for word in dict.fromkeys(members.words):
            if not _is_number(word):
                found.append(self.of(word, within))
                self.budget.spend(len(found[-1]))
        for instance, lines in members.within.items():
            if instance not in self.instances:
                raise self.deck.error(f"a set is of the instance {quoted(instance)}, which is not there")
            found.append(self.instances[instance].members(lines))
        places = np.unique(np.concatenate(found))
        self.budget.spend(len(places))
        return places

    def _of_numbers(self, wanted: np.ndarray) -> np.ndarray:
        """Places of numbers; those that do not exist are counted and passed over."""
        if not len(self.ids):
            self.unknown += len(wanted)
            return np.zeros(0, np.int64)
        at = np.minimum(np.searchsorted(self.ids, wanted), len(self.ids) - 1)
        right = self.ids[at] == wanted
        self.unknown += int((~right).sum())
        return self.order[at[right]]


def _is_number(word: str) -> bool:
    return word.isascii() and word.isdigit() and len(word) < 19


def key_of(name: str) -> str:
    """What names are compared by: quoted as they are, others in upper case."""
    name = name.strip()
    return name[1:-1] if len(name) > 1 and name[0] == name[-1] == '"' else name.upper()


def title_of(name: str) -> str:
    """A name for a message."""
    return name.strip().strip('"')


def moved(deck: Deck, rows: list[list[str]]) -> tuple[np.ndarray, np.ndarray]:
    """Shift (3,) and rotation (3, 3) of an instance: a line of a translation, and one of two points and an angle."""
    try:
        values = [[float(word) if word else 0.0 for word in row] for row in rows[:2]]
    except ValueError:
        raise deck.error("an *INSTANCE has a line that holds something else than numbers") from None
    shift, rotation = np.zeros(3), np.eye(3)
    if values:
        shift[: len(values[0][:3])] = values[0][:3]
    if len(values) > 1:
        if len(values[1]) != 7:
            raise deck.error(f"an *INSTANCE is turned by {len(values[1])} numbers: expected two points and an angle")
        begin, end, angle = np.array(values[1][:3]), np.array(values[1][3:6]), np.deg2rad(values[1][6])
        axis = end - begin
        length = np.linalg.norm(axis)
        if not (np.isfinite(values[1]).all() and length > 0):
            raise deck.error("an *INSTANCE is turned about an axis without a direction")
        x, y, z = axis / length
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        rotation = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        shift = rotation @ (shift - begin) + begin  # the translation comes first
    return shift, rotation


def chunk_of(deck: Deck, card_rows: np.ndarray, type: str, kind: str, line: int) -> Chunk:
    """Elements of all numbers of a card."""
    width = 1 + width_of(kind)
    if card_rows.size % width:
        raise deck.error(
            f"*ELEMENT of type {quoted(type)} in line {line} holds {card_rows.size} numbers: "
            f"expected {width} an element, its number and {width - 1} nodes",
            "Write the file again with the program that made it: it is damaged or cut short.",
        )
    rows = card_rows.reshape(-1, width)
    return Chunk(type, kind, rows[:, 0].copy(), rows[:, 1:])
