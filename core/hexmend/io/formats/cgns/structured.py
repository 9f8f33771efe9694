"""A structured zone of a CGNS file: hexes between nodes counted by i, then j, then k."""

from __future__ import annotations

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block
from hexmend.io.formats.cgns.tree import CGNSNode
from hexmend.io.formats.cgns.zone import (
    DAMAGED,
    Zone,
    add,
    conditions,
    coordinates,
    family,
    location_of,
    results,
    sizes,
)
from hexmend.mesh.orientation import MIRRORED_CORNERS, MIRRORED_FACES
from hexmend.quality import corner_determinants

#: The faces of hexes at the lower and the upper end of i, j and k.
FACES_AT = np.array([[0, 1], [2, 3], [4, 5]])


def structured(node: CGNSNode) -> Zone:
    """Read a structured zone.

    Where i, j and k are left-handed, which they may be, its hexes are turned.
    """
    count = sizes(node, 3)[0]
    if (count < 2).any():
        raise FileError(
            node.path, f"zone {node.name!r} has {count.tolist()} vertices along i, j, k: expected 2 or more"
        )
    points = coordinates(node, tuple(count[::-1].tolist()))
    hexes, mirrored = hexes_between(points, count)
    data = results(node, "CellCenter", tuple((count - 1)[::-1].tolist()))
    zone = Zone(node.name, family(node), points, shape=count)
    zone.blocks.append(Block("hex", hexes, data))
    zone.node_data = results(node, "Vertex", tuple(count[::-1].tolist()))
    _add_conditions(zone, node, count)
    if mirrored:
        for rows in zone.side_sets.values():
            rows[:, 1] = MIRRORED_FACES[rows[:, 1]]
    for parent in node.children("ZoneGridConnectivity_t"):
        for one in parent.children("GridConnectivity1to1_t"):
            ends = _interface(one, count)
            if ends is not None:
                zone.interfaces.append((one.text(), *ends))
    return zone


def hexes_between(points: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, bool]:
    """The hexes of a grid, and whether its i, j and k are left-handed, so that they have been turned.

    Parameters
    ----------
    points : (n, 3) float64
        i runs fastest.
    count : (3,) int
        Nodes along i, j and k, two or more.

    Returns
    -------
    (m, 8) int64, bool
    """
    i, j, k = (np.arange(n - 1) for n in count)
    corner = (i + count[0] * (j[:, None] + count[1] * k[:, None, None])).ravel()
    steps = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    hexes = corner[:, None] + steps @ [1, count[0], count[0] * count[1]]
    with np.errstate(all="ignore"):
        mirrored = np.count_nonzero(corner_determinants(points, hexes).sum(axis=1) < 0) > len(hexes) / 2
    return hexes[:, MIRRORED_CORNERS] if mirrored else hexes, bool(mirrored)


def _add_conditions(zone: Zone, node: CGNSNode, count: np.ndarray) -> None:
    """Boundary conditions: sides where they are a face of the zone, else nodes."""
    for name, condition in conditions(node):
        where = location_of(condition)
        spans = [one for one in condition.children("IndexRange_t") if one.name in ("PointRange", "ElementRange")]
        lists = [one for one in condition.children("IndexArray_t") if one.name in ("PointList", "ElementList")]
        if spans:
            low, high = np.sort(_rows(spans[0], 2), axis=0) - 1
            axes = np.flatnonzero(low == high)
            if where == "Vertex":
                _check(spans[0], np.stack([low, high]), count)
                flat = [axis for axis in axes if count[axis] > 1 and low[axis] in (0, count[axis] - 1)]
                if len(axes) == 1 and flat:
                    add(zone.side_sets, name, _sides(flat[0], low, high - 1, count))
                else:
                    add(
                        zone.node_sets,
                        name,
                        _nodes([np.arange(a, b + 1) for a, b in zip(low, high, strict=True)], count),
                    )
                continue
            axis = _axis_of(where, axes)
            if axis is None:
                zone.notes.append(f"Boundary condition {name!r} at {where} is left out.")
                continue
            _check(spans[0], np.stack([low, high]), count - (np.arange(3) != axis))
            add(zone.side_sets, name, _sides(axis, low, high, count))
        elif lists and where == "Vertex":
            rows = _rows(lists[0], None) - 1
            _check(lists[0], rows, count)
            add(zone.node_sets, name, rows @ [1, count[0], count[0] * count[1]])
        elif lists:
            zone.notes.append(f"Boundary condition {name!r}, a list of {where}, is left out.")


def _axis_of(where: str, axes: np.ndarray) -> int | None:
    if where in ("IFaceCenter", "JFaceCenter", "KFaceCenter"):
        return "IJK".index(where[0])
    return int(axes[0]) if where == "FaceCenter" and len(axes) == 1 else None


def _sides(axis: int, low: np.ndarray, high: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Hexes and faces of a layer of faces across an axis, from low to high of the cells along the others."""
    last = low[axis] == count[axis] - 1
    spans = [np.arange(a, b + 1) for a, b in zip(low, high, strict=True)]
    spans[axis] = np.array([low[axis] - last])
    cells = _nodes(spans, count - 1)
    return np.column_stack([cells, np.full(len(cells), FACES_AT[axis, int(last)])])


def _nodes(spans: list[np.ndarray], count: np.ndarray) -> np.ndarray:
    """Numbers of all nodes whose i, j and k are in three spans, i running fastest."""
    i, j, k = spans
    return (i + count[0] * (j[:, None] + count[1] * k[:, None, None])).ravel()


def _interface(node: CGNSNode, count: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Nodes of this zone, and the i, j, k of those of the donor: a pair of (n,) and (n, 3)."""
    spans = {one.name: _rows(one, 2) - 1 for one in node.children("IndexRange_t")}
    if "PointRange" not in spans or "PointRangeDonor" not in spans:
        return None
    transform = node.named("Transform")
    turn = transform.numbers().ravel() if transform is not None else np.array([1, 2, 3])
    if sorted(np.abs(turn).tolist()) != [1, 2, 3]:
        raise FileError(node.path, f"interface {node.name!r} has the transform {turn.tolist()}", DAMAGED)
    begin, end = spans["PointRange"]
    _check(node, spans["PointRange"], count)
    steps = [np.arange(abs(b - a) + 1) * (1 if b >= a else -1) for a, b in zip(begin, end, strict=True)]
    own = _nodes([a + step for a, step in zip(begin, steps, strict=True)], count)
    offset = np.stack([part.ravel() for part in np.meshgrid(*steps, indexing="ij")], axis=1)
    offset = offset.reshape(*(len(step) for step in steps), 3).transpose(2, 1, 0, 3).reshape(-1, 3)
    donor = np.empty_like(offset)
    donor[:, np.abs(turn) - 1] = offset * np.sign(turn)
    return own, donor + spans["PointRangeDonor"][0]


def _rows(node: CGNSNode, rows: int | None) -> np.ndarray:
    values = node.numbers()
    if values.ndim != 2 or values.shape[1] != 3 or (rows is not None and len(values) != rows):
        raise FileError(node.path, f"{node.name} has the shape {values.shape}: expected rows of i, j, k", DAMAGED)
    return values


def _check(node: CGNSNode, rows: np.ndarray, count: np.ndarray) -> None:
    """Raise `FileError` where an index from 0 is outside the zone."""
    if rows.size and ((rows < 0) | (rows >= count)).any():
        raise FileError(
            node.path, f"{node.name} reaches from {rows.min(axis=0) + 1} to {rows.max(axis=0) + 1} in {count}", DAMAGED
        )
