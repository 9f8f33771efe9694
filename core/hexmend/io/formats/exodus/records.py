"""What an ExodusII file says besides its mesh: records of the programs that made it, and what Hexmend does not keep."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hexmend.io.formats.exodus.netcdf3_writer import ClassicWriter
from hexmend.io.formats.exodus.store import ExodusStore

#: Field data with the QA records, four texts each (program, version, date, time), and with the information records.
QA, INFORMATION = "exodus:qa", "exodus:information"

#: Bytes of a text of each sort, with the zero at its end.
_STRING, _LINE = 33, 81

#: Dimensions that count what is not kept, and what that is called.
_NOT_KEPT = {
    "num_glo_var": "global variables",
    "num_nset_var": "results of node sets",
    "num_sset_var": "results of side sets",
    "num_elset_var": "results of element sets",
    "num_ed_blk": "edge blocks",
    "num_fa_blk": "face blocks",
    "num_node_maps": "further maps of nodes",
    "num_elem_maps": "further maps of elements",
    "num_cframes": "coordinate frames",
}


def records_of(store: ExodusStore) -> dict[str, list[str]]:
    """Field data of the QA and the information records of a file; nothing where it has none."""
    found = {}
    for name, variable, axes in ((QA, "qa_records", 3), (INFORMATION, "info_records", 2)):
        values = store.array(variable) if variable in store else np.zeros(0)
        if values.dtype.kind == "S" and values.ndim == axes and values.size:
            rows = values.reshape(-1, values.shape[-1])
            found[name] = [row.tobytes().split(b"\0")[0].decode("utf-8", errors="replace") for row in rows]
    return found


def add_records(file: ClassicWriter, field_data: Mapping[str, object]) -> None:
    """Write the records that `records_of` found, or none where the field data of their names are something else."""
    qa, lines = _texts(field_data.get(QA)), _texts(field_data.get(INFORMATION))
    if qa and len(qa) % 4 == 0:
        letters = _letters(qa, _STRING).reshape(-1, 4, _STRING)
        file.add("qa_records", {"num_qa_rec": len(letters), "four": 4, "len_string": _STRING}, letters)
    if lines:
        file.add("info_records", {"num_info": len(lines), "len_line": _LINE}, _letters(lines, _LINE))


def not_kept(store: ExodusStore) -> list[str]:
    """A note on what the file holds and Hexmend does not keep; none where there is nothing."""
    left = [words for dimension, words in _NOT_KEPT.items() if store.dimensions.get(dimension)]
    if any(_has_factors(store, f"{sort}{k}") for sort in ("ns", "ss") for k in range(1, _sets(store, sort) + 1)):
        left.insert(0, "distribution factors other than 1")
    return [f"What Hexmend does not keep is left out: {', '.join(left)}."] if left else []


def _sets(store: ExodusStore, sort: str) -> int:
    """The number of node or side sets, each of which has a variable at least."""
    return min(len(store), store.dimensions.get({"ns": "num_node_sets", "ss": "num_side_sets"}[sort], 0))


def _has_factors(store: ExodusStore, which: str) -> bool:
    name = f"dist_fact_{which}"
    values = store.array(name) if name in store else np.ones(1)
    return values.dtype.kind in "iuf" and bool((values != 1).any())


def _texts(value: object) -> list[str]:
    whole = isinstance(value, list | tuple) and all(isinstance(one, str) for one in value)
    return list(value) if whole else []


def _letters(words: list[str], width: int) -> np.ndarray:
    """Rows of bytes, (k, width); longer texts are cut."""
    rows = [word.encode()[: width - 1].decode(errors="ignore").encode().ljust(width, b"\0") for word in words]
    return np.frombuffer(b"".join(rows), "S1").reshape(-1, width)
