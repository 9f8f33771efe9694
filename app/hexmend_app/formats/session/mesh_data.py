"""Conversion of meshes to plain data with arrays for an archive, and back; shared arrays stay shared."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh, TargetSurface
from hexmend.mesh.rules.two_dimensional import with_two_dimensional_motion
from hexmend.mesh.size_limits import check_size
from hexmend.mesh.validation import as_points, check_finite

_TABLES = ("node_data", "hex_data", "node_sets", "hex_sets", "side_sets", "field_data")
_FIELDS = {
    "points", "hexes", "surface", "target", "pinned", "mid_nodes", "cells", "name", "notes", "side_set_types",
    "periodic_pairs", "renumbered", *_TABLES,
}  # fmt: skip
#: Fields that are set for each mesh; meshes with the same other fields share them.
_UNSHARED = {"points", "surface", "mid_nodes"}
#: Fields that are those of `Mesh.replace`.
_REPLACED = _FIELDS - _UNSHARED - {"hexes", "target"}


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
    """Converter of plain data to meshes; those with the same arrays of cells share one topology."""

    def __init__(self) -> None:
        self._bare: dict[tuple, Mesh] = {}  # by the arrays of hexes and other cells
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
        points, surface = as_points(data["points"]), as_points(data["surface"])
        carrier, mid_nodes = self._carrier(data, points), data["mid_nodes"]
        mesh = carrier.with_points(surface).keeping_surface().with_points(points)
        if mid_nodes is not None:  # last, because with_points would move the mid-nodes and round points
            mesh = mesh.replace(mid_nodes=mid_nodes)
        return with_two_dimensional_motion(mesh)

    def _carrier(self, data: Mapping[str, Any], points: np.ndarray) -> Mesh:
        fields = _decode_fields(data)
        rows = _key([data["hexes"], *([block["kind"], block["nodes"]] for block in data["cells"])])
        bare = self._bare.get(rows)
        if bare is None or bare.n_nodes != len(points):
            bare = self._bare[rows] = Mesh(points, data["hexes"], cells=fields["cells"])
        key = (id(bare), _key({name: data[name] for name in sorted(_FIELDS - _UNSHARED)}))
        if key not in self._carriers:
            carrier = bare.replace(**fields)
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


def _decode_fields(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields for `Mesh.replace`, which checks all but the texts and the field data."""
    for name in ("notes", "cells"):
        if not isinstance(data[name], list):
            raise MeshError(f"{name} is not a list")
    if not all(isinstance(line, str) for line in (data["name"], *data["notes"])):
        raise MeshError("the mesh's name or notes are not text")
    if not isinstance(data["field_data"], dict):
        raise MeshError("field_data is not a table")
    for name, values in data["field_data"].items():
        texts = isinstance(values, list) and all(isinstance(text, str) for text in values)
        if not (texts or isinstance(values, np.ndarray | str | int | float)):
            raise MeshError(f"field data {name!r} is neither an array nor text")
    for block in data["cells"]:
        check_fields("a block of cells", block, {"kind", "nodes", "data", "sets"})
    blocks = tuple(Cells(**block) for block in data["cells"])
    return {name: data[name] for name in _REPLACED} | {"notes": tuple(data["notes"]), "cells": blocks}


def _decode_surface(data: Any) -> Any:
    from hexmend.boundary import SkinSurface  # loads scipy, which most sessions do not need

    check_fields("the surface that the boundary slides on", data, {"points", "faces", "name"})
    surface = SkinSurface(data["points"], data["faces"], data["name"])
    if not len(surface.faces) or not isinstance(surface.name, str):
        raise MeshError("the surface that the boundary slides on has no faces, or no name")
    check_finite(surface.points)
    check_size(surface.points)
    return surface
