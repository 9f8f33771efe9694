"""Content of an ExodusII file: element blocks, sets, maps of ids, and results of the last time step."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cell_kinds import node_count, to_vtk_order
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, concatenate_data, concatenate_sets
from hexmend.io.base.cursor import quoted
from hexmend.io.base.fixed_marks import FIXED
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.exodus.columns import join_columns
from hexmend.io.formats.exodus.elements import FACE_OF_SIDE, ORDER, PINS_PROPERTY, kinds_of
from hexmend.io.formats.exodus.ids import id_lines
from hexmend.io.formats.exodus.records import read_records, unread_notes
from hexmend.io.formats.exodus.store import ExodusStore, open_store
from hexmend.io.formats.exodus.values import CheckedVariables


def content(path: Path) -> Content:
    """Read the content of an ExodusII file, with the results of its last time step.

    Raises
    ------
    FileError
        For a file that is damaged or is NetCDF of another kind.
    """
    with open_store(path) as store:
        return _Reader(path, store).content()


class _Reader:
    """Reader of one file, with the notes, unread cells and ids found so far."""

    def __init__(self, path: Path, store: ExodusStore):
        self.path, self.store = path, store
        self.notes: list[str] = []
        self.unread: dict[str, int] = {}  # number of cells left out, by type and block
        self.id_names: list[tuple[str, int, str]] = []  # entity, id and name of every block and set
        if "num_nodes" not in store.dimensions:
            raise FileError(path, "is NetCDF, but has no dimension num_nodes, as ExodusII has", "Name an Exodus file.")
        self.n_nodes = store.dimensions["num_nodes"]
        self.n_elements = store.dimensions.get("num_elem", 0)
        steps = store.dimensions.get("time_step", 0)
        self.variables = CheckedVariables(path, store, max(0, steps - 1))
        if steps > 1 and any(f"name_{entity}_var" in store for entity in ("nod", "elem")):
            self.notes.append(f"Of {steps:,} time steps the last is read.")

    def content(self) -> Content:
        """Read everything."""
        points = self.points()
        blocks, elements = self.blocks()
        node_sets, pinned = self.node_sets()
        node_data = self.results("nod", "", self.n_nodes)
        if "node_num_map" in self.store:
            node_data[ID] = self.variables.integers("node_num_map", self.n_nodes)
        self.add_element_sets(blocks, elements)
        hexes = [numbers for block, numbers in zip(blocks, elements, strict=True) if block.kind in HEX_KINDS]
        side_sets = self.side_sets(np.concatenate(hexes) if hexes else np.empty(0, np.int64))
        return Content(
            points,
            tuple(_merge_other_kinds(blocks)),
            node_data,
            node_sets,
            side_sets,
            pinned=pinned,
            field_data={**id_lines(self.id_names), **read_records(self.store)},
            notes=(*self.notes, *unread_notes(self.store)),
            unread=self.unread,
        )

    def points(self) -> np.ndarray:
        """Coordinates of the nodes, (n, 3) float64; 0 along axes that the file does not have."""
        width = self.store.dimensions.get("num_dim", 3)
        if not 1 <= width <= 3:
            raise FileError(self.path, f"num_dim is {width}: expected 1 to 3", DAMAGED)
        if "coord" in self.store:
            rows = self.variables.array("coord", width, self.n_nodes)
        else:
            missing = [name for name in "xyz"[:width] if f"coord{name}" not in self.store]
            if missing:
                raise FileError(self.path, f"has no coordinates coord{missing[0]}", DAMAGED)
            rows = [self.variables.array("coord" + name, self.n_nodes) for name in "xyz"[:width]]
        points = np.zeros((self.n_nodes, 3))  # after reading: num_nodes of a damaged file may be huge
        points[:, :width] = np.column_stack(list(rows))
        return points

    def blocks(self) -> tuple[list[Block], list[np.ndarray]]:
        """Element blocks, and the numbers of their elements in the file, from 0, (k,) int64 each."""
        ids, names = self.variables.ids("eb_prop1", "num_el_blk"), self.variables.strings("eb_names")
        id_map = None
        if "elem_num_map" in self.store:
            id_map = self.variables.integers("elem_num_map", self.n_elements)
        blocks, elements, block_ids, titles, first = [], [], [], [], 0
        for k, number in enumerate(ids, 1):
            count = self.store.dimensions.get(f"num_el_in_blk{k}", 0)
            first += count
            block = self.block(k, number, count) if count and f"connect{k}" in self.store else None
            if block is None:
                continue
            numbers = np.arange(first - count, first)
            data = {**block.data, **self.results("elem", f"eb{k}", count)}
            if id_map is not None:
                data[ID] = id_map[numbers]
            title = names[k - 1] if k <= len(names) else ""
            blocks.append(Block(block.kind, block.nodes, data, {title: np.arange(count)} if title else {}))
            titles.append(title)
            elements.append(numbers)
            block_ids.append(number)
        if first != self.n_elements:  # sets and maps refer to these numbers
            raise FileError(self.path, f"has {self.n_elements} elements, but its blocks {first}", DAMAGED)
        kinds = [block.kind for block in blocks]
        if not any(names) and any(kinds.count(kind) > 1 for kind in HEX_KINDS):  # blocks are materials
            titles = [f"block {number}" for number in block_ids]
            for block, title in zip(blocks, titles, strict=True):
                block.sets[title] = np.arange(len(block))
        self.id_names += [("eb", number, title) for number, title in zip(block_ids, titles, strict=True)]
        return blocks, elements

    def block(self, k: int, number: int, count: int) -> Block | None:
        """Nodes and attributes of element block k, of an id and a number of elements; None for unknown types."""
        variable = f"connect{k}"
        type_ = str(self.store.attribute(variable, "elem_type") or "").upper()
        width = self.store.dimensions.get(f"num_nod_per_el{k}", 0)
        kinds = kinds_of(type_, width)
        kind = next((kind for kind in kinds if node_count(kind) == width), None)
        if kind is None and (not kinds or width < node_count(kinds[0])):
            title = f"type {quoted(type_)[1:-1] if type_ else 'unnamed'} in block {number}"
            self.notes.append(f"{count:,} cells of {title} are left out.")
            self.unread[title] = count
            return None
        nodes = self.variables.integers(variable, count, width) - 1
        if nodes.min() < 0 or nodes.max() >= self.n_nodes:
            raise FileError(
                self.path,
                f"block {number} uses the nodes {nodes.min() + 1} to {nodes.max() + 1}: expected 1 to {self.n_nodes}",
                DAMAGED,
            )
        if kind is None:
            self.notes.append(
                f"Cells of type {type_} with {width} nodes in block {number} are read with their corners only."
            )
            kind = kinds[0]
            nodes = nodes[:, : node_count(kind)]
        return Block(kind, to_vtk_order(nodes, kind, ORDER), self.attributes(k, count))

    def attributes(self, k: int, count: int) -> dict[str, np.ndarray]:
        """Attributes of element block k by name, (count,) each."""
        width = self.store.dimensions.get(f"num_att_in_blk{k}", 0)
        if not width or f"attrib{k}" not in self.store:
            return {}
        values, names = self.variables.array(f"attrib{k}", count, width), self.variables.strings(f"attrib_name{k}")
        return {
            (names[j] if j < len(names) and names[j] else f"attribute {j + 1}"): np.ascontiguousarray(values[:, j])
            for j in range(width)
        }

    def node_sets(self) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
        """Node sets by name, and pinned nodes: those of the set marked so, else of sets named "fixed"."""
        ids = self.variables.ids("ns_prop1", "num_node_sets")
        marked = "ns_prop2" in self.store and self.store.attribute("ns_prop2", "name") == PINS_PROPERTY
        marks = self.variables.integers("ns_prop2", len(ids)) if marked else None
        sets, pinned = {}, None
        for k, name in enumerate(self.set_names("ns", ids, "node set"), 1):
            if f"node_ns{k}" not in self.store:
                continue
            members = self.variables.members(f"node_ns{k}", f"num_nod_ns{k}", self.n_nodes, "nodes")
            if name.lower() == FIXED if marks is None else marks[k - 1]:
                pinned = np.zeros(self.n_nodes, bool) if pinned is None else pinned
                pinned[members] = True
            if marks is None or not marks[k - 1]:
                sets[name] = members
        return sets, pinned

    def add_element_sets(self, blocks: list[Block], elements: list[np.ndarray]) -> None:
        """Add the element sets to the blocks that have members of them."""
        ids = self.variables.ids("els_prop1", "num_elem_sets")
        for k, name in enumerate(self.set_names("els", ids, "element set"), 1):
            if f"elem_els{k}" not in self.store:
                continue
            members = self.variables.members(f"elem_els{k}", f"num_ele_els{k}", self.n_elements, "elements")
            for block, numbers in zip(blocks, elements, strict=True):
                own = members[(members >= numbers[0]) & (members <= numbers[-1])] - numbers[0]
                if own.size:
                    block.sets[name] = own

    def side_sets(self, hexes: np.ndarray) -> dict[str, np.ndarray]:
        """Side sets by name, (k, 2) each; `hexes` are the numbers of the elements that are hexes, ascending."""
        ids = self.variables.ids("ss_prop1", "num_side_sets")
        found = {}
        for k, name in enumerate(self.set_names("ss", ids, "side set"), 1):
            if f"elem_ss{k}" not in self.store or f"side_ss{k}" not in self.store:
                continue
            elements = self.variables.members(f"elem_ss{k}", f"num_side_ss{k}", self.n_elements, "elements")
            sides = self.variables.integers(f"side_ss{k}", len(elements))
            rows = np.searchsorted(hexes, elements).clip(0, max(0, len(hexes) - 1))
            of_hex = hexes[rows] == elements if len(hexes) else np.zeros(len(elements), bool)
            if not of_hex.all():
                self.notes.append(f"{int((~of_hex).sum()):,} sides of other cells in {name!r} are left out.")
            sides = sides[of_hex]
            if sides.size and (sides.min() < 1 or sides.max() > 6):
                raise FileError(self.path, f"{name!r} has the sides {sides.min()} to {sides.max()}: expected 1 to 6")
            if sides.size:
                found[name] = np.column_stack([rows[of_hex], FACE_OF_SIDE[sides - 1]])
        return found

    def results(self, entity: str, block: str, count: int) -> dict[str, np.ndarray]:
        """Results of the last time step: of the nodes ("nod", ""), or of an element block ("elem", "eb1")."""
        if f"name_{entity}_var" not in self.store or not self.store.dimensions.get("time_step"):
            return {}
        found = {}
        names = self.variables.strings(f"name_{entity}_var")
        for v, name in enumerate(names, 1):
            if f"vals_{entity}_var{v}{block}" in self.store:
                found[name] = self.variables.array(f"vals_{entity}_var{v}{block}", count)
            elif entity == "nod" and "vals_nod_var" in self.store:
                found[name] = self.variables.array("vals_nod_var", len(names), count)[v - 1]
        return join_columns(found)

    def set_names(self, entity: str, ids: list[int], title: str) -> list[str]:
        """Distinct names of the sets of an entity ("ns"): those of the file, else a title with the id."""
        words = self.variables.strings(f"{entity}_names")
        words = [words[k] if k < len(words) and words[k] else f"{title} {number}" for k, number in enumerate(ids)]
        names = [
            word if words.count(word) == 1 else f"{word} {number}" for word, number in zip(words, ids, strict=True)
        ]
        self.id_names += [(entity, number, name) for number, name in zip(ids, names, strict=True)]
        return names


def _merge_other_kinds(blocks: list[Block]) -> list[Block]:
    """Blocks of hexes as they are, and one block for each other kind."""
    merged = [block for block in blocks if block.kind in HEX_KINDS]
    for kind in dict.fromkeys(block.kind for block in blocks if block.kind not in HEX_KINDS):
        parts = [block for block in blocks if block.kind == kind]
        lengths = [len(block) for block in parts]
        merged.append(
            Block(
                kind,
                np.concatenate([block.nodes for block in parts]),
                concatenate_data([block.data for block in parts], lengths),
                concatenate_sets([block.sets for block in parts], lengths),
            )
        )
    return merged
