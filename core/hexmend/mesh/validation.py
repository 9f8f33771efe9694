"""Checks of the arrays that make a mesh. Kernels use node numbers without another look, so nothing passes unchecked."""

from __future__ import annotations

import operator
import weakref

import numpy as np

from hexmend.arrays import is_immutable
from hexmend.errors import MeshError
from hexmend.mesh.size_limits import MAX_HEXES, MAX_NODES

# Lowest and highest number in each immutable array that was checked, by its `id`, for as long as the array lives.
_known_ranges: dict[int, tuple[weakref.ref, int, int]] = {}


def as_array(values: object, what: str) -> np.ndarray:
    """Values as an array of any type; `MeshError` where they make none, as rows of different lengths."""
    try:
        return np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise MeshError(f"{what} cannot be made an array ({error}): expected rows of numbers of one length") from None


def as_reals(values: object, what: str) -> np.ndarray:
    """Values as float64, contiguous; the same array where it is that already.

    Raises
    ------
    MeshError
        For booleans, complex numbers, text and objects.
    """
    array = as_array(values, what)
    if not array.size:
        return np.zeros(array.shape)
    if array.dtype.kind not in "iuf":
        raise MeshError(f"{what} are of type {array.dtype}: expected real numbers, such as float64")
    return np.ascontiguousarray(array, dtype=np.float64)


def as_integers(values: object, what: str, places: tuple[str, ...]) -> np.ndarray:
    """Values as an array of integers; reals are taken where all of them are whole.

    Parameters
    ----------
    values : array-like
    what : str
        What to call them in a message.
    places : tuple of str
        What to call their rows and columns: ("hex", "corner").

    Raises
    ------
    MeshError
        For booleans, complex numbers, text and objects, and naming the first number that is not whole.
    """
    array = as_array(values, what)
    if array.dtype.kind in "iu":
        return array
    if not array.size:
        return np.zeros(array.shape, np.int64)
    if array.dtype.kind != "f":
        raise MeshError(f"{what} are of type {array.dtype}: expected whole numbers, such as int32")
    array = array.astype(np.float64)
    wrong = ~(np.abs(array) < 2.0**53) | (array != np.trunc(array))  # nan and inf too
    if wrong.any():
        at = tuple(np.argwhere(wrong)[0].tolist())
        raise MeshError(f"{location(places, at)} is {array[at]:g} in {what}: expected a whole number")
    return array.astype(np.int64)


def location(names: tuple[str, ...], at: tuple[int, ...]) -> str:
    """Where a value is in an array, for a message.

    >>> location(("hex", "corner"), (3, 7))
    'hex 3, corner 7 (counted from 0)'
    """
    return ", ".join(f"{name} {i}" for name, i in zip(names, at, strict=False)) + " (counted from 0)"


def as_bools(values: object, what: str, count: int) -> np.ndarray:
    """Values as (count,) bool; zeros and ones are taken for them.

    Raises
    ------
    MeshError
        For another length and other values.
    """
    array = as_array(values, what)
    if array.shape != (count,):
        raise MeshError(f"{what} has shape {array.shape}: expected ({count},)")
    if array.dtype.kind != "b" and count:
        if array.dtype.kind not in "iuf":
            raise MeshError(f"{what} is of type {array.dtype}: expected true or false")
        wrong = np.flatnonzero((array != 0) & (array != 1))
        if wrong.size:
            raise MeshError(f"{what} is {array[wrong[0]]} at {location(('row',), (wrong[0],))}: expected true or false")
    return np.ascontiguousarray(array, dtype=bool)


def as_points(points: object, what: str = "points") -> np.ndarray:
    """Points as (n, 3) float64, contiguous; the same array where it is that already.

    Raises
    ------
    MeshError
        For another shape or type, and for more nodes than 32 bits can number.
    """
    array = as_array(points, what)
    if array.ndim != 2 or array.shape[1] != 3:
        raise MeshError(f"{what} have shape {array.shape}: expected (n, 3)")
    if len(array) > MAX_NODES:
        raise MeshError(
            f"there are {len(array):,} nodes: expected {MAX_NODES:,} at most, because their numbers have 32 bits; "
            "divide the mesh"
        )
    return as_reals(array, what)


def points_like(points: object, shape: tuple[int, ...], what: str = "points") -> np.ndarray:
    """Points as `as_points` gives them; `MeshError` where they are not of this shape, (n, 3)."""
    array = as_points(points, what)
    if array.shape != shape:
        raise MeshError(f"{what} have shape {array.shape}: expected {shape}")
    return array


def as_hexes(hexes: object, nodes: int) -> np.ndarray:
    """Hexes as (m, 8) int32, contiguous; the same array where it is that already.

    Parameters
    ----------
    hexes : (m, 8) array-like of whole numbers
    nodes : int
        Number of nodes.

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


def as_faces(faces: object, nodes: int) -> np.ndarray:
    """Faces of a surface, all triangles or all quads, as (k, 3) or (k, 4) int32, contiguous.

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
    """Raise `MeshError` naming the first row of integers (k, width) that uses a node which is none of `nodes`.

    Parameters
    ----------
    numbers : (k, width) int array
    nodes : int
    places : (str, str)
        What to call rows and columns.
    low : int
        The least number that is allowed.
    """
    least, greatest = _range(numbers)
    if least >= low and greatest < nodes:
        return
    row, corner = np.argwhere((numbers < low) | (numbers >= nodes))[0].tolist()
    raise MeshError(
        f"{places[0]} {row} (counted from 0) uses the nodes {numbers[row].tolist()}, at {places[1]} {corner} node "
        f"{numbers[row, corner]}: expected numbers from {low} to {nodes - 1}"
    )


def _range(numbers: np.ndarray) -> tuple[int, int]:
    """The lowest and the highest of some integers, (0, -1) of none; of an immutable array found once."""
    known = _known_ranges.get(id(numbers))
    if known is not None and known[0]() is numbers:
        return known[1:]
    if not numbers.size:
        return 0, -1
    least, greatest = int(numbers.min()), int(numbers.max())
    if is_immutable(numbers):
        key = id(numbers)
        _known_ranges[key] = weakref.ref(numbers, lambda _, pop=_known_ranges.pop: pop(key, None)), least, greatest
    return least, greatest


def as_index(value: object, count: int, what: str) -> int:
    """The number of a node or hex as an int.

    Raises
    ------
    MeshError
        Unless it is a whole number from 0 to `count` - 1.
    """
    expected = f"expected a whole number from 0 to {count - 1}"
    try:
        found = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise MeshError(f"{type(value).__name__} is no number of a {what}: {expected}") from None
    if isinstance(value, bool | np.bool_) or not 0 <= found < count:
        raise MeshError(f"there is no {what} {value}: {expected}")
    return found


def check_finite(points: np.ndarray) -> None:
    """Raise `MeshError` naming the first of points (n, 3) whose coordinates are not all finite."""
    if not np.isfinite(points).all():
        i = int(np.nonzero(~np.isfinite(points).all(axis=1))[0][0])
        raise MeshError(f"node {i} (counted from 0) has the coordinates {points[i].tolist()}: expected finite numbers")
