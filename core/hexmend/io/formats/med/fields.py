"""MED's fields: values of nodes and cells in one time step, as data.

A field has a group for each step, in this one for the nodes (NOE) or the cells of a kind (MAI.HE8), and there an array
of all its first components, then all second ones; for some nodes or cells only where it names a profile.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.memory_budget import MemoryBudget
from hexmend.io.base.unique_names import make_unique
from hexmend.io.formats.med.content import BITS, DAMAGED, taken

#: What stands for a profile where all nodes or cells have values, and how wide names are, in bytes.
ALL = "MED_NO_PROFILE_INTERNAL"
_WIDTH, _COMPONENT = 64, 16
#: No places of their own for values inside a cell: a text that is empty, and one byte wide.
_NONE = np.array(b"", "S1")
#: MED's numbers of the types that are written.
_TYPES = {"<f8": 6, "<i4": 24, "<i8": 26}

#: Data by the place that they belong to: "NOE", or "MAI.HE8" and the like.
Fields = dict[str, dict[str, np.ndarray]]


def read_fields(path: Path, file: Mapping, mesh: str, counts: Mapping[str, int], notes: list[str]) -> Fields:
    """The last step of each field of a mesh.

    Parameters
    ----------
    path : Path
    file : h5py.File
    mesh : str
        Its name.
    counts : mapping of place to int
        How many nodes, or cells of a kind, there are.
    notes : list of str
        What is left out is added.
    """
    answer: Fields = {place: {} for place in counts}
    others, bare, steps_left, allowance = [], [], [], MemoryBudget(path, path.stat().st_size)
    for name, field in file["CHA"].items() if "CHA" in file else ():
        if _text(field.attrs.get("MAI", b"")) != mesh or not len(field):
            others.append(name)
            continue
        width = int(field.attrs["NCO"])
        if width < 1:
            raise FileError(path, f"the field {name} has {width} components: expected 1 at least", DAMAGED)
        step = max(field.values(), key=lambda one: (int(one.attrs["NDT"]), int(one.attrs["NOR"])))
        steps_left += [name] if len(field) > 1 else []
        for place, group in step.items():
            if place not in counts or any(int(one.attrs["NGA"]) != 1 for one in group.values()):
                bare += [name] if name not in bare else []
            else:
                allowance.charge(8 * width * counts[place], f"the field {name}")
                answer[place][name] = _values(path, file, group, width, counts[place])
    for names, words in (
        (others, "Fields of other meshes are left out"),
        (bare, "Fields at Gauss points, or at the nodes of each element, are left out"),
        (steps_left, "Of fields with several time steps the last is read"),
    ):
        notes += [f"{words}: {', '.join(names[:6])}{', ...' if len(names) > 6 else ''}."] if names else []
    return answer


def _values(path: Path, file: Mapping, group: Mapping, width: int, count: int) -> np.ndarray:
    """The values of all nodes or cells, (count,) or (count, width); of those without, NaN or 0."""
    found: list[tuple[np.ndarray, np.ndarray]] = []
    for profile, part in group.items():
        values = taken(path, part, "CO")
        rows = np.arange(count)
        if profile != ALL:
            rows = taken(path, file["PROFILS"][profile], "PFL").astype(np.int64) - 1
        if values.dtype.kind not in "iuf" or values.shape != (width * len(rows),):
            raise FileError(
                path, f"{part.name}/CO holds {values.size} numbers: expected {width} for each of {len(rows)}", DAMAGED
            )
        if len(rows) and (rows.min() < 0 or rows.max() >= count):
            raise FileError(path, f"the profile {profile} names what there is not: expected 1 to {count}", DAMAGED)
        found.append((rows, values.reshape(width, -1).T))
    dtype = np.result_type(*(values.dtype for _, values in found)) if found else np.dtype(np.float64)
    answer = np.full((count, width), np.nan if dtype.kind == "f" else 0, dtype)
    for rows, values in found:
        answer[rows] = values
    return answer[:, 0] if width == 1 else answer


def write_fields(file: Mapping, mesh: str, data: Fields) -> None:
    """Write data as fields without a time.

    Parameters
    ----------
    file : h5py.File
    mesh : str
        Its name.
    data : mapping of place to mapping of name to array
        What has no type in MED is left out.
    """
    step = f"{-1:020d}{-1:020d}"
    for (title, code, width), parts in _by_field(data).items():
        field = file.require_group("CHA").create_group(title, track_order=True)
        blank = np.bytes_(" " * _COMPONENT * width)
        field.attrs.update({"MAI": np.bytes_(mesh), "NOM": blank, "UNI": blank, "UNT": np.bytes_(" ")})
        field.attrs.update({"NCO": np.int32(width), "TYP": np.int32(_TYPES[code])})
        group = field.create_group(step, track_order=True)
        group.attrs.update({name: np.int32(-1) for name in ("NDT", "NOR", "RDT", "ROR")})
        group.attrs["PDT"] = 0.0
        cells = sum(1 << BITS[place.removeprefix("MAI.")] for place in parts if place != "NOE")
        said = {"LGC": cells, "LGN": int("NOE" in parts)}  # kinds of cells, and whether there are nodes
        for one in (field, group):
            one.attrs["LEN"] = np.uint32(bool(cells) + 8 * said["LGN"])
            one.attrs.update({name: np.uint32(bits) for name, bits in said.items() if bits})
        steps = {"LAA": 1, "LCA": bool(cells), "LNA": said["LGN"]}  # with anything, with cells, with nodes
        field.attrs.update({name: np.int32(1) for name, many in steps.items() if many})
        for place, values in parts.items():
            here = group.create_group(place, track_order=True)
            here.attrs.update({"GAU": _NONE, "PFL": np.bytes_(ALL)})
            whole = here.create_group(ALL)
            whole.attrs.update({"GAU": _NONE, "NBR": np.int32(len(values)), "NGA": np.int32(1)})
            whole["CO"] = values.reshape(len(values), width).T.ravel().astype(code)


def field_titles(data: Fields) -> dict[tuple[str, str, int], str]:
    """What fields are called, no two alike, by the name, type and width of what they hold.

    Names are without / and around spaces, and cut to 64 bytes; a field is of one type and width, so that others of its
    name have one of their own.
    """
    titles = make_unique((name for part in data.values() for name in part), _form)
    taken_titles = set(titles.values())
    answer: dict[tuple[str, str, int], str] = {}
    for part in data.values():
        for name, values in part.items():
            key = _key(name, values)
            if key is not None and key not in answer:
                others = (_form(name, f"_{k}") for k in count(2))
                known = any(one == name for one, _, _ in answer)
                answer[key] = next(one for one in others if one not in taken_titles) if known else titles[name]
                taken_titles.add(answer[key])
    return answer


def code_of(values: np.ndarray) -> str | None:
    """The type with which values are written; None where MED has none."""
    kind, limit = values.dtype.kind, np.iinfo(np.int64).max
    if kind == "f" and values.dtype.itemsize <= 8:
        code = "<f8"
    elif kind in "biu" and (kind != "u" or not values.size or int(values.max()) <= limit):
        code = "<i4" if values.dtype.itemsize < 4 or values.dtype == np.int32 else "<i8"
    else:
        return None
    return code if all(values.shape[1:]) else None


def _by_field(data: Fields) -> dict[tuple[str, str, int], dict[str, np.ndarray]]:
    """Values by the title, type and width of a field, and by place."""
    titles, answer = field_titles(data), {}
    for place, part in data.items():
        for name, values in part.items():
            key = _key(name, values)
            if key is not None:
                answer.setdefault((titles[key], *key[1:]), {})[place] = values
    return answer


def _key(name: str, values: np.ndarray) -> tuple[str, str, int] | None:
    code = code_of(values)
    return None if code is None else (name, code, int(np.prod(values.shape[1:], dtype=np.int64)))


def _form(name: str, end: str) -> str:
    clean = "".join("_" if letter == "/" or not letter.isprintable() else letter for letter in name).strip()
    cut = clean.encode("utf-8", "replace")[: _WIDTH - len(end)].decode(errors="ignore").strip()
    return (cut if cut.strip(".") else "field") + end


def _text(value: object) -> str:
    value = value if isinstance(value, str) else bytes(value).decode("utf-8", errors="replace")
    return value.split("\0")[0].strip()
