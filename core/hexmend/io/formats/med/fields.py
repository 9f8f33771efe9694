"""Fields of MED as data of nodes and cells, in one time step.

A field has a group for each time step, and in it one for each entity: the nodes (NOE), or the cells of a geometric type
(MAI.HE8). Values are stored component by component, for some nodes or cells only where a profile lists these.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.hdf5 import text_of
from hexmend.io.base.memory_budget import MemoryBudget
from hexmend.io.base.numbering import check_numbers
from hexmend.io.base.remedies import DAMAGED, some_names, unread_note
from hexmend.io.formats.med.arrays import GEOMETRY_BITS, read_array

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
