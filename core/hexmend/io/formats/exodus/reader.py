"""Content of an ExodusII file: element blocks, sets, maps of ids, and results of the last time step.

Coordinates of an ExodusII file: its variables coordx, coordy and coordz, or coord.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, merge_other_kinds, node_count, to_vtk_order
from hexmend.io.base.cursor import quoted
from hexmend.io.base.fixed_marks import FIXED
from hexmend.io.base.numbering import check_numbers, lookup
from hexmend.io.base.remedies import DAMAGED, unread_note
from hexmend.io.coordinates.binary_coordinates import BinaryCoordinates, BinaryPiece, locate_datasets
from hexmend.io.coordinates.located import LocatedCoordinates
from hexmend.io.formats.exodus.columns import FACE_OF_SIDE, ORDER, PINS_PROPERTY, join_columns, kinds_of
from hexmend.io.formats.exodus.netcdf3 import is_classic
from hexmend.io.formats.exodus.records import id_lines, unread_notes
from hexmend.io.formats.exodus.store import CheckedVariables, ExodusStore, HDF5Store, open_store
from hexmend.io.storage import subprocess_reader


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
            raise FileError(
                path, "is NetCDF, but has no dimension num_nodes, as ExodusII has", "Choose an Exodus file."
            )
        self.n_nodes = store.dimensions["num_nodes"]
        self.n_elements = store.dimensions.get("num_elem", 0)
        steps = store.dimensions.get("time_step", 0)
        self.variables = CheckedVariables(path, store, max(0, steps - 1))
        if steps > 1 and any(f"name_{entity}_var" in store for entity in ("nod", "elem")):
            self.notes.append(unread_note(f"all {steps:,} time steps but the last"))

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
        blocks, fields = merge_other_kinds(blocks), id_lines(self.id_names)
        notes = (*self.notes, *unread_notes(self.store))
        return Content(points, blocks, node_data, node_sets, side_sets, pinned, fields, notes, self.unread)

    def points(self) -> np.ndarray:
        """Coordinates of the nodes, (n, 3) float64; 0 along axes that the file does not have."""
        width = self.store.dimensions.get("num_dim", 3)
        if not 1 <= width <= 3:
            raise FileError(self.path, f"num_dim is {width}: expected 1 to 3", DAMAGED)
        if "coord" in self.store:
            columns = iter(self.variables.array("coord", width, self.n_nodes))
        else:
            names = [f"coord{axis}" for axis in "xyz"[:width]]
            if missing := [name for name in names if name not in self.store]:
                raise FileError(self.path, f"has no coordinates {missing[0]}", DAMAGED)
            columns = (self.variables.array(name, self.n_nodes) for name in names)
        first = next(columns)
        points = np.zeros((self.n_nodes, 3))  # after reading: num_nodes of a damaged file may be huge
        points[:, 0] = first
        for k, column in enumerate(columns, 1):
            points[:, k] = column
        return points

    def blocks(self) -> tuple[list[Block], list[np.ndarray]]:
        """Element blocks, and the numbers of their elements in the file, from 0, (k,) int64 each."""
        ids, names = self.variables.ids("eb_prop1", "num_el_blk"), self.variables.strings("eb_names")
        has_ids = "elem_num_map" in self.store
        id_map = self.variables.integers("elem_num_map", self.n_elements) if has_ids else None
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
            self.notes.append(unread_note(f"{count:,} cells of {title}"))
            self.unread[title] = count
            return None
        nodes = self.variables.nodes(variable, count, width)
        check_numbers(self.path, f"block {number} uses the nodes", nodes, self.n_nodes)
        if kind is None:
            cells = f"Cells of type {type_} with {width} nodes in block {number}"
            self.notes.append(f"{cells} are read with their corners only.")
            kind = kinds[0]
            nodes = nodes[:, : node_count(kind)]
        return Block(kind, to_vtk_order(nodes, kind, ORDER), self.attributes(k, count))

    def attributes(self, k: int, count: int) -> dict[str, np.ndarray]:
        """Attributes of element block k by name, (count,) each."""
        width = self.store.dimensions.get(f"num_att_in_blk{k}", 0)
        if not width or f"attrib{k}" not in self.store:
            return {}
        try:
            values = self.variables.array(f"attrib{k}", count, width)
        except FileError as error:
            self.notes.append(unread_note(f"the attributes of block {k} ({error.problem})"))
            return {}
        names = self.variables.strings(f"attrib_name{k}")
        names = [names[j] if j < len(names) and names[j] else f"attribute {j + 1}" for j in range(width)]
        return {name: np.ascontiguousarray(column) for name, column in zip(names, values.T, strict=True)}

    def node_sets(self) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
        """Node sets by name, and pinned nodes: the set with the mark, or else sets named "fixed"."""
        marked = "ns_prop2" in self.store and self.store.attribute("ns_prop2", "name") == PINS_PROPERTY
        count = self.store.dimensions.get("num_node_sets", 0)
        marks = self.variables.integers("ns_prop2", count) if marked else None
        sets, pinned = {}, None
        for k, name in self.sets("ns", "num_node_sets", "node set", "node"):
            members = self.variables.members(f"node_ns{k}", f"num_nod_ns{k}", self.n_nodes, "nodes")
            if name.lower() == FIXED if marks is None else marks[k - 1]:
                pinned = np.zeros(self.n_nodes, bool) if pinned is None else pinned
                pinned[members] = True
            if marks is None or not marks[k - 1]:
                sets[name] = members
        return sets, pinned

    def add_element_sets(self, blocks: list[Block], elements: list[np.ndarray]) -> None:
        """Add the element sets to the blocks that have members of them."""
        for k, name in self.sets("els", "num_elem_sets", "element set", "elem"):
            members = self.variables.members(f"elem_els{k}", f"num_ele_els{k}", self.n_elements, "elements")
            for block, numbers in zip(blocks, elements, strict=True):
                own = members[(members >= numbers[0]) & (members <= numbers[-1])] - numbers[0]
                if own.size:
                    block.sets[name] = own

    def side_sets(self, hexes: np.ndarray) -> dict[str, np.ndarray]:
        """Side sets by name, (k, 2) each; `hexes` are the numbers of the elements that are hexes, ascending."""
        found = {}
        for k, name in self.sets("ss", "num_side_sets", "side set", "elem", "side"):
            elements = self.variables.members(f"elem_ss{k}", f"num_side_ss{k}", self.n_elements, "elements")
            sides = self.variables.integers(f"side_ss{k}", len(elements))
            rows, of_hex = lookup(hexes, elements)
            if not of_hex.all():
                self.notes.append(unread_note(f"{int((~of_hex).sum()):,} sides of other cells in {name!r}"))
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

    def sets(self, entity: str, dimension: str, title: str, *variables: str) -> list[tuple[int, str]]:
        """Number and name of each set of an entity ("ns") that has these variables, such as "node_ns1" for "node".

        Names are distinct: those of the file, else a title with the id.
        """
        ids = self.variables.ids(f"{entity}_prop1", dimension)
        words = self.variables.strings(f"{entity}_names")
        words = [words[k] if k < len(words) and words[k] else f"{title} {number}" for k, number in enumerate(ids)]
        named = zip(words, ids, strict=True)
        names = [word if words.count(word) == 1 else f"{word} {number}" for word, number in named]
        self.id_names += [(entity, number, name) for number, name in zip(ids, names, strict=True)]
        named = enumerate(names, 1)
        return [(k, name) for k, name in named if all(f"{one}_{entity}{k}" in self.store for one in variables)]


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    return coordinates(path) if is_classic(path) else subprocess_reader.run_reader(f"{__name__}:coordinates", path)


def coordinates(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file; run in a subprocess for one on HDF5."""
    with open_store(path) as store:
        width, found, pieces = store.dimensions.get("num_dim", 3), _Reader(path, store).points(), []
        single = {f"coord{'xyz'[k]}": slice(k, k + 1) for k in range(width)}
        columns = {"coord": slice(0, width)} if "coord" in store else single
        if isinstance(store, HDF5Store):
            return locate_datasets(path, found, [(store.dataset(name), part) for name, part in columns.items()])
        for name, part in columns.items():
            variable = store.variable(name)
            pieces.append(BinaryPiece.of_columns(variable.begin, variable.dtype, len(found), part))
        return BinaryCoordinates(path, found, tuple(pieces))
