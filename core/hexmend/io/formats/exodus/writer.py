"""An ExodusII file of a mesh."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import non_numeric_data, rounded_integers
from hexmend.io.base.content import ID, Block, hex_blocks, unused_name
from hexmend.io.base.fixed_marks import FIXED, needs_marks, redundant_marks
from hexmend.io.base.unique_names import altered_names, make_unique
from hexmend.io.formats.exodus.columns import column_titles, columns, form, whole_numbers
from hexmend.io.formats.exodus.elements import ORDER, PINS, SIDE_OF_FACE, TYPES
from hexmend.io.formats.exodus.ids import IDS, ids_of
from hexmend.io.formats.exodus.netcdf3_writer import ClassicWriter
from hexmend.io.formats.exodus.records import add_records
from hexmend.mesh.mesh import Mesh

#: In `int64_status`: that ids are kept in 64 bits.
_WIDE_MAPS = 0x2000


def write(path: Path, mesh: Mesh) -> None:
    """Write a mesh.

    Elements keep their order. A named set of consecutive ones becomes a block of elements, another one an element
    set; pins become a node set called "fixed", which its property `PINS` tells from other sets.
    """
    parts, numbers = [], np.empty(mesh.n_hexes, np.int64)
    for block, chosen in hex_blocks(mesh):
        numbers[chosen] = sum(len(part) for part in parts) + np.arange(len(block))
        parts.append(block)
    parts += [Block(cells.kind, cells.nodes, cells.data, cells.sets) for cells in mesh.cells if len(cells.nodes)]
    often = Counter(name for part in parts for name in part.sets if name)
    blocks = [piece for part in parts for piece in _pieces(part, {name for name in often if often[name] == 1})]
    ids = [np.asarray(values) for values in (mesh.node_data.get(ID), *(part.data.get(ID) for part in parts))]
    file = ClassicWriter(
        {
            "api_version": np.float32(8.03),
            "version": np.float32(8.03),
            "floating_point_word_size": np.int32(8),
            "file_size": np.int32(1),
            "int64_status": np.int32(_WIDE_MAPS if any(_wide(values) for values in ids) else 0),
            "title": mesh.name or "Hexmend",
        }
    )
    add_records(file, mesh.field_data)
    _add_points(file, mesh)
    _add_blocks(file, mesh, blocks)
    _add_ids(file, mesh, parts)
    _add_node_sets(file, mesh)
    _add_element_sets(file, mesh, parts, blocks)
    _add_side_sets(file, mesh, numbers)
    node_data, cell_data = _node_data(mesh), [block.data for block in blocks]
    nodes = columns(node_data, column_titles([node_data]))
    cells = [columns(data, titles) for titles in [column_titles(cell_data)] for data in cell_data]
    file.add("time_whole", {"time_step": 0}, np.zeros(int(bool(nodes) or any(cells))))
    _add_results(file, nodes, cells)
    file.write(path)


def limitations(mesh: Mesh) -> list[str]:
    """Data that are no numbers or are rounded, and names that the format cannot have or that clash, in words."""
    left, titles = rounded_integers(mesh) + non_numeric_data(mesh), {}
    cell_data = [mesh.hex_data, *(cells.data for cells in mesh.cells)]
    left += altered_names(column_titles([_node_data(mesh)]), "point data") + altered_names(
        column_titles(cell_data), "cell data"
    )
    sets = [name for one in mesh.cells for name in one.sets]
    for names in (mesh.node_sets, [*mesh.hex_sets, *sets], mesh.side_sets):
        titles |= make_unique(names, form)
    return left + altered_names(titles)


def _node_data(mesh: Mesh) -> dict[str, np.ndarray]:
    """Data of the nodes without those that say which are pinned."""
    return {name: values for name, values in mesh.node_data.items() if name != redundant_marks(mesh)}


@dataclass(frozen=True, eq=False)
class _Piece(Block):
    """A run of a block's cells, which is one of its sets, or what lies between them."""

    name: str = ""


def _pieces(block: Block, unique: set[str]) -> Iterator[_Piece]:
    """The block cut where a set of consecutive cells begins or ends; such sets do not overlap."""
    runs, reached = [], 0
    spans = {name: np.unique(members) for name, members in block.sets.items() if name in unique and len(members)}
    for name, members in sorted(spans.items(), key=lambda item: (item[1][0], -len(item[1]))):
        first, last = int(members[0]), int(members[-1]) + 1
        if first >= reached and last - first == len(members):
            runs += [("", reached, first), (name, first, last)]
            reached = last
    for name, first, last in [*runs, ("", reached, len(block))]:
        if last > first:
            data = {key: np.asarray(values)[first:last] for key, values in block.data.items()}
            yield _Piece(block.kind, block.nodes[first:last], data, name=name)


def _add_points(file: ClassicWriter, mesh: Mesh) -> None:
    for axis, name in enumerate("xyz"):
        file.add("coord" + name, {"num_nodes": mesh.n_nodes}, mesh.points[:, axis])
    file.dimensions["num_dim"] = 3
    file.add_text("coor_names", "num_dim", ["x", "y", "z"])


def _add_blocks(file: ClassicWriter, mesh: Mesh, blocks: list[_Piece]) -> None:
    file.dimensions["num_elem"] = sum(len(block) for block in blocks)
    _add_list(file, mesh, "eb", "num_el_blk", [block.name for block in blocks])
    for k, block in enumerate(blocks, 1):
        nodes = block.nodes
        if block.kind in ORDER:
            nodes = nodes[:, np.argsort(ORDER[block.kind])]
        shape = {f"num_el_in_blk{k}": len(nodes), f"num_nod_per_el{k}": nodes.shape[1]}
        file.add(f"connect{k}", shape, nodes + 1, elem_type=TYPES[block.kind])


def _add_ids(file: ClassicWriter, mesh: Mesh, parts: list[Block]) -> None:
    if whole_numbers(mesh.node_data.get(ID)):
        file.add("node_num_map", {"num_nodes": mesh.n_nodes}, mesh.node_data[ID])
    if any(whole_numbers(part.data.get(ID)) for part in parts):
        known = [np.asarray(part.data[ID]) for part in parts if whole_numbers(part.data.get(ID))]
        free = max(int(values.max()) for values in known) + 1  # for cells that have none
        rows = []
        for part in parts:
            rows.append(np.asarray(part.data[ID]) if whole_numbers(part.data.get(ID)) else free + np.arange(len(part)))
            free += 0 if whole_numbers(part.data.get(ID)) else len(part)
        file.add("elem_num_map", {"num_elem": sum(len(part) for part in parts)}, np.concatenate(rows))


def _add_node_sets(file: ClassicWriter, mesh: Mesh) -> None:
    pins, sets = "", {name: np.asarray(members) for name, members in mesh.node_sets.items() if len(members)}
    fixed = np.zeros(mesh.n_nodes, bool)
    for name, members in sets.items():
        fixed[members] |= name.lower() == FIXED
    by_name = not needs_marks(mesh, fixed) and (mesh.pinned is not None or not fixed.any())
    if not by_name and needs_marks(mesh):
        pins = unused_name(FIXED, sets) if FIXED in sets else FIXED
        sets[pins] = np.flatnonzero(mesh.pinned)
    _add_list(file, mesh, "ns", "num_node_sets", list(sets))
    if sets and not by_name:  # so that no set is taken for the pins by its name
        file.add("ns_prop2", {"num_node_sets": len(sets)}, np.array([one == pins for one in sets], np.int32), name=PINS)
    for k, members in enumerate(sets.values(), 1):
        file.add(f"node_ns{k}", {f"num_nod_ns{k}": len(members)}, members + 1)


def _add_element_sets(file: ClassicWriter, mesh: Mesh, parts: list[Block], blocks: list[_Piece]) -> None:
    sets: dict[str, list[np.ndarray]] = {}
    named, first = {block.name for block in blocks if block.name}, 0
    for part in parts:
        for name, members in part.sets.items():
            if name not in named and len(members):
                sets.setdefault(name, []).append(np.asarray(members) + first)
        first += len(part)
    _add_list(file, mesh, "els", "num_elem_sets", list(sets))
    for k, members in enumerate(sets.values(), 1):
        members = np.concatenate(members)
        file.add(f"elem_els{k}", {f"num_ele_els{k}": len(members)}, members + 1)


def _add_side_sets(file: ClassicWriter, mesh: Mesh, numbers: np.ndarray) -> None:
    sets = {name: np.asarray(rows) for name, rows in mesh.side_sets.items() if len(rows)}
    _add_list(file, mesh, "ss", "num_side_sets", list(sets))
    for k, rows in enumerate(sets.values(), 1):
        shape = {f"num_side_ss{k}": len(rows)}
        file.add(f"elem_ss{k}", shape, numbers[rows[:, 0]] + 1)
        file.add(f"side_ss{k}", shape, SIDE_OF_FACE[rows[:, 1]])


def _add_results(file: ClassicWriter, nodes: Mapping[str, np.ndarray], cells: list[Mapping[str, np.ndarray]]) -> None:
    """Data of nodes and cells, as results of one time step."""
    if nodes:
        file.add_text("name_nod_var", "num_nod_var", list(nodes))
        for v, values in enumerate(nodes.values(), 1):
            file.add(f"vals_nod_var{v}", {"time_step": 0, "num_nodes": len(values)}, values)
    names = list(dict.fromkeys(name for those in cells for name in those))
    if names:
        file.add_text("name_elem_var", "num_elem_var", names)
        table = np.array([[name in those for name in names] for those in cells])
        file.add("elem_var_tab", {"num_el_blk": len(cells), "num_elem_var": len(names)}, table)
        for k, those in enumerate(cells, 1):
            for v, name in enumerate(names, 1):
                if name in those:
                    shape = {"time_step": 0, f"num_el_in_blk{k}": len(those[name])}
                    file.add(f"vals_elem_var{v}eb{k}", shape, those[name])


def _add_list(file: ClassicWriter, mesh: Mesh, start: str, dimension: str, names: list[str]) -> None:
    """Ids, states and names of the blocks or sets of one sort."""
    if names:
        shape = {dimension: len(names)}
        file.add(f"{start}_status", shape, np.ones(len(names), np.int32))
        file.add(f"{start}_prop1", shape, np.array(ids_of(mesh.field_data.get(IDS), start, names)), name="ID")
        titles = make_unique((name for name in names if name or start != "eb"), form)  # a block may have no name
        file.add_text(f"{start}_names", dimension, [titles.get(name, "") for name in names])


def _wide(values: np.ndarray) -> bool:
    return whole_numbers(values) and bool(values.size) and (values.max() >= 2**31 or values.min() < -(2**31))
