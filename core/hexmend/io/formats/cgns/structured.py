"""Structured zone of a CGNS file: hexes between vertices with indices i, j, k; i runs fastest."""

from __future__ import annotations

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.cgns.zone import CGNSNode, Interface, Zone, add_members, new_zone, zone_size
from hexmend.mesh.orientation import MIRRORED_CORNERS, MIRRORED_FACES
from hexmend.quality import corner_determinants

#: Faces, of `hexmend.mesh.hexahedron.FACES`, at the lower and the upper end of i, j and k.
_FACES_AT = np.array([[0, 1], [2, 3], [4, 5]])


def read_structured(node: CGNSNode) -> Zone:
    """Read a structured zone; the hexes of a left-handed grid are reordered to be right-handed.

    Raises
    ------
    FileError
        Where a part of the zone contradicts its size.
    """
    count = zone_size(node, 3)[0]
    if (count < 2).any():
        problem = f"zone {node.name!r} has {count.tolist()} vertices along i, j, k: expected 2 or more"
        raise FileError(node.path, problem)
    zone = new_zone(node, tuple(count[::-1].tolist()))
    zone.shape = count
    hexes, mirrored = structured_hexes(zone.points, count)
    zone.blocks.append(Block("hex", hexes, node.solution_arrays("CellCenter", tuple((count - 1)[::-1].tolist()))))
    for name, condition in node.boundary_conditions():
        _add_condition(zone, name, condition, count)
    if mirrored:
        for rows in zone.side_sets.values():
            rows[:, 1] = MIRRORED_FACES[rows[:, 1]]
    for connectivity in node.grandchildren("ZoneGridConnectivity_t", "GridConnectivity1to1_t"):
        interface = _interface(connectivity, count)
        zone.interfaces += [interface] if interface is not None else []
    return zone


def structured_hexes(points: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, bool]:
    """Hexes of a structured grid.

    Parameters
    ----------
    points : (n, 3) float64
        i runs fastest.
    count : (3,) int
        Vertices along i, j and k, two or more.

    Returns
    -------
    hexes : (m, 8) int64
    mirrored : bool
        True if i, j and k are left-handed, so that the corners of the hexes have been reordered.
    """
    corner = _node_numbers([np.arange(n - 1) for n in count], count)
    steps = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    hexes = corner[:, None] + steps @ [1, count[0], count[0] * count[1]]
    with np.errstate(all="ignore"):
        mirrored = np.count_nonzero(corner_determinants(points, hexes).sum(axis=1) < 0) > len(hexes) / 2
    return hexes[:, MIRRORED_CORNERS] if mirrored else hexes, bool(mirrored)


def _add_condition(zone: Zone, name: str, condition: CGNSNode, count: np.ndarray) -> None:
    """Add a boundary condition: a side set where it is a face of the zone, else a node set."""
    location = condition.text_of("GridLocation_t", "Vertex")
    ranges = [child for child in condition.children("IndexRange_t") if child.name in ("PointRange", "ElementRange")]
    lists = [child for child in condition.children("IndexArray_t") if child.name in ("PointList", "ElementList")]
    if ranges:
        _add_range(zone, name, location, ranges[0], count)
    elif lists and location == "Vertex":
        rows = _indices(lists[0], None) - 1
        _check_bounds(lists[0], rows, count)
        add_members(zone.node_sets, name, rows @ [1, count[0], count[0] * count[1]])
    elif lists:
        zone.notes.append(f"Boundary condition {name!r}, a list of {location}, is left out.")


def _add_range(zone: Zone, name: str, location: str, node: CGNSNode, count: np.ndarray) -> None:
    """Add a boundary condition of a range of vertices or faces."""
    low, high = np.sort(_indices(node, 2), axis=0) - 1
    axes = np.flatnonzero(low == high)
    if location == "Vertex":
        _check_bounds(node, np.stack([low, high]), count)
        normal = [axis for axis in axes if count[axis] > 1 and low[axis] in (0, count[axis] - 1)]
        if len(axes) == 1 and normal:
            add_members(zone.side_sets, name, _sides(normal[0], low, high - 1, count))
        else:
            add_members(zone.node_sets, name, _node_numbers(_spans(low, high), count))
        return
    axis = _axis_of(location, axes)
    if axis is None:
        zone.notes.append(f"Boundary condition {name!r} at {location} is left out.")
        return
    _check_bounds(node, np.stack([low, high]), count - (np.arange(3) != axis))
    add_members(zone.side_sets, name, _sides(axis, low, high, count))


def _axis_of(location: str, axes: np.ndarray) -> int | None:
    """Axis normal to the faces of a range, of its location or of the axes along which it is flat; None for neither."""
    if location in ("IFaceCenter", "JFaceCenter", "KFaceCenter"):
        return "IJK".index(location[0])
    return int(axes[0]) if location == "FaceCenter" and len(axes) == 1 else None


def _sides(axis: int, low: np.ndarray, high: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Side set, (k, 2), of the faces normal to an axis; low and high bound the cells along the other axes."""
    last = low[axis] == count[axis] - 1
    spans = _spans(low, high)
    spans[axis] = np.array([low[axis] - last])
    cells = _node_numbers(spans, count - 1)
    return np.column_stack([cells, np.full(len(cells), _FACES_AT[axis, int(last)])])


def _spans(low: np.ndarray, high: np.ndarray) -> list[np.ndarray]:
    """Indices from low to high along each axis."""
    return [np.arange(a, b + 1) for a, b in zip(low, high, strict=True)]


def _node_numbers(spans: list[np.ndarray], count: np.ndarray) -> np.ndarray:
    """Numbers, in a grid of `count`, of all nodes or cells with i, j and k in three spans; i runs fastest."""
    i, j, k = spans
    return (i + count[0] * (j[:, None] + count[1] * k[:, None, None])).ravel()


def _interface(node: CGNSNode, count: np.ndarray) -> Interface | None:
    """Interface of a GridConnectivity1to1_t node; None without its two ranges.

    SIDS, section 8.2: donor index = transform (index - begin) + donor begin.
    """
    ranges = {child.name: _indices(child, 2) - 1 for child in node.children("IndexRange_t")}
    if "PointRange" not in ranges or "PointRangeDonor" not in ranges:
        return None
    found = node.integers_of("Transform")
    transform = np.array([1, 2, 3]) if found is None else found
    if sorted(np.abs(transform).tolist()) != [1, 2, 3]:
        raise FileError(node.path, f"interface {node.name!r} has the transform {transform.tolist()}", DAMAGED)
    begin, end = ranges["PointRange"]
    _check_bounds(node, ranges["PointRange"], count)
    steps = [np.arange(abs(b - a) + 1) * (1 if b >= a else -1) for a, b in zip(begin, end, strict=True)]
    nodes = _node_numbers([a + step for a, step in zip(begin, steps, strict=True)], count)
    offset = np.stack([part.ravel() for part in np.meshgrid(*steps, indexing="ij")], axis=1)
    offset = offset.reshape(*(len(step) for step in steps), 3).transpose(2, 1, 0, 3).reshape(-1, 3)
    donor = np.empty_like(offset)
    donor[:, np.abs(transform) - 1] = offset * np.sign(transform)
    return Interface(node.text(), nodes, donor + ranges["PointRangeDonor"][0])


def _indices(node: CGNSNode, rows: int | None) -> np.ndarray:
    """Indices i, j, k of a node, (rows, 3), from 1."""
    values = node.integers()
    if values.ndim != 2 or values.shape[1] != 3 or (rows is not None and len(values) != rows):
        raise FileError(node.path, f"{node.name} has the shape {values.shape}: expected rows of i, j, k", DAMAGED)
    return values


def _check_bounds(node: CGNSNode, rows: np.ndarray, count: np.ndarray) -> None:
    """Raise `FileError` for an index, from 0, outside the zone."""
    if rows.size and ((rows < 0) | (rows >= count)).any():
        span = f"from {rows.min(axis=0) + 1} to {rows.max(axis=0) + 1}"
        raise FileError(node.path, f"{node.name} reaches {span} in {count}", DAMAGED)
