"""Arrays of nodes and cells as the scalar variables of an ExodusII file, one for each column.

Element types of ExodusII: their kinds, and the order of their nodes and sides.

Sjaardema et al., *EXODUS: A Finite Element Data Model*, Sandia National Laboratories, section 4.8. A hex counts the
nodes of its vertical edges before those of its upper ones, and the node in its inside before those of its faces::

    Exodus, from 1      9-12      13-16       17-20     21        22 23 24 25 26 27
    edges, faces        lower     vertical    upper     inside    z- z+ x- x+ y- y+
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from itertools import chain, count

import numpy as np

from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.content import ID, VERTICAL_EDGES_FIRST

#: VTK's node order: vtk = exodus[ORDER[kind]]; kinds without an entry have one order in both.
ORDER = VERTICAL_EDGES_FIRST | {
    "hex27": [*VERTICAL_EDGES_FIRST["hex20"], 23, 24, 25, 26, 21, 22, 20],
}

#: Face, of `hexmend.mesh.hexahedron.FACES`, of a hex's sides 1 to 6.
FACE_OF_SIDE = np.array([2, 1, 3, 0, 4, 5])
SIDE_OF_FACE = np.argsort(FACE_OF_SIDE) + 1

#: Kinds of an element type by the start of its name; the number of nodes tells them apart, the first has corners alone.
_KINDS = {
    "HEX": ("hex", "hex20", "hex27"), "TET": ("tetra", "tetra10"), "WEDGE": ("wedge", "wedge15"),
    "PYR": ("pyramid", "pyramid13"), "QUAD": ("quad", "quad8", "quad9"), "SHELL": ("quad", "quad8", "quad9"),
    "TRI": ("triangle", "triangle6"),
    **dict.fromkeys(("BAR", "BEAM", "TRUSS", "EDGE"), ("line", "line3")),
    **dict.fromkeys(("SPHERE", "POINT", "CIRCLE"), ("vertex",)),
}  # fmt: skip

#: Names of hexes; others that begin so, such as HEXSHELL, are other elements.
_HEX = re.compile(r"HEX(A|AHEDRON|AHEDRAL|AHEDRA)?[_-]?[0-9]*")


def kinds_of(type: str, n_nodes: int) -> tuple[str, ...]:
    """Kinds that an element type with a number of nodes may be, the first with corners alone; none if it is unknown.

    Examples
    --------
    >>> kinds_of("HEX8", 8), kinds_of("SHELL3", 3), kinds_of("BEX_HEX", 8)
    (('hex', 'hex20', 'hex27'), ('triangle', 'triangle6'), ())
    """
    if type.startswith("HEX") and not _HEX.fullmatch(type):
        return ()
    if type.startswith("SHELL") and n_nodes in (3, 6):
        return _KINDS["TRI"]
    return next((kinds for start, kinds in _KINDS.items() if type.startswith(start)), ())


#: Element type that each kind is written as.
TYPE_OF_KIND = {
    "hex": "HEX8", "hex20": "HEX20", "hex27": "HEX27", "tetra": "TETRA4", "tetra10": "TETRA10", "wedge": "WEDGE6",
    "wedge15": "WEDGE15", "pyramid": "PYRAMID5", "pyramid13": "PYRAMID13", "quad": "SHELL4", "quad8": "SHELL8",
    "quad9": "SHELL9", "triangle": "TRI3", "triangle6": "TRI6", "line": "BAR2", "line3": "BAR3", "vertex": "SPHERE",
}  # fmt: skip

#: Name of the node set property that is 1 for the set of the pinned nodes, and 0 for others.
PINS_PROPERTY = "hexmend_pins"


_FIRST_COLUMN = re.compile(r"(.+)_(x|1)$", re.IGNORECASE)


def clean_name(name: str, end: str) -> str:
    """Name that the format can have: stripped and up to the first zero character; `end` is appended."""
    return (name.split("\0")[0].strip() or "unnamed") + end


def are_ids(values: object) -> bool:
    """Return True for an array of one whole number of at most 32 bits for each node or cell."""
    limits = np.iinfo(np.int32)
    return _are_whole(values) and not ((np.asarray(values) > limits.max) | (np.asarray(values) < limits.min)).any()


def _are_whole(values: object) -> bool:
    return values is not None and np.asarray(values).dtype.kind in "iu" and np.ndim(values) == 1


def column_titles(parts: Iterable[Mapping[str, np.ndarray]]) -> dict[str, str]:
    """Names under which arrays are written, chosen so that `join_columns` finds the columns of each again.

    An array gets another name where a column of it would have the name of another array or of its column, or where
    another array would be read as its next column.

    Parameters
    ----------
    parts : iterable of mapping of name to array
        The data of the nodes, or of each block of cells.

    Returns
    -------
    dict of name to str
        For the arrays that are written: numbers other than ids.

    Examples
    --------
    >>> column_titles([{"v": np.ones((2, 3)), "v_x": np.ones(2)}])
    {'v': 'v_2', 'v_x': 'v_x'}
    """
    widths: dict[str, set[int]] = {}
    for data in parts:
        for name, values in _variables(data).items():
            widths.setdefault(name, set()).add(int(np.prod(values.shape[1:])))
    titles = make_unique(widths, clean_name)
    used = {titles[name] for name, own in widths.items() if 1 in own}
    for name, own in widths.items():
        if max(own) > 1:
            first = titles[name]
            others = used - {first}
            for title in chain([first], (f"{first}_{k}" for k in count(2))):
                if others.isdisjoint({title, *_column_names(title, own), _next_column(title, own)}):
                    titles[name] = title
                    break
            used |= _column_names(titles[name], own)
    return titles


def columns(data: Mapping[str, np.ndarray], titles: Mapping[str, str]) -> dict[str, np.ndarray]:
    """Columns of arrays, (n,) float64 each, by the names under which they are written.

    Parameters
    ----------
    data : mapping of name to array
    titles : mapping of name to str
        From `column_titles`.
    """
    found = {}
    for name, values in _variables(data).items():
        rows = values.astype(np.float64).reshape(len(values), -1)
        found |= {titles[name] + end: rows[:, k] for k, end in enumerate(_ends(rows.shape[1]))}
    return found


def join_columns(found: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Join scalar variables named a_x, a_y, a_z, or a_1, a_2, ..., to one array with columns.

    Parameters
    ----------
    found : mapping of str to (n,) array

    Returns
    -------
    dict of str to (n,) or (n, width) array
    """
    left, joined = dict(found), {}
    while left:
        name = next(iter(left))
        match = _FIRST_COLUMN.match(name)
        parts = [name]
        if match:
            start, mark = match.groups()
            ends = ["x", "y", "z"] if mark in "xX" else [str(k) for k in range(1, len(left) + 1)]
            parts = [start + "_" + (end.upper() if mark == "X" else end) for end in ends]
            parts = parts[: next((k for k, part in enumerate(parts) if part not in left), len(parts))]
            if len(parts) < (3 if mark in "xX" else 2) or start in found:
                parts = [name]
        arrays = [left.pop(part) for part in parts]
        joined[match[1] if len(parts) > 1 else name] = np.column_stack(arrays) if len(parts) > 1 else arrays[0]
    return joined


def _variables(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays that are written: numbers other than ids."""
    arrays = {name: np.asarray(values) for name, values in data.items() if not (name == ID and _are_whole(values))}
    return {name: values for name, values in arrays.items() if values.dtype.kind in "biuf"}


def _ends(width: int) -> list[str]:
    """Suffixes of the names of an array's columns: _x, _y, _z of a vector, else _1, _2, ..."""
    return [""] if width == 1 else ["_x", "_y", "_z"] if width == 3 else [f"_{k}" for k in range(1, width + 1)]


def _column_names(title: str, widths: Iterable[int]) -> set[str]:
    return {title + end for width in widths for end in _ends(width)}


def _next_column(title: str, widths: Iterable[int]) -> str:
    """Name that would be read as one more numbered column; "" where none is numbered."""
    numbered = [width for width in widths if width not in (1, 3)]
    return f"{title}_{max(numbered) + 1}" if numbered else ""
