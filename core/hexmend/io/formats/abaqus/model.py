"""Parts and instances of an Abaqus file."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.io.base.cell_kinds import node_count
from hexmend.io.base.cursor import quoted
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.abaqus.deck import Card, Deck
from hexmend.io.formats.abaqus.sets import SetDefinition, merged_sets


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


@dataclass(eq=False)
class Part:
    """Model data of a *PART, of an *INSTANCE itself, or of the lines outside of both (the assembly, or a flat file)."""

    name: str
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


def element_card(deck: Deck, card: Card, type: str, kind: str) -> ElementCard:
    """Elements of a card whose type is known.

    Raises
    ------
    FileError
        Unless its numbers are those of whole elements.
    """
    numbers = deck.numbers(card, "*ELEMENT", np.int64)
    width = 1 + node_count(kind)
    if numbers.size % width:
        problem = f"*ELEMENT of type {quoted(type)} in {deck.place(card)} holds {numbers.size} numbers"
        raise deck.error(f"{problem}: expected {width} an element, its number and {width - 1} nodes", DAMAGED)
    rows = numbers.reshape(-1, width)
    return ElementCard(type, kind, rows[:, 0].copy(), rows[:, 1:])
