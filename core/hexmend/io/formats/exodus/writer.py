"""Writer of ExodusII files, in NetCDF's classic format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import (
    altered_names,
    altered_set_names,
    make_unique,
    non_numeric_data,
    rounded_integers,
)
from hexmend.io.base.content import ID, Block, concatenate_sets, from_vtk_order, hex_blocks, unused_name
from hexmend.io.base.fixed_marks import FIXED, needs_marks, redundant_marks
from hexmend.io.formats.exodus.columns import (
    ORDER,
    PINS_PROPERTY,
    SIDE_OF_FACE,
    TYPE_OF_KIND,
    are_ids,
    clean_name,
    column_titles,
    columns,
)
from hexmend.io.formats.exodus.netcdf3_writer import ClassicWriter
from hexmend.io.formats.exodus.records import IDS, assigned_ids
from hexmend.mesh.mesh import Mesh


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write an ExodusII file.

    Elements keep their order. A named set of consecutive elements becomes an element block, others become element
    sets; pinned nodes become a node set called "fixed", which the property `PINS_PROPERTY` marks.
    """
    parts, numbers = [], np.empty(mesh.n_hexes, np.int64)  # the number of each hex in the file, from 0
    for block, chosen in hex_blocks(mesh):
        numbers[chosen] = sum(len(part) for part in parts) + np.arange(len(block))
        parts.append(block)
    parts += [Block(cells.kind, cells.nodes, cells.data, cells.sets) for cells in mesh.cells if len(cells.nodes)]
    count = Counter(name for part in parts for name in part.sets if name)
    unique = {name for name in count if count[name] == 1}
    blocks = [block for part in parts for block in _element_blocks(part, unique)]
    attributes: dict[str, object] = dict.fromkeys(("api_version", "version"), np.float32(8.03))
    attributes |= {"floating_point_word_size": np.int32(8), "file_size": np.int32(1), "int64_status": np.int32(0)}
    file = ClassicWriter(attributes | {"title": mesh.name or "Hexmend"})
    _add_points(file, mesh)
    _add_blocks(file, mesh, blocks)
    _add_ids(file, mesh, parts)
    _add_node_sets(file, mesh)
    _add_element_sets(file, mesh, parts, blocks)
    _add_side_sets(file, mesh, numbers)
    _add_results(file, mesh, blocks)
    file.write(path)


def limitations(mesh: Mesh) -> list[str]:
    """List the data and names of a mesh that a file cannot hold as they are, in words."""
    left = rounded_integers(mesh) + non_numeric_data(mesh)
    cell_data = [mesh.hex_data, *(cells.data for cells in mesh.cells)]
    for label, data in (("nodes", [mesh.node_data]), ("elements", cell_data)):
        if any(ID in one and not are_ids(one[ID]) for one in data):
            left.append(f"ids of {label} (some of 2^31 and above)")
    left += altered_names(column_titles([_node_data(mesh)]), "point data")
    left += altered_names(column_titles(cell_data), "cell data")
    return left + altered_set_names(mesh, clean_name)


def _node_data(mesh: Mesh) -> dict[str, np.ndarray]:
    """Data of the nodes without those that repeat the pins."""
    return {name: values for name, values in mesh.node_data.items() if name != redundant_marks(mesh)}


@dataclass(frozen=True, eq=False)
class _ElementBlock(Block):
    """Consecutive cells of a block, with the name of their set; empty for cells between such sets."""

    name: str = ""


def _element_blocks(block: Block, unique: set[str]) -> Iterator[_ElementBlock]:
    """Split a block at its sets of consecutive cells; those that overlap an earlier one stay sets.

    Parameters
    ----------
    block : Block
    unique : set of str
        Names of sets that no other block has.
    """
    spans, end = [], 0
    sets = {name: np.unique(members) for name, members in block.sets.items() if name in unique and len(members)}
    for name, members in sorted(sets.items(), key=lambda item: (item[1][0], -len(item[1]))):
        first, last = int(members[0]), int(members[-1]) + 1
        if first >= end and last - first == len(members):
            spans += [("", end, first), (name, first, last)]
            end = last
    for name, first, last in [*spans, ("", end, len(block))]:
        if last > first:
            data = {key: np.asarray(values)[first:last] for key, values in block.data.items()}
            yield _ElementBlock(block.kind, block.nodes[first:last], data, name=name)


def _add_points(file: ClassicWriter, mesh: Mesh) -> None:
    for axis, name in enumerate("xyz"):
        file.add_variable("coord" + name, {"num_nodes": mesh.n_nodes}, mesh.points[:, axis])
    file.dimensions["num_dim"] = 3
    file.add_strings("coor_names", "num_dim", ["x", "y", "z"])


def _add_blocks(file: ClassicWriter, mesh: Mesh, blocks: list[_ElementBlock]) -> None:
    file.dimensions["num_elem"] = sum(len(block) for block in blocks)
    _add_entities(file, mesh, "eb", "num_el_blk", [block.name for block in blocks])
    for k, block in enumerate(blocks, 1):
        nodes = from_vtk_order(block.nodes, block.kind, ORDER)
        shape = {f"num_el_in_blk{k}": len(nodes), f"num_nod_per_el{k}": nodes.shape[1]}
        file.add_variable(f"connect{k}", shape, nodes + 1, elem_type=TYPE_OF_KIND[block.kind])


def _add_ids(file: ClassicWriter, mesh: Mesh, parts: list[Block]) -> None:
    if are_ids(mesh.node_data.get(ID)):
        file.add_variable("node_num_map", {"num_nodes": mesh.n_nodes}, mesh.node_data[ID])
    if any(are_ids(part.data.get(ID)) for part in parts):
        known = [np.asarray(part.data[ID]) if are_ids(part.data.get(ID)) else None for part in parts]
        following = max(int(ids.max()) for ids in known if ids is not None) + 1  # id of the next cell that has none
        rows = []
        for part, ids in zip(parts, known, strict=True):
            rows.append(following + np.arange(len(part)) if ids is None else ids)
            following += len(part) if ids is None else 0
        file.add_variable("elem_num_map", {"num_elem": sum(len(part) for part in parts)}, np.concatenate(rows))


def _add_node_sets(file: ClassicWriter, mesh: Mesh) -> None:
    pins, sets = "", {name: np.asarray(members) for name, members in mesh.node_sets.items() if len(members)}
    fixed = np.zeros(mesh.n_nodes, bool)
    for name, members in sets.items():
        fixed[members] |= name.lower() == FIXED
    by_name = not needs_marks(mesh, fixed) and (mesh.pinned is not None or not fixed.any())
    if not by_name and needs_marks(mesh):
        pins = unused_name(FIXED, sets) if FIXED in sets else FIXED
        sets[pins] = np.flatnonzero(mesh.pinned)
    _add_entities(file, mesh, "ns", "num_node_sets", list(sets))
    if sets and not by_name:  # or a reader would take a set named "fixed" for the pins
        marks = np.array([name == pins for name in sets], np.int32)
        file.add_variable("ns_prop2", {"num_node_sets": len(sets)}, marks, name=PINS_PROPERTY)
    for k, members in enumerate(sets.values(), 1):
        file.add_variable(f"node_ns{k}", {f"num_nod_ns{k}": len(members)}, members + 1)


def _add_element_sets(file: ClassicWriter, mesh: Mesh, parts: list[Block], blocks: list[_ElementBlock]) -> None:
    named = {block.name for block in blocks if block.name}
    found = concatenate_sets([part.sets for part in parts], [len(part) for part in parts])
    sets = {name: members for name, members in found.items() if name not in named and len(members)}
    _add_entities(file, mesh, "els", "num_elem_sets", list(sets))
    for k, members in enumerate(sets.values(), 1):
        file.add_variable(f"elem_els{k}", {f"num_ele_els{k}": len(members)}, members + 1)


def _add_side_sets(file: ClassicWriter, mesh: Mesh, numbers: np.ndarray) -> None:
    sets = {name: np.asarray(rows) for name, rows in mesh.side_sets.items() if len(rows)}
    _add_entities(file, mesh, "ss", "num_side_sets", list(sets))
    for k, rows in enumerate(sets.values(), 1):
        shape = {f"num_side_ss{k}": len(rows)}
        file.add_variable(f"elem_ss{k}", shape, numbers[rows[:, 0]] + 1)
        file.add_variable(f"side_ss{k}", shape, SIDE_OF_FACE[rows[:, 1]])


def _add_results(file: ClassicWriter, mesh: Mesh, blocks: list[_ElementBlock]) -> None:
    """Add node and cell data as results of one time step, if there are any."""
    node_data, cell_data = _node_data(mesh), [block.data for block in blocks]
    of_nodes, titles = columns(node_data, column_titles([node_data])), column_titles(cell_data)
    of_blocks = [columns(data, titles) for data in cell_data]
    file.add_variable("time_whole", {"time_step": 0}, np.zeros(int(bool(of_nodes) or any(of_blocks))))
    if of_nodes:
        file.add_strings("name_nod_var", "num_nod_var", list(of_nodes))
        for v, values in enumerate(of_nodes.values(), 1):
            file.add_variable(f"vals_nod_var{v}", {"time_step": 0, "num_nodes": len(values)}, values)
    names = list(dict.fromkeys(name for results in of_blocks for name in results))
    if names:
        file.add_strings("name_elem_var", "num_elem_var", names)
        table = np.array([[name in results for name in names] for results in of_blocks])
        file.add_variable("elem_var_tab", {"num_el_blk": len(of_blocks), "num_elem_var": len(names)}, table)
        for k, results in enumerate(of_blocks, 1):
            for v, name in enumerate(names, 1):
                if name in results:
                    shape = {"time_step": 0, f"num_el_in_blk{k}": len(results[name])}
                    file.add_variable(f"vals_elem_var{v}eb{k}", shape, results[name])


def _add_entities(file: ClassicWriter, mesh: Mesh, prefix: str, dimension: str, names: list[str]) -> None:
    """Add status, ids and names of the blocks or sets of an entity, whose variables begin with `prefix`."""
    if names:
        shape = {dimension: len(names)}
        file.add_variable(f"{prefix}_status", shape, np.ones(len(names), np.int32))
        ids = np.array(assigned_ids(mesh.field_data.get(IDS), prefix, names))
        file.add_variable(f"{prefix}_prop1", shape, ids, name="ID")
        titles = make_unique((name for name in names if name or prefix != "eb"), clean_name)  # a block may have no name
        file.add_strings(f"{prefix}_names", dimension, [titles.get(name, "") for name in names])
