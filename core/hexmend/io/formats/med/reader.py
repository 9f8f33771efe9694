"""Content of a MED file: its first mesh, with groups as sets and fields as data.

Coordinates of a MED file: the dataset COO of its first mesh.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, node_count, to_vtk_order
from hexmend.io.base.numbering import check_numbers
from hexmend.io.base.remedies import DAMAGED, MemoryBudget, check_suffix, unread_note
from hexmend.io.coordinates.binary_coordinates import ALL_COLUMNS, locate_datasets
from hexmend.io.coordinates.located import LocatedCoordinates
from hexmend.io.formats.med.fields import (
    KIND_OF_TYPE,
    ORDER,
    TYPE_OF_KIND,
    decode_names,
    read_array,
    read_fields,
    read_integers,
)
from hexmend.io.storage import subprocess_reader


def content(path: Path) -> Content:
    """Read the content of a MED file.

    Raises
    ------
    FileError
        For a file that is damaged, or whose first mesh is structured or not in space.
    """
    with hdf5.open_file(path) as file:
        return _content(path, file)


def _content(path: Path, file: Mapping) -> Content:
    if "ENS_MAA" not in file or not len(file["ENS_MAA"]):
        raise FileError(path, "holds no mesh (no ENS_MAA)", check_suffix("a MED file"))
    meshes, notes = list(file["ENS_MAA"]), []
    if len(meshes) > 1:
        notes.append(unread_note(f"all {len(meshes)} meshes but the first, {meshes[0]}"))
    mesh = first_step(path, meshes[0], file["ENS_MAA"][meshes[0]], notes)
    families = file["FAS"][meshes[0]] if "FAS" in file and meshes[0] in file["FAS"] else {}

    points = read_points(path, mesh)
    node_ids = _ids(path, mesh["NOE"], len(points))
    node_sets = _sets(path, mesh["NOE"], len(points), families.get("NOEUD", {}))
    blocks, left_out = [], []
    for type, cells in mesh["MAI"].items() if "MAI" in mesh else ():
        if type in KIND_OF_TYPE:
            blocks.append(_block(path, type, cells, len(points), families.get("ELEME", {})))
        else:
            left_out.append(type)
    if left_out:
        notes.append(unread_note(f"cells of the kinds {', '.join(left_out)}"))
    counts = {"NOE": len(points), **{f"MAI.{TYPE_OF_KIND[block.kind]}": len(block) for block in blocks}}
    fields = read_fields(path, file, meshes[0], counts, notes)
    blocks = [replace(block, data={**fields[f"MAI.{TYPE_OF_KIND[block.kind]}"], **block.data}) for block in blocks]
    blocks.sort(key=lambda block: (block.kind not in HEX_KINDS, HEX_KINDS.get(block.kind, 0)))
    return Content(points, tuple(blocks), {**fields["NOE"], **node_ids}, node_sets, notes=tuple(notes))


def first_step(path: Path, name: str, mesh: Mapping, notes: list[str]) -> Mapping:
    """Group of the first step of a mesh, with its nodes (NOE) and cells (MAI)."""
    if int(mesh.attrs.get("TYP", 0)) != 0:
        raise FileError(path, f"the mesh {name} is structured", "Export it as an unstructured mesh.")
    if int(mesh.attrs.get("ESP", 3)) != 3:
        raise FileError(path, f"the mesh {name} is not in space", "Hexmend works in space.")
    if "NOE" in mesh:  # before version 3 a mesh has no steps
        return mesh
    steps = [step for step in mesh if "NOE" in mesh[step]]
    if not steps:
        raise FileError(path, f"the mesh {name} has no nodes (no NOE)", DAMAGED)
    if len(steps) > 1:
        notes.append(unread_note(f"all {len(steps)} steps of the mesh but the first"))
    return mesh[steps[0]]


def read_points(path: Path, mesh: Mapping) -> np.ndarray:
    """Coordinates of the nodes of a mesh, (n, 3) float64."""
    coordinates = read_array(path, mesh["NOE"], "COO")
    if coordinates.ndim != 1 or coordinates.size % 3 or coordinates.dtype.kind != "f":
        raise FileError(path, f"its {coordinates.size} coordinates are not three for each node", DAMAGED)
    return np.ascontiguousarray(coordinates.reshape(3, -1).T, np.float64)


def _block(path: Path, type: str, cells: Mapping, n_nodes: int, families: Mapping) -> Block:
    """Block of the cells of a geometric type."""
    kind = KIND_OF_TYPE[type]
    width = node_count(kind)
    numbers = read_array(path, cells, "NOD")
    if numbers.ndim != 1 or numbers.size % width or numbers.dtype.kind not in "iu":
        raise FileError(path, f"{type}/NOD holds {numbers.size} numbers: expected {width} a cell", DAMAGED)
    nodes = numbers.astype(np.int64).reshape(width, -1).T - 1
    check_numbers(path, f"{type}/NOD refers to the nodes", nodes, n_nodes)
    nodes = np.ascontiguousarray(to_vtk_order(nodes, kind, ORDER))
    return Block(kind, nodes, _ids(path, cells, len(nodes)), _sets(path, cells, len(nodes), families))


def _ids(path: Path, group: Mapping, count: int) -> dict[str, np.ndarray]:
    """Data of the ids of nodes or cells; none where the file has none."""
    return {ID: read_integers(path, group, "NUM", count)} if "NUM" in group else {}


def _sets(path: Path, group: Mapping, count: int, families: Mapping) -> dict[str, np.ndarray]:
    """Sets of nodes or cells: the members of a group are those of all families that belong to it."""
    if "FAM" not in group:
        return {}
    family_numbers = read_integers(path, group, "FAM", count)
    order = np.argsort(family_numbers, kind="stable")
    in_order, found, budget = family_numbers[order], {}, MemoryBudget(path, path.stat().st_size)
    for family in families.values():
        if "GRO" not in family:
            continue
        begin, end = np.searchsorted(in_order, [number := int(family.attrs["NUM"]), number + 1])
        names = decode_names(read_array(path, family["GRO"], "NOM")) if end > begin else []
        budget.charge(8 * len(names) * int(end - begin), "its groups")
        for name in names:
            found.setdefault(name, []).append(order[begin:end])
    return {name: np.sort(np.concatenate(members)) for name, members in found.items()}


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    return subprocess_reader.run_reader(f"{__name__}:coordinates", path)


def coordinates(path: Path) -> LocatedCoordinates:
    """Find the coordinates of the first step of the first mesh; run in a subprocess."""
    with hdf5.open_file(path) as file:
        notes, name = [], next(iter(file["ENS_MAA"]))
        mesh = first_step(path, name, file["ENS_MAA"][name], notes)
        only_first = ("Only the first step of the mesh gets new coordinates.",) if notes else ()
        return locate_datasets(path, read_points(path, mesh), [(mesh["NOE"]["COO"], ALL_COLUMNS)], only_first)
