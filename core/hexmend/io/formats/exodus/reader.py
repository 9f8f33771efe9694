"""The content of an ExodusII file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, concatenate_data, concatenate_sets
from hexmend.io.base.cursor import quoted
from hexmend.io.base.fixed_marks import FIXED
from hexmend.io.formats.exodus.elements import FACE_OF_SIDE, ORDER, PINS, family_of
from hexmend.io.formats.exodus.ids import kept
from hexmend.io.formats.exodus.records import not_kept, records_of
from hexmend.io.formats.exodus.store import ExodusStore, opened
from hexmend.io.formats.exodus.values import DAMAGED, Values, with_columns
from hexmend.mesh.cells import CELL_KINDS


def content(path: Path) -> Content:
    """What an ExodusII file holds, the results being those of the last time step."""
    with opened(path) as store:
        return _Reader(path, store).content()


class _Reader:
    """One file, and what is found in it on the way."""

    def __init__(self, path: Path, store: ExodusStore):
        self.path, self.store = path, store
        self.notes: list[str] = []
        self.unread: dict[str, int] = {}  # how many cells of which type and block are left out
        self.named: list[tuple[str, int, str]] = []  # the sort, id and name of every block and set
        if "num_nodes" not in store.dimensions:
            raise FileError(path, "is NetCDF, but has no dimension num_nodes, as ExodusII has", "Name an Exodus file.")
        self.n_nodes = store.dimensions["num_nodes"]
        self.n_elements = store.dimensions.get("num_elem", 0)
        steps = store.dimensions.get("time_step", 0)
        self.values = Values(path, store, max(0, steps - 1))
        if steps > 1 and any(f"name_{what}_var" in store for what in ("nod", "elem")):
            self.notes.append(f"Of {steps:,} time steps the last is read.")

    def content(self) -> Content:
        points = self.points()
        blocks, numbers = self.blocks()
        node_sets, pinned = self.node_sets()
        node_data = self.variables("nod", "", self.n_nodes)
        if "node_num_map" in self.store:
            node_data[ID] = self.values.whole("node_num_map", self.n_nodes)
        self.element_sets(blocks, numbers)
        hexes = [part for block, part in zip(blocks, numbers, strict=True) if block.kind in HEX_KINDS]
        side_sets = self.side_sets(np.concatenate(hexes) if hexes else np.empty(0, np.int64))
        self.notes += not_kept(self.store)
        return Content(
            points,
            tuple(_by_kind(blocks)),
            node_data,
            node_sets,
            side_sets,
            pinned=pinned,
            field_data={**kept(self.named), **records_of(self.store)},
            notes=tuple(self.notes),
            unread=self.unread,
        )

    # Parts of the file

    def points(self) -> np.ndarray:
        width = self.store.dimensions.get("num_dim", 3)
        if not 1 <= width <= 3:
            raise FileError(self.path, f"num_dim is {width}: expected 1 to 3", DAMAGED)
        if "coord" in self.store:
            rows = self.values.array("coord", width, self.n_nodes)
        else:
            missing = [name for name in "xyz"[:width] if f"coord{name}" not in self.store]
            if missing:
                raise FileError(self.path, f"has no coordinates coord{missing[0]}", DAMAGED)
            rows = [self.values.array("coord" + name, self.n_nodes) for name in "xyz"[:width]]
        points = np.zeros((self.n_nodes, 3))  # as many as have been read
        points[:, :width] = np.column_stack(list(rows))
        return points

    def blocks(self) -> tuple[list[Block], list[np.ndarray]]:
        """Blocks of cells, and the numbers of their cells in the file, from 0."""
        ids = self.values.ids("eb_prop1", "num_el_blk")
        names = self.values.words("eb_names") if "eb_names" in self.store else []
        id_map = self.values.whole("elem_num_map", self.n_elements) if "elem_num_map" in self.store else None
        blocks, numbers, of_ids, called, first = [], [], [], [], 0
        for k, number in enumerate(ids, 1):
            count = self.store.dimensions.get(f"num_el_in_blk{k}", 0)
            first += count
            block = self.block(k, number, count) if count and f"connect{k}" in self.store else None
            if block is None:
                continue
            cells = np.arange(first - count, first)
            data = {**block.data, **self.variables("elem", f"eb{k}", count, k - 1)}
            if id_map is not None:
                data[ID] = id_map[cells]
            sets = {names[k - 1]: np.arange(count)} if k <= len(names) and names[k - 1] else {}
            blocks.append(Block(block.kind, block.nodes, data, sets))
            called.append(next(iter(sets), ""))
            numbers.append(cells)
            of_ids.append(number)
        if first != self.n_elements:  # which all numbers of elements rest on
            raise FileError(self.path, f"has {self.n_elements} elements, but its blocks {first}", DAMAGED)
        kinds = [block.kind for block in blocks]
        if not any(names) and any(kinds.count(kind) > 1 for kind in HEX_KINDS):  # which tell materials apart
            for block, number in zip(blocks, of_ids, strict=True):
                block.sets[f"block {number}"] = np.arange(len(block))
            called = [f"block {number}" for number in of_ids]
        self.named += [("eb", number, name) for number, name in zip(of_ids, called, strict=True)]
        return blocks, numbers

    def block(self, k: int, number: int, count: int) -> Block | None:
        """Nodes and attributes of the cells of block k, or None where they are of no kind that is known."""
        variable = f"connect{k}"
        type_ = str(self.store.attribute(variable, "elem_type") or "").upper()
        width = self.store.dimensions.get(f"num_nod_per_el{k}", 0)
        family = family_of(type_, width)
        widths = [HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes for kind in family]
        kind = dict(zip(widths, family, strict=True)).get(width)
        if kind is None and (not family or width < widths[0]):
            named = f"type {quoted(type_)[1:-1] if type_ else 'unnamed'} in block {number}"
            self.notes.append(f"{count:,} cells of {named} are left out.")
            self.unread[named] = count
            return None
        nodes = self.values.whole(variable, count, width) - 1
        if nodes.min() < 0 or nodes.max() >= self.n_nodes:
            raise FileError(
                self.path,
                f"block {number} uses the nodes {nodes.min() + 1} to {nodes.max() + 1}: expected 1 to {self.n_nodes}",
                DAMAGED,
            )
        if kind is None:
            self.notes.append(f"Cells of type {type_} with {width} nodes in block {number} are read by their corners.")
            kind, nodes = family[0], nodes[:, : widths[0]]
        return Block(kind, nodes[:, ORDER[kind]] if kind in ORDER else nodes, self.attributes(k, count))

    def attributes(self, k: int, count: int) -> dict[str, np.ndarray]:
        width = self.store.dimensions.get(f"num_att_in_blk{k}", 0)
        if not width or f"attrib{k}" not in self.store:
            return {}
        values = self.values.array(f"attrib{k}", count, width)
        names = self.values.words(f"attrib_name{k}") if f"attrib_name{k}" in self.store else []
        return {
            (names[j] if j < len(names) and names[j] else f"attribute {j + 1}"): np.ascontiguousarray(values[:, j])
            for j in range(width)
        }

    def node_sets(self) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
        """Sets of nodes by name, and pins: the set that is marked as such, else what sets called "fixed" hold."""
        ids = self.values.ids("ns_prop1", "num_node_sets")
        marked = "ns_prop2" in self.store and self.store.attribute("ns_prop2", "name") == PINS
        marks = self.values.whole("ns_prop2", len(ids)) if marked else None
        answer, pinned = {}, None
        for k, name in enumerate(self.names("ns", ids, "node set"), 1):
            if f"node_ns{k}" not in self.store:
                continue
            members = self.values.members(f"node_ns{k}", f"num_nod_ns{k}", self.n_nodes, "nodes")
            if name.lower() == FIXED if marks is None else marks[k - 1]:
                pinned = np.zeros(self.n_nodes, bool) if pinned is None else pinned
                pinned[members] = True
            if marks is None or not marks[k - 1]:
                answer[name] = members
        return answer, pinned

    def element_sets(self, blocks: list[Block], numbers: list[np.ndarray]) -> None:
        """Add the sets of elements to the blocks that their members are in."""
        ids = self.values.ids("els_prop1", "num_elem_sets")
        for k, name in enumerate(self.names("els", ids, "element set"), 1):
            if f"elem_els{k}" not in self.store:
                continue
            members = self.values.members(f"elem_els{k}", f"num_ele_els{k}", self.n_elements, "elements")
            for block, cells in zip(blocks, numbers, strict=True):
                inside = members[(members >= cells[0]) & (members <= cells[-1])] - cells[0]
                if inside.size:
                    block.sets[name] = inside

    def side_sets(self, hexes: np.ndarray) -> dict[str, np.ndarray]:
        """Sides of hexes by name; `hexes` are the elements that are hexes, ascending."""
        ids = self.values.ids("ss_prop1", "num_side_sets")
        answer = {}
        for k, name in enumerate(self.names("ss", ids, "side set"), 1):
            if f"elem_ss{k}" not in self.store or f"side_ss{k}" not in self.store:
                continue
            elements = self.values.members(f"elem_ss{k}", f"num_side_ss{k}", self.n_elements, "elements")
            sides = self.values.whole(f"side_ss{k}", len(elements))
            place = np.searchsorted(hexes, elements).clip(0, max(0, len(hexes) - 1))
            of_hex = hexes[place] == elements if len(hexes) else np.zeros(len(elements), bool)
            if not of_hex.all():
                self.notes.append(f"{int((~of_hex).sum()):,} sides of other cells in {name!r} are left out.")
            sides = sides[of_hex]
            if sides.size and (sides.min() < 1 or sides.max() > 6):
                raise FileError(self.path, f"{name!r} has the sides {sides.min()} to {sides.max()}: expected 1 to 6")
            if sides.size:
                answer[name] = np.column_stack([place[of_hex], FACE_OF_SIDE[sides - 1]])
        return answer

    def variables(self, what: str, place: str, count: int, block: int = 0) -> dict[str, np.ndarray]:
        """Results of the last step: of the nodes ("nod", ""), or of the elements of a block ("elem", "eb1")."""
        if f"name_{what}_var" not in self.store or not self.store.dimensions.get("time_step"):
            return {}
        found = {}
        for v, name in enumerate(self.values.words(f"name_{what}_var"), 1):
            if f"vals_{what}_var{v}{place}" in self.store:
                found[name] = self.values.array(f"vals_{what}_var{v}{place}", count)
            elif what == "nod" and "vals_nod_var" in self.store:
                found[name] = self.values.array("vals_nod_var", len(self.values.words("name_nod_var")), count)[v - 1]
        return with_columns(found)

    def names(self, sort: str, ids: list[int], what: str) -> list[str]:
        """A name for each id of a sort of sets ("ns"): that of the file, or one made of the id."""
        words = self.values.words(f"{sort}_names") if f"{sort}_names" in self.store else []
        words = [words[k] if k < len(words) and words[k] else f"{what} {number}" for k, number in enumerate(ids)]
        names = [
            word if words.count(word) == 1 else f"{word} {number}" for word, number in zip(words, ids, strict=True)
        ]
        self.named += [(sort, number, name) for number, name in zip(ids, names, strict=True)]
        return names


def _by_kind(blocks: list[Block]) -> list[Block]:
    """The blocks, of which those of one kind that is no hex are one."""
    answer = [block for block in blocks if block.kind in HEX_KINDS]
    for kind in dict.fromkeys(block.kind for block in blocks if block.kind not in HEX_KINDS):
        parts = [block for block in blocks if block.kind == kind]
        lengths = [len(block) for block in parts]
        answer.append(
            Block(
                kind,
                np.concatenate([block.nodes for block in parts]),
                concatenate_data([block.data for block in parts], lengths),
                concatenate_sets([block.sets for block in parts], lengths),
            )
        )
    return answer
