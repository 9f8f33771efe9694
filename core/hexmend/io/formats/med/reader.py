"""The content of a MED file: its first mesh, groups as sets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content
from hexmend.io.formats.med.content import DAMAGED, KINDS, NAMES, ORDER, most_bytes, names_of, taken
from hexmend.io.formats.med.fields import read_fields
from hexmend.mesh.cells import CELL_KINDS


def content(path: Path) -> Content:
    """What a MED file holds."""
    with _opened(path) as file:
        return _content(path, file)


@contextmanager
def _opened(path: Path) -> Iterator[Mapping]:
    """The file; whatever HDF5 says against it becomes a `FileError`."""
    try:
        with hdf5.open_file(path) as file:
            yield file
    except (OSError, RuntimeError, LookupError, ValueError) as error:
        words = " ".join(str(error).strip("'\"").split())[:120]
        raise FileError(path, f"cannot be read as HDF5 ({words})", DAMAGED) from None
    except (TypeError, AttributeError, OverflowError):  # a link to nothing, an attribute of another kind
        raise FileError(path, "holds parts that are not what MED puts there", DAMAGED) from None


def _content(path: Path, file: Mapping) -> Content:
    if "ENS_MAA" not in file or not len(file["ENS_MAA"]):
        raise FileError(path, "holds no mesh (no ENS_MAA)", "Is it a MED file? Check its suffix.")
    meshes = list(file["ENS_MAA"])
    notes = []
    if len(meshes) > 1:
        notes.append(f"Of {len(meshes)} meshes the first, {meshes[0]}, is read.")
    mesh = file["ENS_MAA"][meshes[0]]
    if int(mesh.attrs.get("TYP", 0)) != 0:
        raise FileError(path, f"the mesh {meshes[0]} is structured", "Export it as an unstructured mesh.")
    if int(mesh.attrs.get("ESP", 3)) != 3:
        raise FileError(path, f"the mesh {meshes[0]} is not in space", "Hexmend works in space.")
    if "NOE" not in mesh:
        steps = [name for name in mesh if "NOE" in mesh[name]]
        if not steps:
            raise FileError(path, f"the mesh {meshes[0]} has no nodes (no NOE)", DAMAGED)
        if len(steps) > 1:
            notes.append(f"Of {len(steps)} steps of the mesh the first is read.")
        mesh = mesh[steps[0]]
    families = file["FAS"][meshes[0]] if "FAS" in file and meshes[0] in file["FAS"] else {}

    coordinates = taken(path, mesh["NOE"], "COO")
    if coordinates.ndim != 1 or coordinates.size % 3 or coordinates.dtype.kind != "f":
        raise FileError(path, f"its {coordinates.size} coordinates are not three for each node", DAMAGED)
    points = np.ascontiguousarray(coordinates.reshape(3, -1).T, np.float64)
    node_data = _ids(path, mesh["NOE"], len(points))
    node_sets = _sets(path, mesh["NOE"], len(points), families.get("NOEUD", {}))
    groups = families.get("ELEME", {})
    blocks, left = [], []
    for name, cells in mesh["MAI"].items() if "MAI" in mesh else ():
        if name not in KINDS:
            left.append(name)
            continue
        kind = KINDS[name]
        width = HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes
        numbers = taken(path, cells, "NOD")
        if numbers.ndim != 1 or numbers.size % width or numbers.dtype.kind not in "iu":
            raise FileError(path, f"{name}/NOD holds {numbers.size} numbers: expected {width} a cell", DAMAGED)
        nodes = numbers.astype(np.int64).reshape(width, -1).T - 1
        if nodes.size and (nodes.min() < 0 or nodes.max() >= len(points)):
            wrong = int(nodes[(nodes < 0) | (nodes >= len(points))][0]) + 1
            raise FileError(path, f"{name}/NOD names the node {wrong}: expected 1 to {len(points)}", DAMAGED)
        nodes = nodes[:, ORDER[kind]] if kind in ORDER else np.ascontiguousarray(nodes)
        blocks.append(Block(kind, nodes, _ids(path, cells, len(nodes)), _sets(path, cells, len(nodes), groups)))
    if left:
        notes.append(f"Cells of the kinds {', '.join(left)} are left out.")
    counts = {"NOE": len(points), **{f"MAI.{NAMES[block.kind]}": len(block) for block in blocks}}
    fields = read_fields(path, file, meshes[0], counts, notes)
    blocks = [replace(block, data={**fields[f"MAI.{NAMES[block.kind]}"], **block.data}) for block in blocks]
    node_data = {**fields["NOE"], **node_data}
    blocks.sort(key=lambda block: (block.kind not in HEX_KINDS, HEX_KINDS.get(block.kind, 0)))
    return Content(points, tuple(blocks), node_data, node_sets, notes=tuple(notes))


def _ids(path: Path, group: Mapping, count: int) -> dict[str, np.ndarray]:
    if "NUM" not in group:
        return {}
    numbers = taken(path, group, "NUM")
    if numbers.shape != (count,) or numbers.dtype.kind not in "iu":
        raise FileError(path, f"{group.name}/NUM holds {numbers.size} numbers: expected {count}", DAMAGED)
    return {ID: numbers.astype(np.int64)}


def _sets(path: Path, group: Mapping, count: int, families: Mapping) -> dict[str, np.ndarray]:
    """Sets of nodes or cells by the groups of their families."""
    if "FAM" not in group:
        return {}
    family = taken(path, group, "FAM")
    if family.shape != (count,) or family.dtype.kind not in "iu":
        raise FileError(path, f"{group.name}/FAM holds {family.size} numbers: expected {count}", DAMAGED)
    order = np.argsort(family, kind="stable")
    in_order, found, spent = family[order], {}, 0
    for one in families.values():
        if "GRO" not in one:
            continue
        begin, end = np.searchsorted(in_order, [number := int(one.attrs["NUM"]), number + 1])
        names = names_of(taken(path, one["GRO"], "NOM")) if end > begin else []
        spent += len(names) * int(end - begin)
        if spent > most_bytes(path):
            raise FileError(path, "its groups have far more members than so small a file can mean", DAMAGED)
        for name in names:
            found.setdefault(name, []).append(order[begin:end])
    return {name: np.sort(np.concatenate(members)) for name, members in found.items()}
