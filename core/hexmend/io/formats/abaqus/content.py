"""Content of an Abaqus file: all instances of its parts as one mesh."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from hexmend.arrays import mask
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, to_vtk_order, unused_name
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted
from hexmend.io.base.numbering import find_ids
from hexmend.io.base.numbering import lookup as lookup_ids
from hexmend.io.base.remedies import MemoryBudget, check_suffix, some_names, unread_note
from hexmend.io.formats.abaqus.deck import Deck
from hexmend.io.formats.abaqus.elements import FACE_OF_SIDE, ORDER
from hexmend.io.formats.abaqus.model import Instance, Part, SetDefinition, SetLookup, name_key
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

#: Name of the cell data that hold the index of each element's type among the field data of the name `TYPES`.
TYPE = "abaqus:type"
TYPES = "abaqus:types"
#: Types of elements that join nodes of different bodies.
_JOINING = re.compile(r"SPRING|DASHPOT|GAP|CONN|COH|GK|JOINT|ITT|DCOUP|D$")


def to_mesh(deck: Deck, instances: list[Instance], assembly: Part, notes: list[str], joining: list[str]) -> Mesh:
    """Join instances and the assembly's own nodes and elements into one mesh.

    Parameters
    ----------
    deck : Deck
    instances : list of Instance
    assembly : Part
        Data outside of all parts and instances.
    notes : list of str
        Notes of the mesh; more are appended.
    joining : list of str
        Names of the cards by which bodies touch or are joined; more are appended.

    Raises
    ------
    FileError
        For a file without nodes, or a name or number that does not exist.
    MeshError
        From `Mesh`.
    """
    several = len(instances) > 1
    if several:
        names = ", ".join(instance.name for instance in instances[:5])
        notes.append(f"{len(instances)} instances ({names}...) are read as one mesh.")
    instances = [*instances, Instance("", assembly)]
    kept = [instance.part.last_given() for instance in instances]
    node_ids = [_concatenated(one.part.node_ids)[rows] for one, rows in zip(instances, kept, strict=True)]
    if not sum(map(len, node_ids)):
        raise deck.error("has no *NODE", check_suffix("an Abaqus file"))
    points = np.concatenate([instance.points() for instance in instances])[np.concatenate(kept)]
    elements = _Elements(deck, instances, node_ids)

    budget = MemoryBudget(deck.path, len(deck.data))
    of_elements = _lookups(deck, instances, elements.ids, "element_sets", budget)
    finders = [lambda name, own=own: elements.nodes_of(own.resolve(name)) for own in of_elements]
    of_nodes = _lookups(deck, instances, node_ids, "node_sets", budget, finders)
    element_sets = _sets(instances, of_elements, several)
    side_sets, n_other = _side_sets(instances, of_elements, elements, several)
    node_sets = _sets(instances, of_nodes, several) | _node_surfaces(instances, of_nodes, several)
    notes += elements.notes()
    if n_twice := sum(int((~rows).sum()) for rows in kept):
        notes.append(f"{count_phrase(n_twice, 'node is', 'nodes are')} given again by a later line, which counts.")
    if n_other:
        notes.append(unread_note(f"{n_other:,} entries of surfaces that are not faces S1 to S6 of hexes"))
    notes += _missing_members((*of_nodes, *of_elements))
    pinned = _fixed_nodes(instances, of_nodes, elements, len(points))
    blocks, node_data = tuple(elements.blocks(element_sets)), {ID: np.concatenate(node_ids)}
    fields = {TYPES: elements.types} if elements.types else {}
    joining += [f"ELEMENT, TYPE={type}" for type in elements.unread if _JOINING.match(type)]
    if joining:
        fields[CONTACT_CARDS] = joining
    unread = {f"type {quoted(type)}": count for type, count in elements.unread.items()}
    content = Content(points, blocks, node_data, node_sets, side_sets, pinned, fields, tuple(notes), unread)
    return mesh_of(deck.path, content)


class _Elements:
    """The elements of all instances, one after the other.

    Attributes
    ----------
    ids : list of (k,) int64
        Element numbers of each instance.
    kinds : list of str
        Kinds of cells, hexes first.
    types : list of str
        Element types.
    counts : dict of str to int
        Number of elements of each kind.
    kind : (n,) int
        Index of each element's kind in `kinds`; -1 where it is not read.
    type : (n,) int
        Index of each element's type in `types`; -1 where it is not read.
    row : (n,) int
        Index of each element among those of its kind.
    unread : Counter
        Number of elements of each type that is not read.
    """

    def __init__(self, deck: Deck, instances: list[Instance], node_ids: list[np.ndarray]):
        cards = [card for instance in instances for card in instance.part.element_cards]
        first_node = _offsets(node_ids)
        kinds = dict.fromkeys(card.kind for card in cards if card.kind)
        self.kinds = sorted(kinds, key=lambda kind: kind not in HEX_KINDS)
        self.types = list(dict.fromkeys(card.type for card in cards if card.kind))
        self.ids = [_concatenated([card.ids for card in instance.part.element_cards]) for instance in instances]
        self.counts = dict.fromkeys(self.kinds, 0)
        self._nodes: dict[str, list[np.ndarray]] = {kind: [] for kind in self.kinds}
        self.unread = Counter()
        self._n_longer = sum(card.n_longer for card in cards)
        self._of_cards: list[np.ndarray] = []  # nodes of each card's elements, -1 for those that do not exist
        index_of = {name: k for k, name in enumerate(self.types)}
        kind, row, type = [], [], []
        for k, instance in enumerate(instances):
            for card in instance.part.element_cards:
                count = len(card.ids)
                kind.append(np.full(count, self.kinds.index(card.kind) if card.kind else -1))
                row.append(np.arange(count) + self.counts.get(card.kind, 0))
                type.append(np.full(count, index_of.get(card.type, -1)))
                if card.kind:
                    self.counts[card.kind] += count
                    nodes = find_ids(deck.path, node_ids[k], card.nodes, "node") + first_node[k]
                    self._nodes[card.kind].append(to_vtk_order(nodes, card.kind, ORDER))
                else:
                    self.unread[card.type] += count
                    nodes, exists = lookup_ids(node_ids[k], card.nodes)
                    nodes = np.where(exists, nodes + first_node[k], -1)
                self._of_cards.append(nodes)
        self.kind, self.row, self.type = _concatenated(kind), _concatenated(row), _concatenated(type)

    def blocks(self, sets: Mapping[str, np.ndarray]) -> list[Block]:
        """One block for each kind, with its members of the sets."""
        ids, blocks = _concatenated(self.ids), []
        sets_of: dict[str, dict[str, np.ndarray]] = {kind: {} for kind in self.kinds}
        for name, members in sets.items():
            for k in np.unique(self.kind[members]):
                if k >= 0:
                    sets_of[self.kinds[k]][name] = self.row[members[self.kind[members] == k]]
        for k, kind in enumerate(self.kinds):
            chosen = self.kind == k
            data = {ID: ids[chosen], TYPE: self.type[chosen]}
            blocks.append(Block(kind, np.concatenate(self._nodes[kind]), data, sets_of[kind]))
        return blocks

    def nodes_of(self, members: np.ndarray) -> np.ndarray:
        """Nodes of elements, (k,) int64 ascending."""
        found, first = [], 0
        for nodes in self._of_cards:
            own = members[(members >= first) & (members < first + len(nodes))] - first
            found.append(nodes[own].ravel())
            first += len(nodes)
        nodes = np.unique(_concatenated(found))
        return nodes[nodes >= 0]

    def notes(self) -> list[str]:
        """Notes on elements that are not read, and on numbers that are not."""
        notes = []
        if self.unread:
            elements = count_phrase(self.unread.total(), "element")
            types = some_names(sorted(self.unread))
            notes.append(unread_note(f"{elements} of other types ({types}), whose nodes stay"))
        if self._n_longer:
            longer = count_phrase(self._n_longer, "element is followed", "elements are followed")
            notes.append(f"{longer} by more numbers in a line than its type has nodes: these are ignored.")
        return notes

    def hexes(self, members: np.ndarray) -> np.ndarray:
        """Numbers of hexes, counted through the blocks of hexes, (k,) int64; -1 for other elements."""
        first, hexes = 0, np.full(len(members), -1)
        for k, kind in enumerate(self.kinds):
            if kind in HEX_KINDS:
                chosen = self.kind[members] == k
                hexes[chosen] = self.row[members[chosen]] + first
                first += self.counts[kind]
        return hexes


def _lookups(
    deck: Deck,
    instances: list[Instance],
    ids: list[np.ndarray],
    attribute: str,
    budget: MemoryBudget,
    finders: Sequence[Callable[[str], np.ndarray]] = (),
) -> list[SetLookup]:
    """Lookups of the sets of each instance; the last, the assembly's, can look up sets of instances.

    `finders` find the nodes of an instance's element sets.
    """
    first, lookups = _offsets(ids), []
    known: dict[str, SetLookup] = {}
    for k, instance in enumerate(instances):
        others = dict(known) if k == len(instances) - 1 else None
        sets, finder = getattr(instance.part, attribute), finders[k] if finders else None
        lookups.append(SetLookup(deck, ids[k], sets, int(first[k]), budget, others, finder))
        known[name_key(instance.name)] = lookups[-1]
    return lookups


def _title(instance: Instance, name: str, several: bool) -> str:
    """Name of a set or surface in the mesh: of several instances it begins with the instance's name."""
    return f"{instance.name}.{name}" if several and instance.name else name


def _sets(instances: list[Instance], lookups: list[SetLookup], several: bool) -> dict[str, np.ndarray]:
    """Members of all sets by title."""
    found = {}
    for instance, lookup in zip(instances, lookups, strict=True):
        for key, definition in lookup.sets.items():
            found[_title(instance, definition.title, several)] = lookup.members(key)
    return found


def _node_surfaces(instances: list[Instance], lookups: list[SetLookup], several: bool) -> dict[str, np.ndarray]:
    """Nodes of surfaces by title; with a number behind it where a node set of the name has other members."""
    found = {}
    for instance, lookup in zip(instances, lookups, strict=True):
        for key, surface in instance.part.node_surfaces.items():
            title, nodes = _title(instance, surface.title, several), lookup.evaluate(surface)
            if key in lookup.sets and not np.array_equal(lookup.members(key), nodes):
                title = unused_name(title, [one.title for one in lookup.sets.values()])
            found[title] = nodes
    return found


def _fixed_nodes(
    instances: list[Instance], lookups: list[SetLookup], elements: _Elements, n_nodes: int
) -> np.ndarray | None:
    """Mark the nodes of elements that are not read, and those that only other cards name, (n,) bool; None for none."""
    fixed = mask(elements.nodes_of(np.flatnonzero(elements.kind < 0)), n_nodes)
    pairs = zip(instances, lookups, strict=True)
    named = [lookup.evaluate(SetDefinition("", one.part.named_nodes)) for one, lookup in pairs if one.part.named_nodes]
    if named:
        used = mask(elements.nodes_of(np.arange(len(elements.kind))), n_nodes)
        fixed |= mask(np.concatenate(named), n_nodes) & ~used
    return fixed if fixed.any() else None


def _missing_members(lookups: Sequence[SetLookup]) -> list[str]:
    """Notes on members of sets that the file does not have."""
    notes, n_unknown = [], sum(lookup.n_unknown for lookup in lookups)
    if n_unknown:
        members = count_phrase(n_unknown, "member of a set does", "members of sets do")
        notes.append(f"{members} not exist in the file: ignored.")
    if missing := dict.fromkeys(key for lookup in lookups for key in sorted(lookup.unknown_sets)):
        notes.append(f"Sets refer to {some_names(map(quoted, missing))}, which the file does not have: ignored.")
    return notes


def _side_sets(
    instances: list[Instance], lookups: list[SetLookup], elements: _Elements, several: bool
) -> tuple[dict[str, np.ndarray], int]:
    """Surfaces as side sets, (k, 2) int64 each, and the number of entries that are no faces of hexes."""
    found, n_other = {}, 0
    for instance, lookup in zip(instances, lookups, strict=True):
        for name, entries in instance.part.surfaces.items():
            rows = []
            for entry, side in entries:
                face = FACE_OF_SIDE.get(side)
                hexes = elements.hexes(lookup.resolve(entry))
                lookup.budget.charge(hexes.nbytes, "its surfaces")
                n_other += int((hexes < 0).sum()) if face is not None else 1
                hexes = hexes[hexes >= 0]
                if face is not None and len(hexes):
                    rows.append(np.column_stack([hexes, np.full(len(hexes), face)]))
            if rows:
                found[_title(instance, name, several)] = np.concatenate(rows)
    return found, n_other


def _offsets(arrays: list[np.ndarray]) -> np.ndarray:
    """Index of the first entry of each array in their concatenation, and the end."""
    return np.concatenate([[0], np.cumsum([len(values) for values in arrays])])


def _concatenated(arrays: list[np.ndarray]) -> np.ndarray:
    """Concatenation, empty int64 for no arrays."""
    return np.concatenate([*arrays, np.zeros(0, np.int64)])
