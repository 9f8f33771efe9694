"""What MED calls cells, how it orders their nodes, and how it names groups."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.unique_names import make_unique

#: MED's names of the kinds of cells that are read.
KINDS = {
    "PO1": "vertex", "SE2": "line", "SE3": "line3", "TR3": "triangle", "TR6": "triangle6",
    "QU4": "quad", "QU8": "quad8", "QU9": "quad9", "TE4": "tetra", "T10": "tetra10", "PE6": "wedge", "P15": "wedge15",
    "PY5": "pyramid", "P13": "pyramid13", "HE8": "hex", "H20": "hex20", "H27": "hex27",
}  # fmt: skip
NAMES = {kind: name for name, kind in KINDS.items()}

#: MED's number of each kind.
GEOMETRIES = {
    "PO1": 1, "SE2": 102, "SE3": 103, "TR3": 203, "TR6": 206, "QU4": 204, "QU8": 208, "QU9": 209, "TE4": 304,
    "T10": 310, "PE6": 306, "P15": 315, "PY5": 305, "P13": 313, "HE8": 308, "H20": 320, "H27": 327,
}  # fmt: skip

#: The bit that stands for each kind in what a field says of its places.
BITS = {
    "PO1": 0, "SE2": 1, "SE3": 2, "TR3": 4, "TR6": 6, "QU4": 5, "QU8": 8, "QU9": 9, "TE4": 10, "T10": 14, "PE6": 12,
    "P15": 17, "PY5": 11, "P13": 16, "HE8": 13, "H20": 19, "H27": 20,
}  # fmt: skip

_HEX20 = [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]
#: VTK's order of nodes: nodes[ORDER[kind]] of MED's, which goes round the lower face the other way.
ORDER = {
    "tetra": [0, 2, 1, 3],
    "tetra10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8],
    "pyramid": [0, 3, 2, 1, 4],
    "pyramid13": [0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10],
    "wedge": [0, 2, 1, 3, 5, 4],
    "wedge15": [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13],
    "hex": _HEX20[:8],
    "hex20": _HEX20,
    "hex27": [*_HEX20, 21, 23, 24, 22, 20, 25, 26],
}

#: How many bytes the name of a group has.
_WIDTH = 80

DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."
#: Bytes that one of the file may mean, and bytes that are never too many.
_RATIO, _ALWAYS = 200, 1 << 26


def most_bytes(path: Path) -> int:
    """How many bytes an array of the file may have."""
    return max(_ALWAYS, _RATIO * path.stat().st_size)


def taken(path: Path, group: Mapping, name: str) -> np.ndarray:
    """An array of the file, once it is known that it is not far larger than the file."""
    if name not in group:
        raise FileError(path, f"{group.name} has no {name}", DAMAGED)
    values = group[name]
    base = values.dtype.itemsize
    if int(np.prod(values.shape, dtype=object)) * base > most_bytes(path):
        raise FileError(path, f"{group.name}/{name} is announced larger than so small a file can mean", DAMAGED)
    return np.asarray(values[()])


def names_of(values: np.ndarray) -> list[str]:
    """Names of groups, of rows of bytes.

    >>> names_of(bytes_of(["inlet"]))
    ['inlet']
    """
    rows = np.asarray(values).reshape(-1, _WIDTH).astype(np.int8).view(np.uint8)
    return [row.tobytes().split(b"\0", 1)[0].decode("utf-8", errors="replace").strip() for row in rows]


def titles_of(names: Iterable[str]) -> dict[str, str]:
    """Names of groups as they are written, no two alike: without spaces around, and cut to 80 bytes."""

    def form(name: str, end: str) -> str:
        room = _WIDTH - len(end)
        cut = name.strip().split("\0", 1)[0].encode()[:room].decode(errors="ignore")
        return (cut + end).strip()

    return make_unique(names, form)


def bytes_of(names: list[str]) -> np.ndarray:
    """Names of groups as rows of bytes, (k, 80) int8, as `titles_of` gives them."""
    rows = np.zeros((len(names), _WIDTH), np.int8)
    for row, name in zip(rows, names, strict=True):
        letters = np.frombuffer(name.encode(), np.int8)
        row[: len(letters)] = letters
    return rows
