"""Zone_t of a CGNS file, and its parts that structured and unstructured zones have in common.

Tree of CGNS's nodes in HDF5: a node is a group with a label, its data are the dataset " data".

*CGNS File Mapping Manual*, part "HDF5".
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import Block
from hexmend.io.base.hdf5 import text_of
from hexmend.io.base.remedies import DAMAGED


class CGNSNode:
    """Node of the tree.

    Parameters
    ----------
    path : Path
        The file.
    group : h5py.Group
    name : str
    """

    def __init__(self, path: Path, group: object, name: str = ""):
        self.path, self.name = path, name
        self._group = self._resolve_link(group)

    def _resolve_link(self, group: object) -> object:
        """Return the group, or the target of a link."""
        if text_of(group.attrs.get("type", b"")) != "LK":
            return group
        if " file" in group and (name := text_of(hdf5.read_dataset(self.path, group[" file"]).tobytes())):
            problem = f"its {self.name} is kept in another file, {name[:80]!r}"
            raise FileError(self.path, problem, "Open that file, or write both as one.")
        return group.file[text_of(hdf5.read_dataset(self.path, group[" path"]).tobytes())]

    def children(self, *labels: str) -> list[CGNSNode]:
        """Child nodes with one of these labels, ordered by name."""
        groups = [(name, self._group[name]) for name in self._group if not name.startswith(" ")]
        found = [one for one in groups if text_of(one[1].attrs.get("label", b"")) in labels]
        return [CGNSNode(self.path, group, name) for name, group in found]

    def child(self, label: str) -> CGNSNode | None:
        """First child node with a label; None where there is none."""
        return next(iter(self.children(label)), None)

    def grandchildren(self, parent_label: str, label: str) -> list[CGNSNode]:
        """Child nodes with a label of all child nodes with another."""
        return [child for parent in self.children(parent_label) for child in parent.children(label)]

    def text_of(self, label: str, default: str = "") -> str:
        """Text of the first child node with a label."""
        child = self.child(label)
        return default if child is None else child.text()

    def child_named(self, name: str) -> CGNSNode | None:
        """Child node of a name, whatever its label; None where there is none."""
        return CGNSNode(self.path, self._group[name], name) if name in self._group else None

    def value(self) -> np.ndarray:
        """Data of the node, with the axes of Fortran's order reversed; empty where there are none."""
        return hdf5.read_dataset(self.path, self._group[" data"]) if " data" in self._group else np.empty(0)

    def integers(self) -> np.ndarray:
        """Data of the node as int64.

        Raises
        ------
        FileError
            Unless they are whole numbers.
        """
        values = self.value()
        if values.dtype.kind not in "iu":
            problem = f"{self.name} holds {values.dtype}: expected whole numbers"
            raise FileError(self.path, problem, "Write the file again with the program that made it.")
        return values.astype(np.int64)

    def integers_of(self, name: str) -> np.ndarray | None:
        """Data of the child node of a name as int64, flat; None where there is none."""
        child = self.child_named(name)
        return None if child is None else child.integers().ravel()

    def text(self) -> str:
        """Data of the node as a string."""
        return text_of(self.value().tobytes())

    def boundary_conditions(self) -> list[tuple[str, CGNSNode]]:
        """Boundary conditions of a zone by name, or by the name of their family."""
        found = self.grandchildren("ZoneBC_t", "BC_t")
        return [(child.text_of("FamilyName_t") or child.name, child) for child in found]

    def solution_arrays(self, location: str, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
        """Arrays of a zone's solutions at "Vertex" or "CellCenter", flat; of one name, the last counts."""
        found: dict[str, np.ndarray] = {}
        for solution in self.children("FlowSolution_t", "DiscreteData_t"):
            if solution.text_of("GridLocation_t", "Vertex") == location:
                rind = rind_planes(solution, len(shape))
                for array in solution.children("DataArray_t"):
                    found[array.name] = without_rind(array, shape, rind).ravel()
        return found


class Interface(NamedTuple):
    """Nodes of a zone that are nodes of a donor zone (GridConnectivity1to1_t, Abutting1to1).

    Parameters
    ----------
    donor : str
        Name of the donor, after its base and a slash where it is in another one.
    nodes : (k,) int64
    donor_nodes : (k,) or (k, 3) int64
        Numbers, or indices i, j, k, from 0.
    """

    donor: str
    nodes: np.ndarray
    donor_nodes: np.ndarray


@dataclass(eq=False)
class Zone:
    """Zone, whose nodes and hexes are numbered from 0.

    Parameters
    ----------
    name : str
    family : str
        Empty where none is named.
    points : (n, 3) float64
    blocks : list of Block
    node_sets : dict of name to (k,) int64
    side_sets : dict of name to (k, 2) int64
    node_data : dict of name to (n,) array
    interfaces : list of Interface
    notes : list of str
    key : (str, str)
        Names of its base and its own.
    shape : (3,) int64, optional
        Vertices along i, j and k of a structured zone.
    """

    name: str
    family: str
    points: np.ndarray
    blocks: list[Block] = field(default_factory=list)
    node_sets: dict[str, np.ndarray] = field(default_factory=dict)
    side_sets: dict[str, np.ndarray] = field(default_factory=dict)
    node_data: dict[str, np.ndarray] = field(default_factory=dict)
    interfaces: list[Interface] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    key: tuple[str, str] = ("", "")
    shape: np.ndarray | None = None

    def node_numbers(self, nodes: np.ndarray) -> np.ndarray | None:
        """Node numbers, (k,), of numbers or of indices i, j, k; None where one is outside the zone."""
        if self.shape is not None and nodes.ndim == 2:
            if ((nodes < 0) | (nodes >= self.shape)).any():
                return None
            return nodes @ [1, self.shape[0], self.shape[0] * self.shape[1]]
        inside = nodes.ndim == 1 and ((nodes >= 0) & (nodes < len(self.points))).all()
        return nodes if inside else None


def zone_size(node: CGNSNode, index_dimension: int) -> np.ndarray:
    """Numbers of vertices, cells and boundary vertices of a zone, (3, index_dimension) int64."""
    values = node.integers()
    if values.shape != (3, index_dimension) or values.min() < 0:
        raise FileError(node.path, f"zone {node.name!r} has the sizes {values.tolist()}", DAMAGED)
    return values


def new_zone(node: CGNSNode, shape: tuple[int, ...]) -> Zone:
    """Zone with its name, family, coordinates and node data; `shape` is as of `coordinates`."""
    zone = Zone(node.name, node.text_of("FamilyName_t"), coordinates(node, shape))
    zone.node_data = node.solution_arrays("Vertex", shape)
    return zone


def coordinates(node: CGNSNode, shape: tuple[int, ...]) -> np.ndarray:
    """Coordinates of the vertices of a zone, (n, 3) float64.

    Parameters
    ----------
    node : CGNSNode
    shape : tuple of int
        Vertices along the axes without rind, the last index of CGNS first.

    Raises
    ------
    FileError
        Unless the zone has Cartesian coordinates of this shape.
    """
    grids = node.children("GridCoordinates_t")
    grid = next((grid for grid in grids if grid.name == "GridCoordinates"), grids[0] if grids else None)
    if grid is None:
        raise FileError(node.path, f"zone {node.name!r} has no coordinates", DAMAGED)
    arrays = {array.name: array for array in grid.children("DataArray_t")}
    if "CoordinateR" in arrays or not any(f"Coordinate{axis}" in arrays for axis in "XYZ"):
        problem = f"zone {node.name!r} has the coordinates {', '.join(arrays) or 'none'}"
        remedy = "Write it with Cartesian coordinates."
        raise FileError(node.path, f"{problem}: expected CoordinateX, Y and Z", remedy)
    rind = rind_planes(grid, len(shape))
    axes = [axis for axis, letter in enumerate("XYZ") if f"Coordinate{letter}" in arrays]
    columns = [without_rind(arrays[f"Coordinate{'XYZ'[axis]}"], shape, rind).ravel() for axis in axes]
    points = np.zeros((columns[0].size, 3))
    points[:, axes] = np.column_stack(columns)
    return points


def without_rind(node: CGNSNode, shape: tuple[int, ...], rind: np.ndarray) -> np.ndarray:
    """Array of a node without its rind planes, of the given shape; see `rind_planes`."""
    values = node.value()
    full = tuple(int(length + planes.sum()) for length, planes in zip(shape, rind, strict=True))
    if values.dtype.kind not in "iuf" or values.shape != full:
        raise FileError(node.path, f"{node.name} holds {values.dtype} {values.shape}: expected numbers {full}", DAMAGED)
    return values[tuple(slice(int(low), int(low) + length) for (low, _), length in zip(rind, shape, strict=True))]


def rind_planes(node: CGNSNode, axes: int) -> np.ndarray:
    """Number of rind planes before and after the arrays of a node, (axes, 2), the last index of CGNS first."""
    found = node.child("Rind_t")
    values = found.integers().ravel() if found is not None else np.zeros(2 * axes, np.int64)
    if values.size != 2 * axes or values.min() < 0:
        raise FileError(node.path, f"{node.name} has the rind {values.tolist()}", DAMAGED)
    return values.reshape(axes, 2)[::-1]


def add_members(sets: dict[str, np.ndarray], name: str, members: np.ndarray) -> None:
    """Append members to the set of a name, which is new where there is none."""
    if len(members):
        sets[name] = np.concatenate([sets[name], members]) if name in sets else members
