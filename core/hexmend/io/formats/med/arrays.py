"""Arrays of a MED file, read once their size is known to be plausible.

Names of MED's groups, which are kept as rows of 80 bytes (MED_LNAME_SIZE).

Geometric types of MED: their kinds, numbers and node order.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.remedies import DAMAGED

#: Kind of cell of each geometric type that is read.
KIND_OF_TYPE = {
    "PO1": "vertex", "SE2": "line", "SE3": "line3", "TR3": "triangle", "TR6": "triangle6",
    "QU4": "quad", "QU8": "quad8", "QU9": "quad9", "TE4": "tetra", "T10": "tetra10", "PE6": "wedge", "P15": "wedge15",
    "PY5": "pyramid", "P13": "pyramid13", "HE8": "hex", "H20": "hex20", "H27": "hex27",
}  # fmt: skip
TYPE_OF_KIND = {kind: type for type, kind in KIND_OF_TYPE.items()}

#: Number of each geometric type (med_geometry_type).
GEOMETRY_NUMBERS = {
    "PO1": 1, "SE2": 102, "SE3": 103, "TR3": 203, "TR6": 206, "QU4": 204, "QU8": 208, "QU9": 209, "TE4": 304,
    "T10": 310, "PE6": 306, "P15": 315, "PY5": 305, "P13": 313, "HE8": 308, "H20": 320, "H27": 327,
}  # fmt: skip

#: Bit of each geometric type in the attribute LGC of a field, which lists the types that have values.
GEOMETRY_BITS = {
    "PO1": 0, "SE2": 1, "SE3": 2, "TR3": 4, "TR6": 6, "QU4": 5, "QU8": 8, "QU9": 9, "TE4": 10, "T10": 14, "PE6": 12,
    "P15": 17, "PY5": 11, "P13": 16, "HE8": 13, "H20": 19, "H27": 20,
}  # fmt: skip

_HEX20 = [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]
#: VTK's node order: vtk = med[ORDER[kind]]; MED goes round the lower face in the opposite direction.
ORDER = {
    "tetra": [0, 2, 1, 3], "tetra10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8],
    "pyramid": [0, 3, 2, 1, 4], "pyramid13": [0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10],
    "wedge": [0, 2, 1, 3, 5, 4], "wedge15": [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13],
    "hex": _HEX20[:8], "hex20": _HEX20, "hex27": [*_HEX20, 21, 23, 24, 22, 20, 25, 26],
}  # fmt: skip


def read_array(path: Path, group: Mapping, name: str) -> np.ndarray:
    """Read an array of a group.

    Raises
    ------
    FileError
        For an array that is missing, or far larger than the file.
    """
    if name not in group:
        raise FileError(path, f"{group.name} has no {name}", DAMAGED)
    return np.asarray(hdf5.read_dataset(path, group[name]))


def read_integers(path: Path, group: Mapping, name: str, count: int) -> np.ndarray:
    """Read an array of whole numbers, (count,) int64.

    Raises
    ------
    FileError
        For an array of another type or length.
    """
    values = read_array(path, group, name)
    if values.shape != (count,) or values.dtype.kind not in "iu":
        raise FileError(path, f"{group.name}/{name} holds {values.size} numbers: expected {count}", DAMAGED)
    return values.astype(np.int64)


_NAME_SIZE = 80


def decode_names(values: np.ndarray) -> list[str]:
    """Decode names of groups from rows of 80 bytes.

    >>> decode_names(encode_names(["inlet"]))
    ['inlet']
    """
    rows = np.asarray(values).reshape(-1, _NAME_SIZE).astype(np.int8).view(np.uint8)
    return [row.tobytes().split(b"\0", 1)[0].decode("utf-8", errors="replace").strip() for row in rows]


def encode_names(names: list[str]) -> np.ndarray:
    """Encode names of groups, as `group_titles` returns them, as (k, 80) int8."""
    rows = np.zeros((len(names), _NAME_SIZE), np.int8)
    for row, name in zip(rows, names, strict=True):
        data = np.frombuffer(name.encode(), np.int8)
        row[: len(data)] = data
    return rows


def group_titles(names: Iterable[str]) -> dict[str, str]:
    """Names of groups as they are written, all different: stripped, and cut to 80 bytes."""

    def clean_name(name: str, end: str) -> str:
        cut = name.strip().split("\0", 1)[0].encode()[: _NAME_SIZE - len(end)].decode(errors="ignore")
        return (cut + end).strip()

    return make_unique(names, clean_name)
