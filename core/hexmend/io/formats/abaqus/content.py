"""The mesh that the instances of an Abaqus file make together."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.content import HEX_KINDS, ID, Block, Content
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted
from hexmend.io.base.numbering import find_ids
from hexmend.io.formats.abaqus.deck import Deck
from hexmend.io.formats.abaqus.elements import FACE_OF_SIDE, ORDER
from hexmend.io.formats.abaqus.model import Budget, Instance, Members, Names, Part, key_of
from hexmend.mesh.mesh import Mesh

#: Data of cells: the place of their type in the list of this name among the field data.
TYPE = "abaqus:type"
TYPES = "abaqus:types"


def to_mesh(deck: Deck, placed: list[Instance], top: Part, notes: list[str]) -> Mesh:
    """The mesh of instances and of what stands outside of them."""
    outside = Instance("", top, np.zeros(3), np.eye(3))
    every = [*placed, outside]
    ids = [_joined(one.part.node_ids) for one in every]
    if not sum(map(len, ids)):
        raise deck.error("has no *NODE", "Is it an Abaqus file? Check its suffix.")
    points = np.concatenate([_points(one) for one in every])
    if len(placed) > 1:
        notes.append(f"{len(placed)} instances ({', '.join(one.name for one in placed[:5])}...) are read as one mesh.")
    joined = _Elements(deck, every, ids)
    unread: dict[str, int] = {}
    for chunk in (chunk for one in every for chunk in one.part.chunks if chunk.kind is None):
        unread[chunk.type] = unread.get(chunk.type, 0) + len(chunk.ids)
    if unread:
        types = ", ".join(sorted(unread)[:6])
        notes.append(f"{sum(unread.values()):,} elements of other types ({types}) are left out.")

    budget = Budget(deck)
    nodes = _names(deck, every, ids, "node_sets", budget)
    elements = _names(deck, every, joined.ids, "element_sets", budget)
    prefix = len(placed) > 1
    node_sets = dict(_sets(every, nodes, "node_sets", prefix))
    element_sets = dict(_sets(every, elements, "element_sets", prefix))
    side_sets, other_faces = _side_sets(every, elements, joined, prefix)
    if other_faces:
        notes.append(f"{other_faces:,} entries of surfaces that are not faces S1 to S6 of hexes are left out.")
    unknown = sum(one.unknown for one in (*nodes, *elements))
    if unknown:
        notes.append(f"{unknown:,} members of sets that do not exist in the file are passed over.")
    content = Content(
        points,
        tuple(joined.blocks(element_sets)),
        {ID: np.concatenate(ids)},
        node_sets,
        side_sets,
        field_data={TYPES: joined.types} if joined.types else {},
        notes=tuple(notes),
        unread={f"type {quoted(type)}": count for type, count in unread.items()},
    )
    return mesh_of(deck.path, content)


class _Elements:
    """The elements of all instances, one after the other.

    Attributes
    ----------
    ids : list of (k,) int64
        Numbers, an array an instance.
    types : list of str
    kind : (n,) int
        The place of each element's kind in `kinds`; -1 where it is not read.
    place : (n,) int
        Its place among those of its kind.
    """

    def __init__(self, deck: Deck, every: list[Instance], node_ids: list[np.ndarray]):
        chunks = [chunk for one in every for chunk in one.part.chunks]
        first = np.concatenate([[0], np.cumsum([len(one) for one in node_ids])])
        kinds = dict.fromkeys(chunk.kind for chunk in chunks if chunk.kind)
        self.kinds = sorted(kinds, key=lambda kind: kind not in HEX_KINDS)
        self.types = list(dict.fromkeys(chunk.type for chunk in chunks if chunk.kind))
        self.ids = [_joined([chunk.ids for chunk in one.part.chunks]) for one in every]
        self.rows: dict[str, list[np.ndarray]] = {kind: [] for kind in self.kinds}
        type_of = {name: np.array([k]) for k, name in enumerate(self.types)}
        counts = dict.fromkeys(self.kinds, 0)
        kind, place, type = [], [], []
        for k, one in enumerate(every):
            for chunk in one.part.chunks:
                many = len(chunk.ids)
                kind.append(np.full(many, self.kinds.index(chunk.kind) if chunk.kind else -1))
                place.append(np.arange(many) + counts.get(chunk.kind, 0))
                type.append(np.repeat(type_of.get(chunk.type, [-1]), many))
                if chunk.kind:
                    counts[chunk.kind] += many
                    nodes = find_ids(deck.path, node_ids[k], chunk.nodes, "node") + first[k]
                    self.rows[chunk.kind].append(nodes[:, ORDER[chunk.kind]] if chunk.kind in ORDER else nodes)
        self.kind, self.place, self.type = _joined(kind), _joined(place), _joined(type)
        self.counts = counts

    def blocks(self, sets: dict[str, np.ndarray]) -> list[Block]:
        """One block a kind, each with its share of the sets."""
        ids, answer = _joined(self.ids), []
        parted: dict[str, dict[str, np.ndarray]] = {kind: {} for kind in self.kinds}
        for name, members in sets.items():
            for k in np.unique(self.kind[members]):
                if k >= 0:
                    parted[self.kinds[k]][name] = self.place[members[self.kind[members] == k]]
        for k, kind in enumerate(self.kinds):
            own = self.kind == k
            data = {ID: ids[own], TYPE: self.type[own]}
            answer.append(Block(kind, np.concatenate(self.rows[kind]), data, parted[kind]))
        return answer

    def hexes(self, members: np.ndarray) -> np.ndarray:
        """Numbers of hexes, counted through their kinds; -1 for others."""
        first, answer = 0, np.full(len(members), -1)
        for k, kind in enumerate(self.kinds):
            if kind in HEX_KINDS:
                own = self.kind[members] == k
                answer[own] = self.place[members[own]] + first
                first += self.counts[kind]
        return answer


def _names(deck: Deck, every: list[Instance], ids: list[np.ndarray], kind: str, budget: Budget) -> list[Names]:
    """What looks up names: one an instance, and the last for what stands outside, which knows the others."""
    first = np.concatenate([[0], np.cumsum([len(one) for one in ids])])
    found: list[Names] = []
    for k, one in enumerate(every):
        known = (
            {key_of(other.name): names for other, names in zip(every, found, strict=False)}
            if k == len(every) - 1
            else {}
        )
        found.append(Names(deck, ids[k], getattr(one.part, kind), int(first[k]), budget, known))
    return found


def _sets(every: list[Instance], names: list[Names], kind: str, prefix: bool) -> list[tuple[str, np.ndarray]]:
    """Titles and members of all sets; of several instances each set has its instance's name before its own."""
    found = []
    for one, lookup in zip(every, names, strict=True):
        sets: dict[str, Members] = getattr(one.part, kind)
        for key, members in sets.items():
            title = f"{one.name}.{members.title}" if prefix and one.name else members.title
            found.append((title, lookup.set_named(key)))
    return found


def _side_sets(
    every: list[Instance], names: list[Names], joined: _Elements, prefix: bool
) -> tuple[dict[str, np.ndarray], int]:
    """Surfaces as hexes and their faces, and how many entries are something else."""
    answer, others = {}, 0
    for one, lookup in zip(every, names, strict=True):
        for title, entries in one.part.surfaces.items():
            rows = []
            for word, side in entries:
                face = FACE_OF_SIDE.get(side)
                hexes = joined.hexes(lookup.of(word))
                lookup.budget.spend(len(hexes))
                others += int((hexes < 0).sum()) if face is not None else 1
                hexes = hexes[hexes >= 0]
                if face is not None and len(hexes):
                    rows.append(np.column_stack([hexes, np.full(len(hexes), face)]))
            if rows:
                answer[f"{one.name}.{title}" if prefix and one.name else title] = np.concatenate(rows)
    return answer, others


def _points(one: Instance) -> np.ndarray:
    points = np.concatenate([*one.part.points, np.zeros((0, 3))])
    if np.array_equal(one.rotation, np.eye(3)):
        return points + one.shift if one.shift.any() else points
    return points @ one.rotation.T + one.shift


def _joined(arrays: list[np.ndarray]) -> np.ndarray:
    return np.concatenate([*arrays, np.zeros(0, np.int64)])
