"""Ids of nodes and elements: lookup on reading, choice on writing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import ID, Block, Content, from_mesh
from hexmend.io.base.remedies import DAMAGED
from hexmend.mesh.mesh import Mesh

#: Ids are smaller than this in limit formats.
ID_LIMIT = 2**31
#: And smaller than this where a column holds 8 digits.
COLUMN_LIMIT = 100_000_000


def find_ids(path: Path, ids: np.ndarray, wanted: np.ndarray, label: str) -> np.ndarray:
    """Look up the indices of ids.

    Parameters
    ----------
    path : Path
        Named in errors.
    ids : (n,) int
        Ids of the file, in any order.
    wanted : (...) int
        Ids to look up.
    label : str
        "node" or "element", for errors.

    Returns
    -------
    (...) int
        Indices with `ids[indices] == wanted`.

    Raises
    ------
    FileError
        For an id that is missing or given twice.

    Examples
    --------
    >>> find_ids(Path("a.msh"), np.array([30, 10, 20]), np.array([[10, 30]]), "node")
    array([[1, 0]])
    """
    n = len(ids)
    if n and ids[0] == 1 and ids[-1] == n and _rise_by_one(ids):
        if wanted.size and wanted.min() >= 1 and wanted.max() <= n:  # without arrays of marks
            return np.subtract(wanted, 1, dtype=np.int32 if n < ID_LIMIT else np.int64, casting="unsafe")
        found, wrong = wanted, (wanted < 1) | (wanted > n)
    else:
        order = np.argsort(ids, kind="stable")
        in_order = ids[order]
        twice = np.flatnonzero(in_order[1:] == in_order[:-1])
        if twice.size:
            number = int(in_order[twice[0]])
            raise FileError(path, f"{label} {number} is given twice", "Give every one a number of its own.")
        found, there = lookup(ids, wanted, order)
        wrong = ~there
    if np.any(wrong):
        number = int(np.asarray(wanted)[wrong].flat[0])
        problem = f"{label} {number} is used, but the file has no such {label}"
        raise FileError(path, problem, "Add it, or correct what uses it.")
    return found


def lookup(ids: np.ndarray, wanted: np.ndarray, order: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Look up ids, whether they are there or not.

    Parameters
    ----------
    ids : (n,) int64
        In any order.
    wanted : (...) int
    order : (n,) int64, optional
        Their ascending order, if it is known.

    Returns
    -------
    index : (...) int64
    there : (...) bool
        False where an id is not there, and the index means nothing.
    """
    if not len(ids):
        return np.zeros(np.shape(wanted), np.int64), np.zeros(np.shape(wanted), bool)
    order = np.argsort(ids, kind="stable") if order is None else order
    index = order[np.minimum(np.searchsorted(ids, wanted, sorter=order), len(ids) - 1)]
    return index, ids[index] == wanted


def _rise_by_one(ids: np.ndarray) -> bool:
    """Return True if each of the ids (n,) is one more than the one before it."""
    step = 1 << 18  # ids at a time, to limit the memory
    return all((np.diff(ids[begin : begin + step + 1]) == 1).all() for begin in range(0, len(ids), step))


def node_ids(data: dict[str, np.ndarray], count: int, limit: int = ID_LIMIT) -> np.ndarray:
    """Choose the ids of nodes for a file: the mesh's ids if the format supports them, else from 1.

    Parameters
    ----------
    data : mapping of str to (count, ...) array
        Node data, of which "id" holds the ids of the mesh.
    count : int
    limit : int
        Ids of the format are smaller than this.

    Returns
    -------
    (count,) int64
    """
    ids = _usable(data.get(ID), count, limit)
    return np.arange(1, count + 1) if ids is None or len(np.unique(ids)) < count else ids


def element_ids(blocks: Sequence[Block], limit: int = ID_LIMIT) -> list[np.ndarray]:
    """Choose the ids of elements for a file: the mesh's ids if the format supports them.

    Blocks without usable ids get the following numbers; ids are unique.

    Parameters
    ----------
    blocks : sequence of Block
    limit : int
        Ids of the format are smaller than this.

    Returns
    -------
    list of (k,) int64
        Ids of each block.
    """
    ids = [_usable(block.data.get(ID), len(block), limit) for block in blocks]
    known = [numbers for numbers in ids if numbers is not None]
    taken = np.concatenate([*known, np.zeros(0, np.int64)])
    if len(np.unique(taken)) < taken.size:
        ids, taken = [None] * len(blocks), taken[:0]
    following = int(taken.max(initial=0)) + 1
    answer = []
    for block, numbers in zip(blocks, ids, strict=True):
        if numbers is None:
            numbers = np.arange(following, following + len(block))
            following += len(block)
        answer.append(numbers)
    return answer


def ids_of_columns(path: Path, content: Content) -> tuple[np.ndarray, list[np.ndarray]]:
    """Choose the ids of nodes and of the elements of each block for a file with columns of 8 digits.

    Raises
    ------
    FileError
        For more nodes or elements than numbers of 8 digits.
    """
    of_nodes = node_ids(dict(content.node_data), len(content.points), COLUMN_LIMIT)
    of_elements = element_ids(content.blocks, COLUMN_LIMIT)
    if max(int(of_nodes.max()), *(int(ids.max(initial=0)) for ids in of_elements)) >= COLUMN_LIMIT:
        raise FileError(path, "a number of a node or element has more than 8 digits", "Write .vtu or .msh instead.")
    return of_nodes, of_elements


def first_out_of_range(values: np.ndarray, count: int) -> int | None:
    """Return the first value that is not from 0 to count - 1; None if there is none."""
    if not values.size or (values.min() >= 0 and values.max() < count):
        return None
    return int(values[(values < 0) | (values >= count)].flat[0])


def check_numbers(path: Path, label: str, numbers: np.ndarray, count: int) -> None:
    """Raise a `FileError` unless all numbers are from 0 to count - 1; `label` begins it: "block 1 uses the nodes"."""
    if first_out_of_range(numbers, count) is not None:
        problem = f"{label} {numbers.min() + 1} to {numbers.max() + 1}: expected 1 to {count}"
        raise FileError(path, problem, DAMAGED)


def runs(*keys: np.ndarray) -> list[slice]:
    """Split n entries into runs over which several arrays are constant.

    Parameters
    ----------
    *keys : (n,) array

    Returns
    -------
    list of slice

    Examples
    --------
    >>> runs(np.array([4, 4, 7, 4]))
    [slice(0, 2, None), slice(2, 3, None), slice(3, 4, None)]
    """
    n = len(keys[0])
    if n == 0:
        return []
    changes = np.zeros(n - 1, bool)
    for key in keys:
        changes |= key[1:] != key[:-1]
    ends = [0, *(np.flatnonzero(changes) + 1).tolist(), n]
    return [slice(begin, end) for begin, end in pairwise(ends)]


def set_combinations(sets: Mapping[str, np.ndarray], count: int) -> tuple[list[list[str]], np.ndarray]:
    """Find the combinations of sets that occur, and the combination of each member.

    Parameters
    ----------
    sets : mapping of str to (k,) int array
        Members, from 0 to count - 1.
    count : int

    Returns
    -------
    combinations : list of list of str
        Names of the sets.
    which : (count,) int
        Index of the combination of each member.

    Examples
    --------
    >>> found, which = set_combinations({"a": [0, 1], "b": [1]}, 3)
    >>> [found[k] for k in which]
    [['a'], ['a', 'b'], []]
    """
    names = list(sets)
    members = [np.unique(np.asarray(sets[name], np.int64)) for name in names]
    marks = np.zeros(count, np.uint64)  # sum of a random number for each set: unique for each combination
    weights = np.random.default_rng(0).integers(1, 2**63, len(names)).astype(np.uint64)
    for rows, weight in zip(members, weights, strict=True):
        marks[rows] += weight
    _, first, which = np.unique(marks, return_index=True, return_inverse=True)
    found: list[list[str]] = [[] for _ in first]
    for name, rows in zip(names, members, strict=True):
        for k in np.flatnonzero(np.isin(first, rows)).tolist():
            found[k].append(name)
    return found, which


def fit_64_bits(ids: np.ndarray) -> bool:
    """Return True if whole numbers are below 2^63, as formats with signed numbers hold them."""
    return ids.dtype.kind != "u" or not ids.size or int(ids.max()) < 2**63


def unsupported_ids(mesh: Mesh, limit: int = ID_LIMIT) -> list[str]:
    """Describe the ids that a file numbered from 1 cannot store, so that nodes or elements are renumbered.

    Parameters
    ----------
    mesh : Mesh
    limit : int
        Ids of the format are smaller than this.

    Returns
    -------
    list of str
        Phrases for a message; empty if all ids can be stored.
    """
    content, phrases = from_mesh(mesh), []
    ids = content.node_data.get(ID)
    if ids is not None and (reason := _reason(ids, len(content.points), limit) or _repeated([ids])):
        phrases.append(f"ids of nodes ({reason})")
    known = [(block.data[ID], len(block)) for block in content.blocks if ID in block.data and len(block)]
    reasons = [reason for ids, count in known if (reason := _reason(ids, count, limit))]
    if reasons or (reasons := [reason for reason in [_repeated([ids for ids, _ in known])] if reason]):
        phrases.append(f"ids of elements ({', '.join(dict.fromkeys(reasons))})")
    return phrases


def _usable(ids: np.ndarray | None, count: int, limit: int) -> np.ndarray | None:
    """Ids as (count,) int64; None if the format cannot store them."""
    return None if ids is None or count == 0 or _reason(ids, count, limit) else np.asarray(ids).astype(np.int64)


def _reason(ids: np.ndarray, count: int, limit: int) -> str:
    """Reason why ids are not whole numbers from 1 to limit - 1; empty if they are."""
    ids = np.asarray(ids)
    if ids.shape != (count,) or ids.dtype.kind not in "iu":
        return "no whole numbers"
    if count and ids.min() < 1:
        return "some below 1"
    return f"some of {'2^31' if limit == ID_LIMIT else f'{limit:,}'} and above" if count and ids.max() >= limit else ""


def _repeated(ids: Sequence[np.ndarray]) -> str:
    every = np.concatenate([np.zeros(0, np.int64), *ids])
    return "some given twice" if len(np.unique(every)) < every.size else ""
