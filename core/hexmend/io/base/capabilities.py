"""Capabilities that a file needs to store a mesh, and limitations that several formats share.

Names of sets and data in the form that a file allows, without duplicates.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from itertools import count

import numpy as np

from hexmend.io.base.content import ID
from hexmend.io.base.fixed_marks import needs_marks, redundant_marks
from hexmend.io.base.format import Capability
from hexmend.mesh.mesh import Mesh


def make_unique(names: Iterable[str], form: Callable[[str, str], str]) -> dict[str, str]:
    """Choose the names under which sets or data are written.

    Parameters
    ----------
    names : iterable of str
    form : callable
        form(name, suffix) returns the name in the form that the file allows, with the suffix at its end.

    Returns
    -------
    dict of str to str
        The written name of each name. Valid names are kept; if two names become the same, the later one gets the
        suffix " 2", " 3"...

    Examples
    --------
    >>> make_unique(["a\'b", 'a"b'], lambda name, suffix: name.replace('"', "'") + suffix)
    {"a'b": "a'b", 'a"b': "a'b 2"}
    """
    names = list(dict.fromkeys(names))
    written = {name: name for name in names if form(name, "") == name}
    taken = set(written)
    for name in names:
        if name not in written:
            titles = (form(name, "" if k == 1 else f" {k}") for k in count(1))
            written[name] = next(title for title in titles if title not in taken)
            taken.add(written[name])
    return {name: written[name] for name in names}


def altered_names(titles: dict[str, str], of: str = "sets") -> list[str]:
    """Describe the names that are not written unchanged; empty if there are none.

    Parameters
    ----------
    titles : dict of str to str
        Written names, as from `make_unique`.
    of : str
        The things that have the names, in the message.
    """
    altered = sorted(name for name, title in titles.items() if name != title)
    return [f"names of {of} as they are ({', '.join(altered)})"] if altered else []


def altered_set_names(mesh: Mesh, form: Callable[[str, str], str]) -> list[str]:
    """Describe the names of sets that are not written unchanged; sets of each kind have their own names.

    Parameters
    ----------
    mesh : Mesh
    form : callable
        See `make_unique`.
    """
    cells = [name for one in mesh.cells for name in one.sets]
    kinds = (mesh.node_sets, [*mesh.hex_sets, *cells], mesh.side_sets)
    return altered_names({name: title for names in kinds for name, title in make_unique(names, form).items()})


#: Float64 represents every integer up to this one.
_LARGEST_EXACT = 1 << 53


def required_capabilities(mesh: Mesh, stored_names: Collection[str] = ()) -> dict[Capability, str]:
    """List the capabilities that a format needs so that a file holds all of a mesh.

    Parameters
    ----------
    mesh : Mesh
    stored_names : collection of str
        Names of data and sets that are stored in any case, and ignored here.

    Returns
    -------
    dict of Capability to str
        A description for messages with the names of data or sets, such as "point data (temperature)".
    """
    data = [mesh.hex_data, *(cells.data for cells in mesh.cells)]
    volume_sets = [mesh.hex_sets, *(cells.sets for cells in mesh.cells if cells.dimension == 3)]
    lower_sets = [cells.sets for cells in mesh.cells if cells.dimension < 3]
    groups = ([mesh.node_sets], [*volume_sets, *lower_sets], [mesh.side_sets])
    names = {
        Capability.NODE_DATA: [name for name in mesh.node_data if name not in (ID, redundant_marks(mesh))],
        Capability.HEX_DATA: [name for name in _names(data) if name != ID],
        Capability.IDS: [""] if ID in mesh.node_data or ID in _names(data) else [],
        Capability.NODE_SETS: _non_empty([mesh.node_sets]),
        Capability.HEX_SETS: _non_empty(volume_sets),
        Capability.CELL_SETS: _non_empty(lower_sets),
        Capability.SIDE_SETS: _non_empty([mesh.side_sets]),
        Capability.EMPTY_SETS: [name for sets in groups for name in set(_names(sets)) - set(_non_empty(sets))],
        Capability.FIXED_NODES: [""] if needs_marks(mesh) else [],
        Capability.LOWER_CELLS: [""] if any(0 < cells.dimension < 3 for cells in mesh.cells) else [],
        Capability.VERTICES: [""] if any(cells.dimension == 0 for cells in mesh.cells) else [],
        Capability.OTHER_CELLS: [""] if any(cells.dimension == 3 for cells in mesh.cells) else [],
        Capability.SECOND_ORDER: [""] if mesh.mid_nodes is not None else [],
        Capability.FIELD_DATA: list(mesh.field_data),
    }
    required = {kind: [name for name in found if name not in stored_names] for kind, found in names.items()}
    return {
        kind: f"{kind.value} ({', '.join(sorted(found))})" if any(found) else kind.value
        for kind, found in required.items()
        if found
    }


def rounded_integers(mesh: Mesh) -> list[str]:
    """Describe integer data that a format rounds because it stores all data as float64; empty if there are none."""

    def is_rounded(values: np.ndarray) -> bool:
        return values.dtype.kind in "iu" and bool(((values > _LARGEST_EXACT) | (values < -_LARGEST_EXACT)).any())

    return _describe(mesh, "whole numbers of {} above 2^53, which are rounded", is_rounded)


def non_numeric_data(mesh: Mesh) -> list[str]:
    """Describe data that a format for real numbers cannot store: texts, complex numbers; empty if there are none."""
    return _describe(mesh, "{} that are not numbers", lambda values: values.dtype.kind not in "biuf")


def _describe(mesh: Mesh, description: str, applies: Callable[[np.ndarray], bool]) -> list[str]:
    """List point data and cell data to which something applies, with the names of their arrays; ids do not count."""
    groups = {"point data": [mesh.node_data], "cell data": [mesh.hex_data, *(cells.data for cells in mesh.cells)]}
    found = {
        kind: {name for data in group for name, values in data.items() if name != ID and applies(np.asarray(values))}
        for kind, group in groups.items()
    }
    return [f"{description.format(kind)} ({', '.join(sorted(names))})" for kind, names in found.items() if names]


def _non_empty(groups: Iterable[Mapping[str, np.ndarray]]) -> list[str]:
    """Names of sets that have members in at least one group, each once."""
    return list(dict.fromkeys(name for sets in groups for name, members in sets.items() if len(members)))


def _names(groups: Iterable[Mapping[str, object]]) -> list[str]:
    """Names in all groups, each once."""
    return list(dict.fromkeys(name for group in groups for name in group))
