"""Reads the cards of an Abaqus or CalculiX file that say something of the mesh."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.formats.abaqus.content import to_mesh
from hexmend.io.formats.abaqus.deck import Card, Deck
from hexmend.io.formats.abaqus.elements import kind_of
from hexmend.io.formats.abaqus.model import Chunk, Instance, Members, Part, chunk_of, key_of, moved, title_of
from hexmend.mesh.mesh import Mesh

#: Cards that make nodes or elements out of others.
_GENERATING = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "SUBMODEL")
_EXPAND = "Write the file with all nodes and elements expanded, as Abaqus/CAE does."
#: Cards that are of the mesh but say nothing that is kept.
_PASSED_OVER = ("HEADING", "PREPRINT", "ASSEMBLY", "END ASSEMBLY")


def read(path: Path) -> Mesh:
    """Read the mesh of an input file: its nodes, elements, sets and surfaces, of all instances of its parts."""
    deck = Deck(path, read_text_bytes(path))
    return to_mesh(deck, *Reader(deck).model())


class Reader:
    """Goes through the cards and gathers what they say."""

    def __init__(self, deck: Deck):
        self.deck = deck
        self.flat = Part("")
        self.parts: dict[str, Part] = {}
        self.instances: list[Instance] = []
        self.part = self.flat
        self.other: dict[str, int] = {}

    def model(self) -> tuple[list[Instance], Part, list[str]]:
        """The instances, what stands outside of them, and notes."""
        count = 0
        for card in self.deck.cards():
            count += 1
            reader = _CARDS.get(card.name)
            if card.name in _GENERATING or card.name == "INCLUDE" or (reader and "INPUT" in card.options):
                self._refuse(card)
            elif reader is not None:
                reader(self, card)
            elif card.name not in _PASSED_OVER:
                self.other[card.name] = self.other.get(card.name, 0) + 1
        if not count:
            raise self.deck.error("has no line that begins with *", "Is it an Abaqus file? Check its suffix.")
        notes = []
        if self.other:
            names = ", ".join(f"*{quoted(name)[1:-1]}" for name in list(self.other)[:6])
            more = "" if len(self.other) <= 6 else f" and {len(self.other) - 6} others"
            notes.append(f"What is no mesh ({names}{more}) is left out.")
        placed = self.instances
        if not placed:
            placed = [Instance(part.name, part, np.zeros(3), np.eye(3)) for part in self.parts.values()]
        left = sum(all(one.part is not part for one in placed) for part in self.parts.values())
        if left:
            notes.append(f"{left} part{'s' * (left > 1)} without an instance {'are' if left > 1 else 'is'} left out.")
        return [replace(one, part=one.part.joined(one.own)) for one in placed], self.flat, notes

    def _refuse(self, card: Card) -> None:
        if card.name == "INCLUDE" or "INPUT" in card.options:
            where = quoted(card.options.get("INPUT", ""))
            raise self.deck.error(
                f"*{card.name} in line {card.line} takes what follows from another file, {where}",
                "Put its content in the place of the line: one file is read at a time.",
            )
        raise self.deck.error(f"*{card.name} in line {card.line} makes nodes or elements out of others", _EXPAND)

    def read_node(self, card: Card) -> None:
        """*NODE, NSET=..."""
        if card.options.get("SYSTEM", "R").upper() not in ("R", ""):
            raise self.deck.error(f"*NODE in line {card.line} has other coordinates than x, y and z", _EXPAND)
        ids, points = self.deck.nodes(card)
        self.part.node_ids.append(ids)
        self.part.points.append(points)
        if "NSET" in card.options:
            _entry(self.part.node_sets, card.options["NSET"]).ids.append(ids)

    def read_element(self, card: Card) -> None:
        """*ELEMENT, TYPE=..., ELSET=..."""
        type = card.options.get("TYPE", "").upper()
        kind = kind_of(type)
        if kind is None:
            ids, goes_on = [], False
            for fields, line in zip(self.deck.rows(card), self._lines(card), strict=True):
                if not goes_on and fields[0].isascii() and fields[0].isdigit() and len(fields[0]) < 19:
                    ids.append(int(fields[0]))
                goes_on = line.endswith(",")
            chunk = Chunk(type, None, np.array(ids, np.int64), np.zeros((len(ids), 0), np.int64))
        else:
            chunk = chunk_of(self.deck, self.deck.numbers(card, "*ELEMENT", np.int64), type, kind, card.line)
        self.part.chunks.append(chunk)
        if "ELSET" in card.options:
            _entry(self.part.element_sets, card.options["ELSET"]).ids.append(chunk.ids)

    def read_node_set(self, card: Card) -> None:
        """*NSET, NSET=..., GENERATE, INSTANCE=..."""
        self._read_set(card, "NSET", self.part.node_sets)

    def read_element_set(self, card: Card) -> None:
        """*ELSET, ELSET=..., GENERATE, INSTANCE=..."""
        self._read_set(card, "ELSET", self.part.element_sets)

    def _read_set(self, card: Card, option: str, sets: dict[str, Members]) -> None:
        name = card.options.get(option, "")
        if not name:
            raise self.deck.error(f"*{card.name} in line {card.line} has no name")
        members = _entry(sets, name)
        if "INSTANCE" in card.options:
            members = members.within.setdefault(key_of(card.options["INSTANCE"]), Members(members.title))
        for row in self.deck.rows(card):
            if "GENERATE" not in card.options:
                members.words += [word for word in row if word]
                continue
            numbers = [int(word) for word in row if word.isascii() and word.isdigit() and len(word) < 19]
            if len(numbers) != len(row) or not 2 <= len(numbers) <= 3 or 0 in numbers[2:]:
                raise self.deck.error(
                    f"*{card.name} in line {card.line} holds {quoted(', '.join(row))}: expected first, last and step"
                )
            members.ranges.append((*numbers, 1)[:3])

    def read_surface(self, card: Card) -> None:
        """*SURFACE, NAME=..., TYPE=ELEMENT or NODE."""
        name, type = card.options.get("NAME", ""), card.options.get("TYPE", "ELEMENT").upper()
        if type == "NODE":
            members = _entry(self.part.node_sets, name)
            members.words += [row[0] for row in self.deck.rows(card) if row and row[0]]
        elif type == "ELEMENT":
            rows = self.part.surfaces.setdefault(title_of(name), [])
            rows += [(row[0], (row[1:] or [""])[0].upper()) for row in self.deck.rows(card) if row and row[0]]
        else:
            self.other[card.name] = self.other.get(card.name, 0) + 1

    def read_part(self, card: Card) -> None:
        """*PART, NAME=..."""
        name = card.options.get("NAME", "")
        self.part = self.parts[key_of(name)] = Part(title_of(name))

    def read_instance(self, card: Card) -> None:
        """*INSTANCE, NAME=..., PART=...: what follows up to *END INSTANCE belongs to the instance alone."""
        part = self.parts.get(key_of(card.options.get("PART", "")))
        if part is None:
            name = quoted(card.options.get("PART", ""))
            raise self.deck.error(f"*INSTANCE in line {card.line} is of the part {name}, which is not there")
        self.part = Part(part.name)
        self.instances.append(
            Instance(title_of(card.options.get("NAME", "")), part, *moved(self.deck, self.deck.rows(card)), self.part)
        )
        nodes = sum(len(ids) for one in self.instances for ids in one.part.node_ids)
        if nodes > 1_000_000 + len(self.deck.data):
            raise self.deck.error(f"its {len(self.instances)} instances have more nodes than so small a file can mean")

    def end(self, card: Card) -> None:
        """*END PART, *END INSTANCE: what follows belongs to the assembly."""
        self.part = self.flat

    def _lines(self, card: Card) -> list[str]:
        text = self.deck.data[card.begin : card.end].decode("utf-8", errors="replace")
        return [line.strip() for line in text.split("\n") if line.strip()]


def _entry(sets: dict[str, Members], name: str) -> Members:
    return sets.setdefault(key_of(name), Members(title_of(name)))


_CARDS: dict[str, Callable[[Reader, Card], None]] = {
    "NODE": Reader.read_node,
    "ELEMENT": Reader.read_element,
    "NSET": Reader.read_node_set,
    "ELSET": Reader.read_element_set,
    "SURFACE": Reader.read_surface,
    "PART": Reader.read_part,
    "INSTANCE": Reader.read_instance,
    "END PART": Reader.end,
    "END INSTANCE": Reader.end,
}
