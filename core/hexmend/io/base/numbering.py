"""The file's own numbers of nodes and elements: found on reading, kept on writing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import ID, Block, from_mesh
from hexmend.mesh.mesh import Mesh


def find_ids(path: Path, ids: np.ndarray, wanted: np.ndarray, what: str) -> np.ndarray:
    """Where numbers stand among those of the file.

    Parameters
    ----------
    path : Path
        The file; errors name it.
    ids : (n,) int
        The file's numbers, in any order.
    wanted : (...) int
    what : str
        What is numbered, for errors: "node" or "element".

    Returns
    -------
    (...) int64
        `ids[places] == wanted`.

    Raises
    ------
    FileError
        For a number that the file has not, or has twice.

    Examples
    --------
    >>> find_ids(Path("a.msh"), np.array([30, 10, 20]), np.array([[10, 30]]), "node")
    array([[1, 0]])
    """
    n = len(ids)
    if n and ids[0] == 1 and ids[-1] == n and np.array_equal(ids, np.arange(1, n + 1)):
        found, wrong = np.asarray(wanted, np.int64) - 1, (wanted < 1) | (wanted > n)
    else:
        order = np.argsort(ids, kind="stable")
        in_order = ids[order]
        twice = np.flatnonzero(in_order[1:] == in_order[:-1])
        if twice.size:
            number = int(in_order[twice[0]])
            raise FileError(path, f"{what} {number} is given twice", "Give every one a number of its own.")
        if n == 0:
            found, wrong = np.zeros(np.shape(wanted), np.int64), np.ones(np.shape(wanted), bool)
        else:
            at = np.minimum(np.searchsorted(in_order, wanted), n - 1)
            found, wrong = order[at], in_order[at] != wanted
    if np.any(wrong):
        number = int(np.asarray(wanted)[wrong].flat[0])
        raise FileError(
            path, f"{what} {number} is used, but the file has no such {what}", "Add it, or correct what uses it."
        )
    return found


#: Numbers of nodes and elements are below this in most formats.
ID_LIMIT = 2**31


def node_ids(data: dict[str, np.ndarray], count: int, most: int = ID_LIMIT) -> np.ndarray:
    """Numbers under which nodes are written, (count,) int64: their ids where these are usable, else from 1.

    Parameters
    ----------
    data : mapping of name to (count, ...) array
    count : int
    most : int
        Ids from this on are none that the format can have.
    """
    ids = _usable(data.get(ID), count, most)
    return np.arange(1, count + 1) if ids is None or len(np.unique(ids)) < count else ids


def element_ids(blocks: Sequence[Block], most: int = ID_LIMIT) -> list[np.ndarray]:
    """Numbers under which the elements of blocks are written: their ids where these are usable, others after them.

    No two elements have the same one.

    Parameters
    ----------
    blocks : sequence of Block
    most : int
        Ids from this on are none that the format can have.
    """
    ids = [_usable(block.data.get(ID), len(block), most) for block in blocks]
    known = [one for one in ids if one is not None]
    taken = np.concatenate([*known, np.zeros(0, np.int64)])
    if len(np.unique(taken)) < taken.size:
        ids, taken = [None] * len(blocks), taken[:0]
    following = int(taken.max(initial=0)) + 1
    answer = []
    for block, one in zip(blocks, ids, strict=True):
        if one is None:
            one = np.arange(following, following + len(block))
            following += len(block)
        answer.append(one)
    return answer


def runs(*keys: np.ndarray) -> list[slice]:
    """Stretches over which every one of some (n,) arrays stays the same, in order.

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
    """The combinations of sets that things are in, and which of them each of `count` things is in, (count,) int.

    Examples
    --------
    >>> found, which = set_combinations({"a": [0, 1], "b": [1]}, 3)
    >>> [found[k] for k in which]
    [['a'], ['a', 'b'], []]
    """
    names = list(sets)
    members = [np.unique(np.asarray(sets[name], np.int64)) for name in names]
    marks = np.zeros(count, np.uint64)  # sums of random numbers, one a set, tell the combinations apart
    weights = np.random.default_rng(0).integers(1, 2**63, len(names)).astype(np.uint64)
    for rows, weight in zip(members, weights, strict=True):
        marks[rows] += weight
    _, first, which = np.unique(marks, return_index=True, return_inverse=True)
    found: list[list[str]] = [[] for _ in first]
    for name, rows in zip(names, members, strict=True):
        for k in np.flatnonzero(np.isin(first, rows)).tolist():
            found[k].append(name)
    return found, which


def unsupported_ids(mesh: Mesh, most: int = ID_LIMIT) -> list[str]:
    """Ids of a mesh that a file numbered from 1 cannot have, in words; its nodes or elements are numbered anew.

    Parameters
    ----------
    mesh : Mesh
    most : int
        Ids from this on are none that the format can have.
    """
    content, answer = from_mesh(mesh), []
    ids = content.node_data.get(ID)
    if ids is not None and (why := _unfit(ids, len(content.points), most) or _repeated([ids])):
        answer.append(f"ids of nodes ({why})")
    known = [(block.data[ID], len(block)) for block in content.blocks if ID in block.data and len(block)]
    reasons = [why for ids, count in known if (why := _unfit(ids, count, most))]
    if reasons or (reasons := [why for why in [_repeated([ids for ids, _ in known])] if why]):
        answer.append(f"ids of elements ({', '.join(dict.fromkeys(reasons))})")
    return answer


def _usable(ids: np.ndarray | None, count: int, most: int) -> np.ndarray | None:
    """Ids that a file can have, (count,) int64, else None."""
    return None if ids is None or count == 0 or _unfit(ids, count, most) else np.asarray(ids).astype(np.int64)


def _unfit(ids: np.ndarray, count: int, most: int) -> str:
    """Why ids are none that a file can have, which are whole numbers from 1 and below `most`; empty where they are."""
    ids = np.asarray(ids)
    if ids.shape != (count,) or ids.dtype.kind not in "iu":
        return "no whole numbers"
    if count and ids.min() < 1:
        return "some below 1"
    return f"some of {'2^31' if most == ID_LIMIT else f'{most:,}'} and above" if count and ids.max() >= most else ""


def _repeated(ids: Sequence[np.ndarray]) -> str:
    every = np.concatenate([np.zeros(0, np.int64), *ids])
    return "some given twice" if len(np.unique(every)) < every.size else ""
