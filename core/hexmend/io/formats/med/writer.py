"""Writer of MED, version 4.1: one mesh, a family for every combination of sets, and data as fields."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import altered_names
from hexmend.io.base.content import ID, Block, Content, from_mesh, from_vtk_order, merge_blocks
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.hdf5 import writable_file
from hexmend.io.base.numbering import fit_64_bits, set_combinations
from hexmend.io.formats.med.fields import (
    GEOMETRY_NUMBERS,
    NO_PROFILE,
    NO_STEP,
    ORDER,
    TYPE_OF_KIND,
    encode_names,
    group_titles,
    titled_fields,
    type_code,
    write_fields,
)
from hexmend.mesh.mesh import Mesh


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a mesh, under its name, with its data as fields without a time."""
    content = _with_group_titles(replace(from_mesh(mesh), node_data=with_marks(mesh)))
    title = "".join(c if c.isalnum() or c in "_-" else "_" for c in mesh.name)[:64] or "mesh"
    with writable_file(path) as file:
        _group(file, "INFOS_GENERALES", MAJ=4, MIN=1, REL=0)
        group = _group(_group(file, "ENS_MAA"), title, DIM=3, ESP=3, NXI=-1, NXT=-1, REP=0, SRT=0, TYP=0)
        axes = np.bytes_("".join(f"{axis:<16}" for axis in "XYZ"))
        blank = np.bytes_(" " * 48)
        group.attrs.update({"NOM": axes, "UNI": blank, "UNT": np.bytes_(" "), "DES": np.bytes_("Written by Hexmend")})
        step = _group(group, NO_STEP, CGT=1, NDT=-1, NOR=-1, NXI=-1, NXT=-1, PVI=-1, PVT=-1)
        step.attrs["PDT"] = -1.0
        families = _group(_group(file, "FAS"), title)
        _group(families, "FAMILLE_ZERO", NUM=0)
        _write_nodes(step, families, content)
        _write_cells(step, families, content)
        write_fields(file, title, _fields(content))


def _write_nodes(step: object, families: object, content: Content) -> None:
    """Write coordinates, ids and families of the nodes."""
    group = _group(step, "NOE", CGT=1, CGS=1)
    group.attrs["PFL"] = np.bytes_(NO_PROFILE)
    count = len(content.points)
    _dataset(group, "COO", content.points.T.ravel(), count)
    _write_ids(group, content.node_data, count)
    if content.node_sets:
        numbers = _write_families(_group(families, "NOEUD"), {}, content.node_sets, count, 1)
        _dataset(group, "FAM", numbers, count)


def _write_cells(step: object, families: object, content: Content) -> None:
    """Write nodes, ids and families of the cells of each geometric type."""
    cells = _group(step, "MAI", CGT=1)
    of_cells = _group(families, "ELEME") if any(block.sets for block in content.blocks) else None
    known: dict[tuple[str, ...], int] = {}
    for kind, blocks in _by_kind(content).items():
        type, merged = TYPE_OF_KIND[kind], merge_blocks(blocks)
        group = _group(cells, type, CGT=1, CGS=1, GEO=GEOMETRY_NUMBERS[type])
        group.attrs["PFL"] = np.bytes_(NO_PROFILE)
        nodes = merged.nodes.astype(np.int64) + 1
        count = len(nodes)
        _dataset(group, "NOD", from_vtk_order(nodes, kind, ORDER).T.ravel(), count)
        if all(_has_ids(block.data, len(block)) for block in blocks):
            _write_ids(group, merged.data, count)
        if of_cells is not None:  # kinds without sets too: MED's library expects families of all kinds or of none
            _dataset(group, "FAM", _write_families(of_cells, known, merged.sets, count, -1), count)


def limitations(mesh: Mesh) -> list[str]:
    """List the ids, data and names of a mesh that a file cannot hold as they are, in words."""
    content = from_mesh(mesh)
    left = []
    of_elements = [(block.data, len(block)) for block in content.blocks]
    for label, parts in (("nodes", [(content.node_data, len(content.points))]), ("elements", of_elements)):
        odd = [np.asarray(data[ID]) for data, count in parts if ID in data and not _has_ids(data, count)]
        if odd:
            large = all(ids.dtype.kind == "u" for ids in odd)
            left.append(f"ids of {label} ({'some of 2^63 and above' if large else 'no whole numbers'})")
    fields = _fields(replace(content, node_data=with_marks(mesh)))
    of_cells = [arrays for entity, arrays in fields.items() if entity != "NOE"]
    for label, tables in (("point data", [fields["NOE"]]), ("cell data", of_cells)):
        odd = sorted({name for arrays in tables for name, values in arrays.items() if type_code(values) is None})
        left += [f"{label} that are not numbers ({', '.join(odd)})"] if odd else []
    titles = {name: title for (name, _, _), (title, _) in titled_fields(fields).items() if title != name}
    return left + altered_names(group_titles(_set_names(content))) + altered_names(titles, "data")


def _fields(content: Content) -> dict[str, dict[str, np.ndarray]]:
    """Data without ids, by entity and name."""
    data = {"NOE": content.node_data}
    for kind, blocks in _by_kind(content).items():
        data[f"MAI.{TYPE_OF_KIND[kind]}"] = merge_blocks(blocks).data
    return {
        entity: {name: np.asarray(values) for name, values in arrays.items() if name != ID}
        for entity, arrays in data.items()
    }


def _by_kind(content: Content) -> dict[str, list[Block]]:
    kinds = dict.fromkeys(block.kind for block in content.blocks)
    return {kind: [block for block in content.blocks if block.kind == kind] for kind in kinds}


def _with_group_titles(content: Content) -> Content:
    """Content whose sets have the names under which they are written."""
    titles = group_titles(_set_names(content))

    def retitled(sets: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {titles[name]: members for name, members in sets.items()}

    blocks = tuple(replace(block, sets=retitled(block.sets)) for block in content.blocks)
    return replace(content, blocks=blocks, node_sets=retitled(content.node_sets))


def _set_names(content: Content) -> list[str]:
    return [*content.node_sets, *(name for block in content.blocks for name in block.sets)]


def _has_ids(data: Mapping[str, np.ndarray], count: int) -> bool:
    """Return True if data hold ids that can be written."""
    ids = np.asarray(data.get(ID, ()))
    return ID in data and ids.shape == (count,) and ids.dtype.kind in "iu" and fit_64_bits(ids)


def _write_families(
    group: object, known: dict[tuple[str, ...], int], sets: Mapping[str, np.ndarray], count: int, sign: int
) -> np.ndarray:
    """Write a family for each combination of sets that is new; returns the family of each node or cell, (count,).

    `known` has the number of the family of each combination, and gets the new ones; `sign` is 1 for families of nodes,
    -1 for those of cells.
    """
    found, which = set_combinations(sets, count)
    numbers = []
    for names in map(tuple, found):
        if names and names not in known:
            known[names] = sign * (len(known) + 1)
            family = _group(group, f"FAM_{known[names]}", NUM=known[names])
            groups = _group(family, "GRO", NBR=len(names))
            groups.create_dataset("NOM", (len(names),), np.dtype(("i1", (80,))))[...] = encode_names(list(names))
        numbers.append(known[names] if names else 0)
    return np.array(numbers, np.int64)[which]


def _write_ids(group: object, data: Mapping[str, np.ndarray], count: int) -> None:
    if _has_ids(data, count):
        _dataset(group, "NUM", np.asarray(data[ID]).astype(np.int64), count)


def _dataset(group: object, name: str, values: np.ndarray, count: int) -> None:
    """Write a dataset with its attributes, the number of nodes or cells among them."""
    group.create_dataset(name, data=values).attrs.update({"CGT": np.int32(1), "NBR": np.int32(count)})


def _group(parent: object, name: str, /, **attributes: int) -> object:
    """Create a group with attributes of 32-bit integers."""
    group = parent.create_group(name, track_order=True)
    group.attrs.update({key: np.int32(value) for key, value in attributes.items()})
    return group
