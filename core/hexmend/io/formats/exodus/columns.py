"""The results of an ExodusII file: arrays of nodes and cells as scalar variables, one for each column."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import chain, count

import numpy as np

from hexmend.io.base.content import ID
from hexmend.io.base.unique_names import make_unique


def form(name: str, end: str) -> str:
    """A name as the format can have it: without spaces around it, and up to a zero."""
    return (name.split("\0")[0].strip() or "unnamed") + end


def whole_numbers(values: object) -> bool:
    """Whether values are whole numbers, one a row."""
    return values is not None and np.asarray(values).dtype.kind in "iu" and np.ndim(values) == 1


def column_titles(parts: Iterable[Mapping[str, np.ndarray]]) -> dict[str, str]:
    """Names of arrays as they are written, so that the columns of each are read as one array again.

    An array gets another name where one of its columns would be called as another array or as a column of one, or
    where another array would be read as its next column.

    Parameters
    ----------
    parts : iterable of mapping of name to array
        The data of the nodes, or of each block of cells.

    Returns
    -------
    dict of name to str
        Of the arrays that are written: numbers that are no ids.

    Examples
    --------
    >>> column_titles([{"v": np.ones((2, 3)), "v_x": np.ones(2)}])
    {'v': 'v_2', 'v_x': 'v_x'}
    """
    widths: dict[str, set[int]] = {}
    for data in parts:
        for name, values in _variables(data).items():
            widths.setdefault(name, set()).add(int(np.prod(values.shape[1:])))
    titles = make_unique(widths, form)
    taken = {titles[name] for name, own in widths.items() if 1 in own}
    for name, own in widths.items():
        if max(own) > 1:
            first = titles[name]
            others = taken - {first}
            titles[name] = next(
                title
                for title in chain([first], (f"{first}_{k}" for k in count(2)))
                if title not in others and others.isdisjoint({*_column_names(title, own), _next_column(title, own)})
            )
            taken |= _column_names(titles[name], own)
    return titles


def columns(data: Mapping[str, np.ndarray], titles: Mapping[str, str]) -> dict[str, np.ndarray]:
    """The columns of arrays, each (n,) float64, by the names that they are written under.

    Parameters
    ----------
    data : mapping of name to array
    titles : mapping of name to str
        From `column_titles`.
    """
    answer = {}
    for name, values in _variables(data).items():
        rows = values.astype(np.float64).reshape(len(values), -1)
        answer |= {titles[name] + end: rows[:, k] for k, end in enumerate(_ends(rows.shape[1]))}
    return answer


def _variables(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The arrays that are written: numbers that are no ids."""
    arrays = {name: np.asarray(values) for name, values in data.items()}
    return {
        name: values
        for name, values in arrays.items()
        if values.dtype.kind in "biuf" and not (name == ID and whole_numbers(values))
    }


def _ends(width: int) -> list[str]:
    """Ends of the names of an array's columns: _x _y _z of a vector, else _1 _2 ..."""
    return [""] if width == 1 else ["_x", "_y", "_z"] if width == 3 else [f"_{k}" for k in range(1, width + 1)]


def _column_names(title: str, widths: Iterable[int]) -> set[str]:
    return {title + end for width in widths for end in _ends(width)}


def _next_column(title: str, widths: Iterable[int]) -> str:
    """What would be read as one more numbered column; "" where none is numbered."""
    numbered = [width for width in widths if width not in (1, 3)]
    return f"{title}_{max(numbered) + 1}" if numbered else ""
