"""CGNS files on HDF5 for tests, with the layout of the CGNS library."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np


class Tree:
    """Node to which children are added."""

    def __init__(self, group: h5py.Group):
        self.group = group

    def add(self, name: str, label: str, value: object = None) -> Tree:
        """Add a child node with a text or an array, with the axes in Fortran's order, as its data."""
        group = self.group.create_group(name)
        kind = b"MT"
        if value is not None:
            value = np.frombuffer(value.encode(), np.int8) if isinstance(value, str) else np.asarray(value)
            kind = {"int8": b"C1", "int32": b"I4", "int64": b"I8", "float32": b"R4", "float64": b"R8"}[value.dtype.name]
            group.create_dataset(" data", data=np.ascontiguousarray(value.T))
        _mark(group, name, label, kind)
        return Tree(group)


@contextmanager
def cgns(path: Path, dimensions: tuple[int, int] = (3, 3)) -> Iterator[Tree]:
    """Create a file with one base, which is yielded."""
    with h5py.File(path, "w") as file:
        _mark(file, "HDF5 MotherNode", "Root Node of HDF5 File", b"MT")
        file.create_dataset(" format", data=np.frombuffer(b"IEEE_LITTLE_32\0", np.int8))
        file.create_dataset(" hdf5version", data=np.frombuffer(b"HDF5 Version 1.14.0".ljust(33, b"\0"), np.int8))
        root = Tree(file)
        root.add("CGNSLibraryVersion", "CGNSLibraryVersion_t", np.array([4.2], np.float32))
        yield root.add("Base", "CGNSBase_t", np.array(dimensions, np.int32))


def structured(base: Tree, name: str, points: np.ndarray) -> Tree:
    """Add a structured zone with points (ni, nj, nk, 3)."""
    count = np.array(points.shape[:3])
    zone = base.add(name, "Zone_t", np.stack([count, count - 1, 0 * count], axis=1).astype(np.int32))
    zone.add("ZoneType", "ZoneType_t", "Structured")
    grid = zone.add("GridCoordinates", "GridCoordinates_t")
    for axis, letter in enumerate("XYZ"):
        grid.add(f"Coordinate{letter}", "DataArray_t", points[..., axis])
    return zone


def unstructured(base: Tree, name: str, points: np.ndarray, cells: int) -> Tree:
    """Add an unstructured zone with points (n, 3) and a number of volume cells."""
    zone = base.add(name, "Zone_t", np.array([[len(points), cells, 0]], np.int32))
    zone.add("ZoneType", "ZoneType_t", "Unstructured")
    grid = zone.add("GridCoordinates", "GridCoordinates_t")
    for axis, letter in enumerate("XYZ"):
        grid.add(f"Coordinate{letter}", "DataArray_t", points[:, axis])
    return zone


def section(zone: Tree, name: str, kind: int, first: int, last: int, nodes: object) -> Tree:
    """Add elements of a type, numbered from first to last, with nodes from 1."""
    one = zone.add(name, "Elements_t", np.array([kind, 0], np.int32))
    one.add("ElementRange", "IndexRange_t", np.array([first, last], np.int32))
    one.add("ElementConnectivity", "DataArray_t", np.asarray(nodes, np.int32).ravel())
    return one


def condition(zone: Tree, name: str, member: str, values: np.ndarray, where: str = "Vertex", family: str = "") -> Tree:
    """Add a boundary condition over a PointRange or PointList, (indices, n)."""
    parent = Tree(zone.group["ZoneBC"]) if "ZoneBC" in zone.group else zone.add("ZoneBC", "ZoneBC_t")
    one = parent.add(name, "BC_t", "FamilySpecified" if family else "BCWall")
    one.add(member, "IndexRange_t" if member.endswith("Range") else "IndexArray_t", np.asarray(values, np.int32))
    if where != "Vertex":
        one.add("GridLocation", "GridLocation_t", where)
    if family:
        one.add("FamilyName", "FamilyName_t", family)
    return one


def _mark(group: h5py.Group, name: str, label: str, kind: bytes) -> None:
    for key, value, width in (("name", name.encode(), 33), ("label", label.encode(), 33), ("type", kind, 3)):
        group.attrs.create(key, np.bytes_(value), dtype=f"S{width}")
    group.attrs.create("flags", np.array([1], np.int32))
