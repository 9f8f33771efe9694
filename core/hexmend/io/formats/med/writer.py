"""Writes MED, version 4.1: one mesh, a family for every combination of sets, and data as fields."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.io.base.content import ID, Block, Content, concatenate_data, from_mesh
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.numbering import set_combinations
from hexmend.io.base.unique_names import altered_names
from hexmend.io.formats.med.content import GEOMETRIES, NAMES, ORDER, bytes_of, titles_of
from hexmend.io.formats.med.fields import ALL, code_of, field_titles, write_fields
from hexmend.mesh.mesh import Mesh

#: The step of a mesh that does not change: no number of a step, none of an iteration.
_STEP = f"{-1:020d}{-1:020d}"


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write the mesh under its name."""
    import h5py

    content = _titled(replace(from_mesh(mesh), node_data=with_marks(mesh)))
    title = "".join(c if c.isalnum() or c in "_-" else "_" for c in mesh.name)[:64] or "mesh"
    with h5py.File(path, "w", track_order=True) as file:
        _group(file, "INFOS_GENERALES", MAJ=4, MIN=1, REL=0)
        about = _group(file, "ENS_MAA", {}).create_group(title, track_order=True)
        about.attrs.update(_plain(DIM=3, ESP=3, NXI=-1, NXT=-1, REP=0, SRT=0, TYP=0))
        axes = np.bytes_("".join(f"{axis:<16}" for axis in "XYZ"))
        blank = np.bytes_(" " * 48)
        about.attrs.update({"NOM": axes, "UNI": blank, "UNT": np.bytes_(" "), "DES": np.bytes_("Written by Hexmend")})
        step = _group(about, _STEP, CGT=1, NDT=-1, NOR=-1, NXI=-1, NXT=-1, PVI=-1, PVT=-1)
        step.attrs["PDT"] = -1.0
        families = _group(file, "FAS", {}).create_group(title, track_order=True)
        _group(families, "FAMILLE_ZERO", NUM=0)

        nodes = _group(step, "NOE", CGT=1, CGS=1)
        nodes.attrs["PFL"] = np.bytes_(ALL)
        count = len(content.points)
        _dataset(nodes, "COO", content.points.T.ravel(), count)
        _write_ids(nodes, content.node_data, count)
        if content.node_sets:
            own = _group(families, "NOEUD", {})
            _dataset(nodes, "FAM", _write_families(own, {}, content.node_sets, count, 1), count)

        cells = _group(step, "MAI", CGT=1)
        own = _group(families, "ELEME", {}) if any(block.sets for block in content.blocks) else None
        known: dict[tuple[str, ...], int] = {}
        for kind in dict.fromkeys(block.kind for block in content.blocks):
            blocks = [block for block in content.blocks if block.kind == kind]
            group = _group(cells, NAMES[kind], CGT=1, CGS=1, GEO=GEOMETRIES[NAMES[kind]])
            group.attrs["PFL"] = np.bytes_(ALL)
            rows = np.concatenate([block.nodes for block in blocks]).astype(np.int64) + 1
            rows = rows[:, np.argsort(ORDER[kind])] if kind in ORDER else rows
            _dataset(group, "NOD", rows.T.ravel(), len(rows))
            if all(_has_ids(block.data, len(block)) for block in blocks):
                ids = np.concatenate([np.asarray(block.data[ID]) for block in blocks])
                _write_ids(group, {ID: ids}, len(rows))
            first, sets = 0, {}
            for block in blocks:
                for name, members in block.sets.items():
                    sets.setdefault(name, []).append(np.asarray(members, np.int64) + first)
                first += len(block)
            if own is not None:  # kinds without sets too: MED's library takes the families of all or of none
                members_of = {name: np.concatenate(members) for name, members in sets.items()}
                _dataset(group, "FAM", _write_families(own, known, members_of, len(rows), -1), len(rows))
        write_fields(file, title, _fields(content))


def limitations(mesh: Mesh) -> list[str]:
    """Ids that are no whole numbers, data that are no numbers, and names too long, in words."""
    content = from_mesh(mesh)
    left = []
    if ID in content.node_data and not _has_ids(content.node_data, len(content.points)):
        left.append("ids of nodes (no whole numbers)")
    if any(ID in block.data and not _has_ids(block.data, len(block)) for block in content.blocks):
        left.append("ids of elements (no whole numbers)")
    fields = _fields(replace(content, node_data=with_marks(mesh)))
    for what, parts in (
        ("point data", [fields["NOE"]]),
        ("cell data", [part for place, part in fields.items() if place != "NOE"]),
    ):
        odd = sorted({name for part in parts for name, values in part.items() if code_of(values) is None})
        left += [f"{what} that are no numbers ({', '.join(odd)})"] if odd else []
    titles = {name: title for (name, _, _), title in field_titles(fields).items() if title != name}
    return left + altered_names(titles_of(_names(content))) + altered_names(titles, "data")


def _fields(content: Content) -> dict[str, dict[str, np.ndarray]]:
    """Data without ids by the place of a field."""
    answer = {"NOE": content.node_data}
    for kind in dict.fromkeys(block.kind for block in content.blocks):
        blocks = [block for block in content.blocks if block.kind == kind]
        answer[f"MAI.{NAMES[kind]}"] = concatenate_data(
            [block.data for block in blocks], [len(block) for block in blocks]
        )
    return {
        place: {name: np.asarray(values) for name, values in part.items() if name != ID}
        for place, part in answer.items()
    }


def _titled(content: Content) -> Content:
    """The content with names of sets as the file has them."""
    titles = titles_of(_names(content))

    def named(sets: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {titles[name]: members for name, members in sets.items()}

    blocks = tuple(Block(block.kind, block.nodes, block.data, named(block.sets)) for block in content.blocks)
    return replace(content, blocks=blocks, node_sets=named(content.node_sets))


def _names(content: Content) -> list[str]:
    return [*content.node_sets, *(name for block in content.blocks for name in block.sets)]


def _has_ids(data: Mapping[str, np.ndarray], count: int) -> bool:
    ids = np.asarray(data.get(ID, ()))
    return ID in data and ids.shape == (count,) and ids.dtype.kind in "iu"


def _write_families(
    group: object, known: dict[tuple[str, ...], int], sets: Mapping[str, np.ndarray], count: int, sign: int
) -> np.ndarray:
    """The family of each node or cell, (count,) int64; those that are new are written, and noted in `known`."""
    found, which = set_combinations(sets, count)
    numbers = []
    for names in map(tuple, found):
        if names and names not in known:
            known[names] = sign * (len(known) + 1)
            family = _group(group, f"FAM_{known[names]}", NUM=known[names])
            groups = _group(family, "GRO", NBR=len(names))
            groups.create_dataset("NOM", (len(names),), np.dtype(("i1", (80,))))[...] = bytes_of(list(names))
        numbers.append(known[names] if names else 0)
    return np.array(numbers, np.int64)[which]


def _write_ids(group: object, data: Mapping[str, np.ndarray], count: int) -> None:
    if _has_ids(data, count):
        _dataset(group, "NUM", np.asarray(data[ID]).astype(np.int64), count)


def _dataset(group: object, name: str, values: np.ndarray, count: int) -> None:
    group.create_dataset(name, data=values).attrs.update(_plain(CGT=1, NBR=count))


def _group(parent: object, name: str, /, attributes: Mapping[str, int] | None = None, **more: int) -> object:
    group = parent.create_group(name, track_order=True)
    group.attrs.update(_plain(**(attributes or {}), **more))
    return group


def _plain(**values: int) -> dict[str, np.int32]:
    return {name: np.int32(value) for name, value in values.items()}
