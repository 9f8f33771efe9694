"""Conversion of meshes to plain data with arrays for an archive, and back; shared arrays stay shared."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.cells import CELL_KINDS, Cells
from hexmend.mesh.mesh import Mesh, TargetSurface
from hexmend.mesh.rules.two_dimensional import with_two_dimensional_motion
from hexmend.mesh.size_limits import check_size
from hexmend.mesh.validation import check_finite, check_node_numbers

_TABLES = ("node_data", "hex_data", "node_sets", "hex_sets", "side_sets", "field_data")
_FIELDS = {
    "points", "hexes", "surface", "target", "pinned", "mid_nodes", "cells", "name", "notes", "side_set_types",
    "periodic_pairs", "renumbered", *_TABLES,
}  # fmt: skip
#: Fields that are set for each mesh; meshes with the same other fields share them.
_UNSHARED = {"points", "surface", "mid_nodes"}


def mesh_to_data(mesh: Mesh) -> dict[str, Any]:
    """Convert a mesh to plain data; "surface" and "target" hold the surface on which its boundary slides."""
    target = mesh.target
    return {
        "points": mesh.points,
        "hexes": mesh.hexes,
        "surface": mesh.surface_points,
        "target": target and {"points": target.points, "faces": target.faces, "name": target.name},
        "pinned": mesh.pinned,
        "mid_nodes": mesh.mid_nodes,
        "cells": [{"kind": c.kind, "nodes": c.nodes, "data": c.data, "sets": c.sets} for c in mesh.cells],
        "name": mesh.name,
        "notes": list(mesh.notes),
        "side_set_types": dict(mesh.side_set_types),
        "periodic_pairs": [list(pair) for pair in mesh.periodic_pairs],
        "renumbered": mesh.renumbered,
        **{table: dict(getattr(mesh, table)) for table in _TABLES},
    }


class MeshDecoder:
    """Converter of plain data to meshes; those with the same array of hexes share one topology."""

    def __init__(self) -> None:
        self._bare: dict[int, Mesh] = {}  # by id of the array of hexes
        self._carriers: dict[tuple, Mesh] = {}  # with all shared fields, by these
        self._targets: dict[tuple, TargetSurface] = {}

    def decode(self, data: Any) -> Mesh:
        """Make a mesh of the data from `mesh_to_data`.

        Raises
        ------
        MeshError
            For unknown or missing fields, and for invalid values.
        """
        check_fields("a mesh", data, _FIELDS)
        points, surface = (_array(data, name, "f", (-1, 3)) for name in ("points", "surface"))
        carrier, mid_nodes = self._carrier(data, points), data["mid_nodes"]
        mesh = carrier.with_points(surface).keeping_surface().with_points(points)
        if mid_nodes is not None:  # last, because with_points would move the mid-nodes and round points
            mesh = mesh.replace(mid_nodes=_array(data, "mid_nodes", "i", (len(mesh.hexes), 19)))
        return with_two_dimensional_motion(mesh)

    def _carrier(self, data: Mapping[str, Any], points: np.ndarray) -> Mesh:
        hexes = _array(data, "hexes", "i", (-1, 8))
        bare = self._bare.get(id(hexes))
        if bare is None or bare.n_nodes != len(points):
            bare = self._bare[id(hexes)] = Mesh(points, hexes)
        key = (id(bare), _key({name: data[name] for name in sorted(_FIELDS - _UNSHARED)}))
        if key not in self._carriers:
            carrier = bare.replace(**_decode_fields(data, bare))
            target = self._target(data["target"])
            self._carriers[key] = carrier if target is None else carrier.sliding_on(target, check=False)
        return self._carriers[key]

    def _target(self, data: Any) -> TargetSurface | None:
        """Surface on which the boundary slides; None if it is the boundary of the mesh itself."""
        if data is None:
            return None
        key = _key(data)
        if key not in self._targets:
            self._targets[key] = _decode_surface(data)
        return self._targets[key]


def check_fields(label: str, data: Any, known: set[str]) -> None:
    """Raise `MeshError` unless `data` is a dict with exactly the fields `known`; `label` names it in the error."""
    if not isinstance(data, dict):
        raise MeshError(f"{label} is not a table: expected the fields {', '.join(sorted(known))}")
    for name in sorted(data.keys() ^ known):
        raise MeshError(f"{label} has {'an unknown' if name in data else 'no'} field {name[:80]!r}")


def _key(value: Any) -> Any:
    """Hashable key of plain data, in which arrays count by identity."""
    if isinstance(value, dict):
        return tuple((name, _key(item)) for name, item in value.items())
    if isinstance(value, list):
        return tuple(map(_key, value))
    return ("array", id(value)) if isinstance(value, np.ndarray) else value


def _decode_fields(data: Mapping[str, Any], mesh: Mesh) -> dict[str, Any]:
    n, m = mesh.n_nodes, mesh.n_hexes
    for name in ("notes", "cells"):
        if not isinstance(data[name], list):
            raise MeshError(f"{name} is not a list")
    if not all(isinstance(line, str) for line in (data["name"], *data["notes"])):
        raise MeshError("the mesh's name or notes are not text")
    field_data = _table(data, "field_data")
    for name, values in field_data.items():
        texts = isinstance(values, list) and all(isinstance(text, str) for text in values)
        if not (texts or isinstance(values, np.ndarray | str | int | float)):
            raise MeshError(f"field data {name!r} is neither an array nor text")
    return {
        "pinned": None if data["pinned"] is None else _array(data, "pinned", "b", (n,)),
        "node_data": _values(data, "node_data", n),
        "hex_data": _values(data, "hex_data", m),
        "node_sets": _sets(data, "node_sets", n),
        "hex_sets": _sets(data, "hex_sets", m),
        "side_sets": _side_sets(data, m),
        "field_data": field_data,
        "cells": tuple(_cells(block, n) for block in data["cells"]),
        "name": data["name"],
        "notes": tuple(data["notes"]),
        "side_set_types": data["side_set_types"],
        "periodic_pairs": data["periodic_pairs"],
        "renumbered": data["renumbered"],
    }


def _decode_surface(data: Any) -> Any:
    from hexmend.boundary import SkinSurface  # late, for a quick start of commands

    check_fields("the surface that the boundary slides on", data, {"points", "faces", "name"})
    points, faces, name = data["points"], data["faces"], data["name"]
    width = faces.shape[1] if isinstance(faces, np.ndarray) and faces.ndim == 2 else 0
    if width not in (3, 4) or not len(faces) or not isinstance(name, str):
        raise MeshError("the surface that the boundary slides on has no triangles or quads, or no name")
    points, faces = _array(data, "points", "f", (-1, 3)), _array(data, "faces", "i", (-1, width))
    check_finite(points)
    check_size(points)
    if faces.min() < 0 or faces.max() >= len(points):
        raise MeshError(f"a face of {name!r} has a corner that is not from 0 to {len(points) - 1}")
    return SkinSurface(np.asarray(points, np.float64), np.ascontiguousarray(faces, np.int32), name)


def _array(data: Mapping[str, Any], name: str, kind: str, shape: tuple[int, ...]) -> np.ndarray:
    """Check an array of int ("i"), float ("f") or bool ("b"); -1 in `shape` stands for any length."""
    array = data[name]
    if not isinstance(array, np.ndarray):
        raise MeshError(f"{name} is not an array")
    fits = array.ndim == len(shape) and all(a in (-1, b) for a, b in zip(shape, array.shape, strict=True))
    if not fits or (array.dtype.kind != kind and not (kind == "i" and array.dtype.kind == "u")):
        raise MeshError(f"{name} has the shape {array.shape} of {array.dtype}: expected {shape} of kind {kind!r}")
    return array


def _table(data: Mapping[str, Any], name: str) -> dict[str, Any]:
    table = data[name]
    if not isinstance(table, dict):
        raise MeshError(f"{name} is not a table")
    return table


def _values(data: Mapping[str, Any], table: str, rows: int) -> dict[str, np.ndarray]:
    values = _table(data, table)
    for name, array in values.items():
        if not isinstance(array, np.ndarray) or array.ndim == 0 or len(array) != rows:
            raise MeshError(f"{table} {name!r} is not an array of {rows} rows")
    return values


def _sets(data: Mapping[str, Any], table: str, count: int) -> dict[str, np.ndarray]:
    sets = _table(data, table)
    for name in sets:
        members = _array(sets, name, "i", (-1,))
        if members.size and not 0 <= members.min() <= members.max() < count:
            raise MeshError(f"{table} {name!r} has a member that is not from 0 to {count - 1}")
    return sets


def _side_sets(data: Mapping[str, Any], hexes: int) -> dict[str, np.ndarray]:
    sets = _table(data, "side_sets")
    for name in sets:
        sides = _array(sets, name, "i", (-1, 2))
        if sides.size and not ((sides >= 0).all() and (sides < [hexes, 6]).all()):
            raise MeshError(f"side set {name!r} has a side of a hex that does not exist")
    return sets


def _cells(data: Any, n: int) -> Cells:
    check_fields("a block of cells", data, {"kind", "nodes", "data", "sets"})
    kind = data["kind"]
    if not isinstance(kind, str) or kind not in CELL_KINDS:
        raise MeshError(f"there is no kind of cells {str(kind)[:80]!r}")
    nodes = _array(data, "nodes", "i", (-1, CELL_KINDS[kind].nodes))
    if nodes.size:
        check_node_numbers(nodes, n)
    return Cells(kind, nodes, _values(data, "data", len(nodes)), _sets(data, "sets", len(nodes)))
