"""Note on the data of an ExodusII file that Hexmend does not keep.

Ids of element blocks and sets, which solvers refer to: kept as field data with lines such as "ns 100 inlet".
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count

import numpy as np

from hexmend.io.base.remedies import unread_note
from hexmend.io.formats.exodus.store import ExodusStore

#: Name of the field data with the lines: entity ("eb", "ns", "els" or "ss"), id, and name in Hexmend.
IDS = "exodus:ids"


def id_lines(found: Sequence[tuple[str, int, str]]) -> dict[str, list[str]]:
    """Field data of (entity, id, name); none where the ids of every entity are 1, 2, ..."""
    ids: dict[str, list[int]] = {}
    for entity, number, _ in found:
        ids.setdefault(entity, []).append(number)
    if all(numbers == list(range(1, len(numbers) + 1)) for numbers in ids.values()):
        return {}
    return {IDS: [f"{entity} {number} {name}" for entity, number, name in found]}


def assigned_ids(lines: object, entity: str, names: Sequence[str]) -> list[int]:
    """Ids of the blocks or sets of an entity for a file: as the lines give them, unused ids for other names.

    Parameters
    ----------
    lines : list of str
        Field data of the name `IDS`; anything else holds no ids.
    entity : str
        "eb", "ns", "els" or "ss".
    names : sequence of str

    Examples
    --------
    >>> assigned_ids(["ns 100 inlet", "ss 7 wall"], "ns", ["new", "inlet"])
    [101, 100]
    >>> assigned_ids(None, "ns", ["a", "b"])
    [1, 2]
    """
    words = [line.split(" ", 2) for line in lines if isinstance(line, str)] if isinstance(lines, list | tuple) else []
    known: dict[str, list[int]] = {}
    for parts in words:
        if len(parts) == 3 and parts[0] == entity and parts[1].isdecimal() and 0 < int(parts[1]) < 2**31:
            known.setdefault(parts[2], []).append(int(parts[1]))
    ids: list[int | None] = []
    used: set[int] = set()
    for name in names:
        number = known[name].pop(0) if known.get(name) else None
        ids.append(None if number in used else number)
        used.update([number] if number else [])
    following = max(used, default=0) + 1
    first = following if following + ids.count(None) <= 2**31 else 1
    unused = (number for number in count(first) if number not in used)
    return [next(unused) if number is None else number for number in ids]


#: Data that are not kept, by the dimension that counts them.
_NOT_KEPT = {
    "num_glo_var": "global variables", "num_nset_var": "results of node sets", "num_sset_var": "results of side sets",
    "num_elset_var": "results of element sets", "num_ed_blk": "edge blocks", "num_fa_blk": "face blocks",
    "num_node_maps": "further maps of nodes", "num_elem_maps": "further maps of elements",
    "num_cframes": "coordinate frames",
}  # fmt: skip


def unread_notes(store: ExodusStore) -> list[str]:
    """Note on data of the file that Hexmend does not keep, as a list of one or none."""
    left = [words for dimension, words in _NOT_KEPT.items() if store.dimensions.get(dimension)]
    counts = {"ns": store.dimensions.get("num_node_sets", 0), "ss": store.dimensions.get("num_side_sets", 0)}
    # each set has one variable at least, which bounds what a damaged file claims
    sets = [f"{entity}{k}" for entity, count in counts.items() for k in range(1, min(len(store), count) + 1)]
    if any(_has_factors(store, name) for name in sets):
        left.insert(0, "distribution factors other than 1")
    return [unread_note(", ".join(left))] if left else []


def _has_factors(store: ExodusStore, set_name: str) -> bool:
    name = f"dist_fact_{set_name}"
    values = store.array(name) if name in store else np.ones(1)
    return values.dtype.kind in "iuf" and bool((values != 1).any())
