"""Arrays of nodes and cells as the scalar variables of an ExodusII file, one for each column."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from itertools import chain, count

import numpy as np

from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.content import ID
from hexmend.io.base.numbering import fit_64_bits

_FIRST_COLUMN = re.compile(r"(.+)_(x|1)$", re.IGNORECASE)


def clean_name(name: str, end: str) -> str:
    """Name that the format can have: stripped and up to the first zero character; `end` is appended."""
    return (name.split("\0")[0].strip() or "unnamed") + end


def are_ids(values: object) -> bool:
    """Return True for an array of one whole number below 2^63 for each node or cell."""
    return _are_whole(values) and fit_64_bits(np.asarray(values))


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
