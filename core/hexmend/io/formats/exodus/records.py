"""QA and information records of an ExodusII file, and a note on data that Hexmend does not keep."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hexmend.io.coordinates.unread import unread_note
from hexmend.io.formats.exodus.netcdf3_writer import ClassicWriter
from hexmend.io.formats.exodus.store import ExodusStore

#: Names of field data: QA records, four strings each (program, version, date, time), and information records.
QA, INFORMATION = "exodus:qa", "exodus:information"

#: Bytes of a string and of a line, with the zero at the end (MAX_STR_LENGTH and MAX_LINE_LENGTH).
_STRING, _LINE = 33, 81

#: Data that are not kept, by the dimension that counts them.
_NOT_KEPT = {
    "num_glo_var": "global variables", "num_nset_var": "results of node sets", "num_sset_var": "results of side sets",
    "num_elset_var": "results of element sets", "num_ed_blk": "edge blocks", "num_fa_blk": "face blocks",
    "num_node_maps": "further maps of nodes", "num_elem_maps": "further maps of elements",
    "num_cframes": "coordinate frames",
}  # fmt: skip


def read_records(store: ExodusStore) -> dict[str, list[str]]:
    """Field data of the QA and information records of a file."""
    found = {}
    for name, variable, axes in ((QA, "qa_records", 3), (INFORMATION, "info_records", 2)):
        values = store.array(variable) if variable in store else np.zeros(0)
        if values.dtype.kind == "S" and values.ndim == axes and values.size:
            rows = values.reshape(-1, values.shape[-1])
            found[name] = [row.tobytes().split(b"\0")[0].decode("utf-8", errors="replace") for row in rows]
    return found


def add_records(file: ClassicWriter, field_data: Mapping[str, object]) -> None:
    """Add the records that `read_records` found; field data of other types are passed over."""
    qa, lines = _strings(field_data.get(QA)), _strings(field_data.get(INFORMATION))
    if qa and len(qa) % 4 == 0:
        characters = _characters(qa, _STRING).reshape(-1, 4, _STRING)
        file.add_variable("qa_records", {"num_qa_rec": len(characters), "four": 4, "len_string": _STRING}, characters)
    if lines:
        file.add_variable("info_records", {"num_info": len(lines), "len_line": _LINE}, _characters(lines, _LINE))


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


def _strings(value: object) -> list[str]:
    valid = isinstance(value, list | tuple) and all(isinstance(text, str) for text in value)
    return list(value) if valid else []


def _characters(words: list[str], width: int) -> np.ndarray:
    """Strings as rows of bytes, (k, width); longer ones are cut."""
    rows = [word.encode()[: width - 1].decode(errors="ignore").encode().ljust(width, b"\0") for word in words]
    return np.frombuffer(b"".join(rows), "S1").reshape(-1, width)
