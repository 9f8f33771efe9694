"""Checks of the arrays that make a mesh; kernels index with node numbers without checking them again."""

from __future__ import annotations

import operator
import weakref

import numpy as np

from hexmend.arrays import is_immutable
from hexmend.errors import MeshError
from hexmend.mesh.size_limits import MAX_HEXES, MAX_NODES

# Minimum and maximum of each immutable array that was checked, by its `id`, for as long as the array lives.
_known_ranges: dict[int, tuple[weakref.ref[np.ndarray], int, int]] = {}


def as_array(values: object, label: str) -> np.ndarray:
    """Convert values to an array of any type; raises `MeshError` if that fails, and for a masked value."""
    if isinstance(values, np.ndarray) and type(values) is not np.ndarray and np.ma.is_masked(values):
        raise MeshError(f"{label}: {np.ma.count_masked(values):,} of the values are masked; fill them in")
    try:
        return np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise MeshError(f"{label} cannot be made an array ({error}): expected rows of numbers of one length") from None


def as_reals(values: object, label: str) -> np.ndarray:
    """Convert values to contiguous float64; an array that is that already is returned itself.

    Parameters
    ----------
    values : array-like of real numbers
    label : str
        Name of the values in messages.

    Returns
    -------
    array of float64

    Raises
    ------
    MeshError
        For booleans, complex numbers, text and objects.
    """
    array = as_array(values, label)
    if not array.size:
        return np.zeros(array.shape)
    if array.dtype.kind not in "iuf":
        raise MeshError(f"{label} are of type {array.dtype}: expected real numbers, such as float64")
    return np.ascontiguousarray(array, dtype=np.float64)


def as_integers(values: object, label: str, places: tuple[str, ...]) -> np.ndarray:
    """Convert values to an array of integers; real numbers are accepted if all are whole.

    Parameters
    ----------
    values : array-like
    label : str
        Name of the values in messages.
    places : tuple of str
        Names of their rows and columns in messages, such as ("hex", "corner").

    Returns
    -------
    array of int

    Raises
    ------
    MeshError
        For booleans, complex numbers, text and objects, and naming the first number that is not whole.
    """
    array = as_array(values, label)
    if array.dtype.kind in "iu":
        return array
    if not array.size:
        return np.zeros(array.shape, np.int64)
    if array.dtype.kind != "f":
        raise MeshError(f"{label} are of type {array.dtype}: expected whole numbers, such as int32")
    array = array.astype(np.float64)
    wrong = ~(np.abs(array) < 2.0**53) | (array != np.trunc(array))  # nan and inf too
    if wrong.any():
        at = tuple(np.argwhere(wrong)[0].tolist())
        raise MeshError(f"{location(places, at)} is {array[at]:g} in {label}: expected a whole number")
    return array.astype(np.int64)


def location(names: tuple[str, ...], at: tuple[int, ...]) -> str:
    """Describe the position of a value in an array, for a message.

    >>> location(("hex", "corner"), (3, 7))
    'hex 3, corner 7 (counted from 0)'
    """
    return ", ".join(f"{name} {i}" for name, i in zip(names, at, strict=False)) + " (counted from 0)"


def as_bools(values: object, label: str, count: int) -> np.ndarray:
    """Convert values to (count,) bool; zeros and ones are accepted.

    Parameters
    ----------
    values : (count,) array-like
    label : str
        Name of the values in messages.
    count : int

    Returns
    -------
    (count,) bool

    Raises
    ------
    MeshError
        For another length and other values.
    """
    array = as_array(values, label)
    if array.shape != (count,):
        raise MeshError(f"{label} has shape {array.shape}: expected ({count},)")
    if array.dtype.kind != "b" and count:
        if array.dtype.kind not in "iuf":
            raise MeshError(f"{label} is of type {array.dtype}: expected true or false")
        wrong = np.flatnonzero((array != 0) & (array != 1))
        if wrong.size:
            raise MeshError(
                f"{label} is {array[wrong[0]]} at {location(('row',), (wrong[0],))}: expected true or false"
            )
    return np.ascontiguousarray(array, dtype=bool)


def as_points(points: object, label: str = "points") -> np.ndarray:
    """Convert points to contiguous (n, 3) float64; an array that is that already is returned itself.

    Parameters
    ----------
    points : (n, 3) array-like of real numbers
    label : str
        Name of the points in messages.

    Returns
    -------
    (n, 3) float64

    Raises
    ------
    MeshError
        For another shape or type, and for more nodes than 32 bits can number.
    """
    array = as_array(points, label)
    if array.ndim != 2 or array.shape[1] != 3:
        raise MeshError(f"{label} have shape {array.shape}: expected (n, 3)")
    if len(array) > MAX_NODES:
        raise MeshError(
            f"there are {len(array):,} nodes: expected {MAX_NODES:,} at most, because their numbers have 32 bits; "
            "divide the mesh"
        )
    return as_reals(array, label)


def points_like(points: object, shape: tuple[int, ...], label: str = "points") -> np.ndarray:
    """Convert points as `as_points` does; raises `MeshError` if they do not have the given shape (n, 3)."""
    array = as_points(points, label)
    if array.shape != shape:
        raise MeshError(f"{label} have shape {array.shape}: expected {shape}")
    return array


def as_hexes(hexes: object, nodes: int) -> np.ndarray:
    """Convert hexes to contiguous (m, 8) int32; an array that is that already is returned itself.

    Parameters
    ----------
    hexes : (m, 8) array-like of whole numbers
    nodes : int
        Number of nodes.

    Returns
    -------
    (m, 8) int32

    Raises
    ------
    MeshError
        For another shape or type, for a node that does not exist, and for more hexes than 32 bits can number.
    """
    array = as_array(hexes, "hexes")
    if array.ndim != 2 or array.shape[1] != 8:
        raise MeshError(f"hexes have shape {array.shape}: expected (m, 8)")
    if len(array) > MAX_HEXES:
        raise MeshError(
            f"there are {len(array):,} hexes: expected {MAX_HEXES:,} at most, because the numbers of their corners "
            "have 32 bits; divide the mesh"
        )
    array = as_integers(array, "hexes", ("hex", "corner"))
    check_node_numbers(array, nodes)
    return np.ascontiguousarray(array, dtype=np.int32)


def as_points_and_hexes(points: object, hexes: object) -> tuple[np.ndarray, np.ndarray]:
    """Return `as_points` of points and `as_hexes` of hexes among them."""
    points = as_points(points)
    return points, as_hexes(hexes, len(points))


def as_faces(faces: object, nodes: int) -> np.ndarray:
    """Convert faces of a surface, all triangles or all quads, to contiguous int32.

    Parameters
    ----------
    faces : (k, 3) or (k, 4) array-like of whole numbers
    nodes : int
        Number of nodes.

    Returns
    -------
    (k, 3) or (k, 4) int32

    Raises
    ------
    MeshError
        For another shape or type, and for a node that does not exist.
    """
    array = as_integers(faces, "faces", ("face", "corner"))
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise MeshError(f"faces have shape {array.shape}: expected (k, 3) or (k, 4)")
    check_node_numbers(array, nodes, ("face", "corner"))
    return np.ascontiguousarray(array, dtype=np.int32)


def check_node_numbers(
    numbers: np.ndarray, nodes: int, places: tuple[str, str] = ("hex", "corner"), low: int = 0
) -> None:
    """Check that node numbers exist.

    Parameters
    ----------
    numbers : (k, width) int array
    nodes : int
        Number of nodes.
    places : (str, str)
        Names of rows and columns in messages.
    low : int
        Smallest number allowed.

    Raises
    ------
    MeshError
        For a number out of range; the message names the first row that has one.
    """
    lowest, highest = _range(numbers)
    if lowest >= low and highest < nodes:
        return
    row, corner = np.argwhere((numbers < low) | (numbers >= nodes))[0].tolist()
    raise MeshError(
        f"{places[0]} {row} (counted from 0) uses the nodes {numbers[row].tolist()}, at {places[1]} {corner} node "
        f"{numbers[row, corner]}: expected numbers from {low} to {nodes - 1}"
    )


def _range(numbers: np.ndarray) -> tuple[int, int]:
    """Minimum and maximum of integers, (0, -1) without any; cached for immutable arrays."""
    known = _known_ranges.get(id(numbers))
    if known is not None and known[0]() is numbers:
        return known[1:]
    if not numbers.size:
        return 0, -1
    lowest, highest = int(numbers.min()), int(numbers.max())
    if is_immutable(numbers):
        key, pop = id(numbers), _known_ranges.pop  # at the end of the program the table may be gone
        _known_ranges[key] = weakref.ref(numbers, lambda _: pop(key, None)), lowest, highest
    return lowest, highest


def as_index(value: object, count: int, label: str) -> int:
    """Convert the number of a node or hex to an int.

    Parameters
    ----------
    value : int
    count : int
        Number of nodes or hexes.
    label : str
        "node" or "hex", for messages.

    Raises
    ------
    MeshError
        If it is not a whole number from 0 to `count` - 1.
    """
    expected = f"expected a whole number from 0 to {count - 1}"
    try:
        found = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise MeshError(f"{type(value).__name__} is not the number of a {label}: {expected}") from None
    if isinstance(value, bool | np.bool_) or not 0 <= found < count:
        raise MeshError(f"there is no {label} {value}: {expected}")
    return found


def check_finite(points: np.ndarray) -> None:
    """Raise `MeshError` if a coordinate of points (n, 3) is not finite; the message names the first such point."""
    if not np.isfinite(points).all():
        i = int(np.nonzero(~np.isfinite(points).all(axis=1))[0][0])
        raise MeshError(f"node {i} (counted from 0) has the coordinates {points[i].tolist()}: expected finite numbers")
