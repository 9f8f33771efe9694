"""Names of MED's groups, which are kept as rows of 80 bytes (MED_LNAME_SIZE)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hexmend.io.base.unique_names import make_unique

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
