"""Fields of MED as data of nodes and cells, in one time step.

A field has a group for each time step, and in it one for each entity: the nodes (NOE), or the cells of a geometric type
(MAI.HE8). Values are stored component by component, for some nodes or cells only where a profile lists these.

Arrays of a MED file, read once their size is known to be plausible.

Names of MED's groups, which are kept as rows of 80 bytes (MED_LNAME_SIZE).

Geometric types of MED: their kinds, numbers and node order.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.hdf5 import text_of
from hexmend.io.base.numbering import check_numbers
from hexmend.io.base.remedies import DAMAGED, MemoryBudget, some_names, unread_note

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


_GROUP_NAME_SIZE = 80


def decode_names(values: np.ndarray) -> list[str]:
    """Decode names of groups from rows of 80 bytes.

    >>> decode_names(encode_names(["inlet"]))
    ['inlet']
    """
    rows = np.asarray(values).reshape(-1, _GROUP_NAME_SIZE).astype(np.int8).view(np.uint8)
    return [row.tobytes().split(b"\0", 1)[0].decode("utf-8", errors="replace").strip() for row in rows]


def encode_names(names: list[str]) -> np.ndarray:
    """Encode names of groups, as `group_titles` returns them, as (k, 80) int8."""
    rows = np.zeros((len(names), _GROUP_NAME_SIZE), np.int8)
    for row, name in zip(rows, names, strict=True):
        data = np.frombuffer(name.encode(), np.int8)
        row[: len(data)] = data
    return rows


def group_titles(names: Iterable[str]) -> dict[str, str]:
    """Names of groups as they are written, all different: stripped, and cut to 80 bytes."""

    def clean_name(name: str, end: str) -> str:
        cut = name.strip().split("\0", 1)[0].encode()[: _GROUP_NAME_SIZE - len(end)].decode(errors="ignore")
        return (cut + end).strip()

    return make_unique(names, clean_name)


#: Profile of values for all nodes or cells.
NO_PROFILE = "MED_NO_PROFILE_INTERNAL"
#: Step of data without a time: no number of a time step (MED_NO_DT), none of an iteration (MED_NO_IT).
NO_STEP = f"{-1:020d}{-1:020d}"
#: Bytes of the names of fields and of components (MED_NAME_SIZE, MED_SNAME_SIZE).
_NAME_SIZE, _COMPONENT_SIZE = 64, 16
#: Name of no localisation of Gauss points: an empty text of one byte.
_NO_LOCALISATION = np.array(b"", "S1")
#: Numbers of the types that are written (med_field_type).
_TYPES = {"<f8": 6, "<i4": 24, "<i8": 26}

#: Arrays by name, for each entity: "NOE", or "MAI." and a geometric type.
Fields = dict[str, dict[str, np.ndarray]]


def read_fields(path: Path, file: Mapping, mesh: str, counts: Mapping[str, int], notes: list[str]) -> Fields:
    """Read the last time step of each field of a mesh.

    Parameters
    ----------
    path : Path
    file : h5py.File
    mesh : str
        Name of the mesh.
    counts : mapping of str to int
        Number of nodes or cells of each entity.
    notes : list of str
        Notes on fields that are left out are appended.

    Returns
    -------
    dict of str to dict of str to (count,) or (count, width) array

    Raises
    ------
    FileError
        For a field whose values do not fit its entity.
    """
    fields: Fields = {entity: {} for entity in counts}
    other_meshes, unsupported, several_steps = [], [], []
    budget = MemoryBudget(path, path.stat().st_size)
    for name, field in file["CHA"].items() if "CHA" in file else ():
        if text_of(field.attrs.get("MAI", b"")) != mesh or not len(field):
            other_meshes.append(name)
            continue
        width = int(field.attrs["NCO"])
        if width < 1:
            raise FileError(path, f"the field {name} has {width} components: expected 1 at least", DAMAGED)
        step = max(field.values(), key=lambda step: (int(step.attrs["NDT"]), int(step.attrs["NOR"])))
        several_steps += [name] if len(field) > 1 else []
        for entity, group in step.items():
            if entity not in counts or any(int(part.attrs["NGA"]) != 1 for part in group.values()):
                unsupported += [name] if name not in unsupported else []
            else:
                budget.charge(8 * width * counts[entity], f"the field {name}")
                fields[entity][name] = _values(path, file, group, width, counts[entity])
    for names, words in (
        (other_meshes, "fields of other meshes"),
        (unsupported, "fields at Gauss points, or at the nodes of each element"),
        (several_steps, "all time steps but the last of fields"),
    ):
        notes += [unread_note(f"{words} ({some_names(names)})")] if names else []
    return fields


def _values(path: Path, file: Mapping, group: Mapping, width: int, count: int) -> np.ndarray:
    """Values of all nodes or cells, (count,) or (count, width); NaN or 0 where the field has none."""
    found: list[tuple[np.ndarray, np.ndarray]] = []
    for profile, part in group.items():
        values = read_array(path, part, "CO")
        rows = np.arange(count)
        if profile != NO_PROFILE:
            rows = read_array(path, file["PROFILS"][profile], "PFL").astype(np.int64) - 1
        if values.dtype.kind not in "iuf" or values.shape != (width * len(rows),):
            problem = f"{part.name}/CO holds {values.size} numbers: expected {width} for each of {len(rows)}"
            raise FileError(path, problem, DAMAGED)
        check_numbers(path, f"the profile {profile} refers to the entries", rows, count)
        found.append((rows, values.reshape(width, -1).T))
    dtype = np.result_type(*(values.dtype for _, values in found)) if found else np.dtype(np.float64)
    filled = np.full((count, width), np.nan if dtype.kind == "f" else 0, dtype)
    for rows, values in found:
        filled[rows] = values
    return filled[:, 0] if width == 1 else filled


def write_fields(file: Mapping, mesh: str, data: Fields) -> None:
    """Write data as fields without a time; arrays without a type in MED are left out.

    Parameters
    ----------
    file : h5py.File
    mesh : str
        Name of the mesh.
    data : mapping of str to mapping of str to (count, ...) array
        Arrays by name, for each entity.
    """
    for (_, code, width), (title, arrays) in titled_fields(data).items():
        field = file.require_group("CHA").create_group(title, track_order=True)
        blank = np.bytes_(" " * _COMPONENT_SIZE * width)
        field.attrs.update({"MAI": np.bytes_(mesh), "NOM": blank, "UNI": blank, "UNT": np.bytes_(" ")})
        field.attrs.update({"NCO": np.int32(width), "TYP": np.int32(_TYPES[code])})
        step = field.create_group(NO_STEP, track_order=True)
        step.attrs.update({name: np.int32(-1) for name in ("NDT", "NOR", "RDT", "ROR")})
        step.attrs["PDT"] = 0.0
        cells = sum(1 << GEOMETRY_BITS[entity.removeprefix("MAI.")] for entity in arrays if entity != "NOE")
        nodes = int("NOE" in arrays)
        entities = {"LGC": cells, "LGN": nodes}  # geometric types with values, and nodes
        for group in (field, step):
            group.attrs["LEN"] = np.uint32(bool(cells) + 8 * nodes)
            group.attrs.update({name: np.uint32(bits) for name, bits in entities.items() if bits})
        n_steps = {"LAA": 1, "LCA": bool(cells), "LNA": nodes}  # with any values, with cells, with nodes
        field.attrs.update({name: np.int32(1) for name, number in n_steps.items() if number})
        for entity, values in arrays.items():
            group = step.create_group(entity, track_order=True)
            group.attrs.update({"GAU": _NO_LOCALISATION, "PFL": np.bytes_(NO_PROFILE)})
            profile = group.create_group(NO_PROFILE)
            profile.attrs.update({"GAU": _NO_LOCALISATION, "NBR": np.int32(len(values)), "NGA": np.int32(1)})
            profile["CO"] = values.reshape(len(values), width).T.ravel().astype(code)


def titled_fields(data: Fields) -> dict[tuple[str, str, int], tuple[str, dict[str, np.ndarray]]]:
    """Fields by name, type code and width of the arrays: the name of each in the file, all different, and its arrays.

    Names are stripped, without "/", and cut to 64 bytes. Arrays of one name but another type or width become a field of
    their own.
    """
    titles = make_unique((name for arrays in data.values() for name in arrays), _clean_name)
    used = set(titles.values())
    found: dict[tuple[str, str, int], tuple[str, dict[str, np.ndarray]]] = {}
    for entity, arrays in data.items():
        for name, values in arrays.items():
            code = type_code(values)
            if code is None:
                continue
            key = (name, code, int(np.prod(values.shape[1:], dtype=np.int64)))
            if key not in found:
                title = titles[name]
                if any(other == name for other, _, _ in found):
                    numbered = (_clean_name(name, f"_{k}") for k in count(2))
                    title = next(title for title in numbered if title not in used)
                found[key] = title, {}
                used.add(title)
            found[key][1][entity] = values
    return found


def type_code(values: np.ndarray) -> str | None:
    """NumPy code of the type as which values are written; None where MED has none."""
    kind, limit = values.dtype.kind, np.iinfo(np.int64).max
    if kind == "f" and values.dtype.itemsize <= 8:
        code = "<f8"
    elif kind in "biu" and (kind != "u" or not values.size or int(values.max()) <= limit):
        code = "<i4" if values.dtype.itemsize < 4 or values.dtype == np.int32 else "<i8"
    else:
        return None
    return code if all(values.shape[1:]) else None


def _clean_name(name: str, end: str) -> str:
    """Name that a field can have, with `end`."""
    clean = "".join("_" if letter == "/" or not letter.isprintable() else letter for letter in name).strip()
    cut = clean.encode("utf-8", "replace")[: _NAME_SIZE - len(end)].decode(errors="ignore").strip()
    return (cut if cut.strip(".") else "field") + end
