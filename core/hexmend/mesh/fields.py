"""Checks of the fields of a mesh other than points and hexes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.mesh.cells import CELL_KINDS, Cells
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from hexmend.mesh.validation import as_array, as_bools, as_integers, check_node_numbers, location


def check_field(field: str, value: object, nodes: int, hexes: int) -> object:
    """Check the value of a field of a mesh and make its arrays immutable; fields without a check are returned as is.

    Parameters
    ----------
    field : str
        Name of a field of `hexmend.Mesh`.
    value : object
    nodes, hexes : int
        Number of nodes and of hexes of the mesh.

    Returns
    -------
    object

    Raises
    ------
    MeshError
        For another type or shape, and for nodes, hexes or faces that do not exist.
    """
    if field in _TABLES:
        label, of_nodes, check = _TABLES[field]
        return _arrays(value, label, nodes if of_nodes else hexes, check)
    if field == "cells":
        return check_cells(value, nodes)
    if field == "pinned" and value is not None:
        return as_immutable(as_bools(value, "pinned", nodes))
    if field == "mid_nodes" and value is not None:
        return as_immutable(_as_mid_nodes(value, nodes, hexes))
    if field == "side_set_types":
        return _as_types(value)
    if field == "periodic_pairs":
        return _as_pairs(value)
    if field == "renumbered" and value not in ("", "parts", "hexes"):
        raise MeshError(f"renumbered is {value!r}: expected '', 'parts' or 'hexes'")
    return value


def _as_mid_nodes(mid_nodes: object, nodes: int, hexes: int) -> np.ndarray:
    """Convert the mid-nodes of second-order hexes to (m, 19) int32; see `hexmend.mesh.second_order`."""
    places, shape = ("hex", "mid-node"), (hexes, len(MID_NODE_POSITIONS))
    array = as_integers(mid_nodes, "mid_nodes", places)
    if array.shape != shape:
        raise MeshError(f"mid_nodes have shape {array.shape}: expected {shape}")
    check_node_numbers(array, nodes, places, -1)
    return np.ascontiguousarray(array, dtype=np.int32)


def as_set(values: object, label: str, count: int) -> np.ndarray:
    """Convert a named set to an array of integers (k,), each from 0 to `count` - 1.

    Parameters
    ----------
    values : (k,) array-like of whole numbers
    label : str
        Name of the set in messages.
    count : int
        Number of items of which the set is a part.

    Returns
    -------
    (k,) int

    Raises
    ------
    MeshError
        For another shape or type, and naming the first member that does not exist.
    """
    array = as_integers(values, label, ("member",))
    if array.ndim != 1:
        raise MeshError(f"{label} has shape {array.shape}: expected (k,)")
    _check_members(array, label, ("member",), (count,))
    return array


def as_numbers(values: object, label: str, count: int) -> np.ndarray:
    """Convert numbers or marks of items to numbers (k,), each from 0 to `count` - 1.

    Parameters
    ----------
    values : (k,) array-like of whole numbers, one number, or (count,) bool
    label : str
        Name of the values in messages.
    count : int

    Returns
    -------
    (k,) int

    Raises
    ------
    MeshError
        As for `as_set`, and for marks of another length.
    """
    given = as_array(values, label)
    if given.dtype == bool:
        return np.flatnonzero(as_bools(given, label, count))
    return as_set(np.atleast_1d(given), label, count)


def _as_side_set(values: object, label: str, hexes: int) -> np.ndarray:
    """Convert a named set of faces to an array of integers (k, 2): in each row a hex and one of its six faces."""
    array = as_integers(values, label, ("side", "column"))
    if not array.size:
        return array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise MeshError(f"{label} has shape {array.shape}: expected (k, 2), a hex and one of its faces in each row")
    _check_members(array, label, ("side", "column"), (hexes, 6))
    return array


def _as_types(value: object) -> dict[str, str]:
    """Copy the types of side sets after a check that names and types are texts."""
    if not isinstance(value, Mapping):
        raise MeshError(f"side_set_types: found {type(value).__name__}, expected a mapping of names to types")
    for name, kind in value.items():
        if not (isinstance(name, str) and isinstance(kind, str)):
            raise MeshError(f"side_set_types hold {name!r}: {kind!r}, expected texts")
    return dict(value)


def _as_pairs(value: object) -> tuple[tuple[str, str], ...]:
    """Convert pairs of periodic side sets to tuples after a check that each holds two names."""
    pairs = tuple(value) if isinstance(value, Iterable) and not isinstance(value, str) else (value,)
    for pair in pairs:
        if not (isinstance(pair, tuple | list) and len(pair) == 2 and all(isinstance(name, str) for name in pair)):
            raise MeshError(f"periodic_pairs hold {pair!r}: expected two names of side sets")
    return tuple((first, second) for first, second in pairs)


def _check_members(array: np.ndarray, label: str, places: tuple[str, ...], counts: tuple[int, ...]) -> None:
    for column, count in enumerate(counts):
        numbers = array if array.ndim == 1 else array[:, column]
        if numbers.size and (numbers.min() < 0 or numbers.max() >= count):
            at = int(np.flatnonzero((numbers < 0) | (numbers >= count))[0])
            raise MeshError(
                f"{label} has {numbers[at]} at {location(places, (at, column))}: expected numbers from 0 to {count - 1}"
            )


def _as_rows(values: object, label: str, count: int) -> np.ndarray:
    """Convert data to an array of `count` rows; raises `MeshError` for another number of rows."""
    array = as_array(values, label)
    if array.ndim == 0:
        raise MeshError(f"{label} is a single value: expected {count} rows")
    if len(array) != count:
        raise MeshError(f"{label} has {len(array)} rows: expected {count}")
    return array


def check_cells(value: object, nodes: int) -> tuple[Cells, ...]:
    """Check blocks of cells other than hexes of a mesh with so many nodes; raises `MeshError`."""
    if not isinstance(value, Iterable):
        raise MeshError(f"cells are of type {type(value).__name__}: expected a tuple of hexmend.Cells")
    return tuple(_check_cells(cells, nodes) for cells in value)


def _check_cells(cells: object, nodes: int) -> Cells:
    """Check cells other than hexes, with their data and sets, and make their arrays immutable."""
    if not isinstance(cells, Cells):
        raise MeshError(f"cells hold {type(cells).__name__}: expected hexmend.Cells")
    kind = cells.kind
    if not isinstance(kind, str) or kind not in CELL_KINDS:
        raise MeshError(f"there is no kind of cells {kind!r}: expected one of {', '.join(CELL_KINDS)}")
    places, width = (kind, "corner"), CELL_KINDS[kind].nodes
    array = as_integers(cells.nodes, f"{kind} cells", places)
    if array.ndim != 2 or array.shape[1] != width:
        raise MeshError(f"{kind} cells have shape {array.shape}: expected (k, {width})")
    check_node_numbers(array, nodes, places)
    return Cells(
        kind,
        as_immutable(np.asarray(array, dtype=np.int32)),
        _arrays(cells.data, f"data of {kind} cells", len(array), _as_rows),
        _arrays(cells.sets, f"set of {kind} cells", len(array), as_set),
    )


def _arrays(
    value: object, label: str, count: int, check: Callable[[object, str, int], np.ndarray]
) -> dict[str, np.ndarray]:
    """Check named arrays by a function of the array, its name in messages and a count; they become immutable."""
    if not isinstance(value, Mapping):
        raise MeshError(f"{label}: found {type(value).__name__}, expected a mapping of names to arrays")
    return {name: as_immutable(check(array, f"{label} {name!r}", count)) for name, array in value.items()}


#: Fields that are mappings: label of their arrays in messages, True for arrays of the nodes, and their check.
_TABLES = {
    "node_data": ("node data", True, _as_rows),
    "hex_data": ("hex data", False, _as_rows),
    "node_sets": ("node set", True, as_set),
    "hex_sets": ("hex set", False, as_set),
    "side_sets": ("side set", False, _as_side_set),
}
