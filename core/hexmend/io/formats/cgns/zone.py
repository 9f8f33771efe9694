"""What is read of a CGNS zone of either kind."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block
from hexmend.io.formats.cgns.tree import CGNSNode

DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."


@dataclass(eq=False)
class Zone:
    """A zone, with numbers of nodes and hexes of its own.

    Parameters
    ----------
    name, family : str
    points : (n, 3) float64
    blocks : list of Block
    node_sets : dict of name to (k,) int64
    side_sets : dict of name to (k, 2) int64
    node_data : dict of name to (n,) array
    interfaces : list of (name of another zone, own nodes, its nodes)
    notes : list of str
    key : (str, str)
        Names of its base and itself.
    shape : (3,) int64, optional
        Vertices along i, j and k of a structured one. Nodes of such a zone may be told as rows of i, j, k from 0.
    """

    name: str
    family: str
    points: np.ndarray
    blocks: list[Block] = field(default_factory=list)
    node_sets: dict[str, np.ndarray] = field(default_factory=dict)
    side_sets: dict[str, np.ndarray] = field(default_factory=dict)
    node_data: dict[str, np.ndarray] = field(default_factory=dict)
    interfaces: list[tuple[str, np.ndarray, np.ndarray]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    key: tuple[str, str] = ("", "")
    shape: np.ndarray | None = None

    def numbers(self, nodes: np.ndarray) -> np.ndarray | None:
        """Nodes told by numbers, or by i, j and k, as numbers; None where they are none of this zone."""
        if self.shape is not None and nodes.ndim == 2:
            if ((nodes < 0) | (nodes >= self.shape)).any():
                return None
            return nodes @ [1, self.shape[0], self.shape[0] * self.shape[1]]
        whole = nodes.ndim == 1 and ((nodes >= 0) & (nodes < len(self.points))).all()
        return nodes if whole else None


def sizes(node: CGNSNode, rows: int) -> np.ndarray:
    """Numbers of vertices, cells and boundary vertices of a zone, (3, rows)."""
    values = node.numbers()
    if values.shape != (3, rows) or values.min() < 0:
        raise FileError(node.path, f"zone {node.name!r} has the sizes {values.tolist()}", DAMAGED)
    return values


def family(node: CGNSNode) -> str:
    """The family that a zone or boundary condition belongs to; empty where none is named."""
    found = node.child("FamilyName_t")
    return found.text() if found is not None else ""


def coordinates(node: CGNSNode, shape: tuple[int, ...]) -> np.ndarray:
    """The points of a zone, whose arrays have a shape (last index of CGNS first) without their rind, (n, 3)."""
    grids = node.children("GridCoordinates_t")
    grid = next((one for one in grids if one.name == "GridCoordinates"), grids[0] if grids else None)
    if grid is None:
        raise FileError(node.path, f"zone {node.name!r} has no coordinates", DAMAGED)
    arrays = {one.name: one for one in grid.children("DataArray_t")}
    if "CoordinateR" in arrays or not any(f"Coordinate{axis}" in arrays for axis in "XYZ"):
        raise FileError(
            node.path,
            f"zone {node.name!r} has the coordinates {', '.join(arrays) or 'none'}: expected CoordinateX, Y and Z",
            "Write it with Cartesian coordinates.",
        )
    rind = rind_of(grid, len(shape))
    axes = [axis for axis, letter in enumerate("XYZ") if f"Coordinate{letter}" in arrays]
    columns = [inside(arrays[f"Coordinate{'XYZ'[axis]}"], shape, rind).ravel() for axis in axes]
    points = np.zeros((columns[0].size, 3))
    points[:, axes] = np.column_stack(columns)
    return points


def results(node: CGNSNode, location: str, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    """Arrays of the last solution at "Vertex" or "CellCenter", flat."""
    found: dict[str, np.ndarray] = {}
    for solution in node.children("FlowSolution_t", "DiscreteData_t"):
        if location_of(solution) == location:
            rind = rind_of(solution, len(shape))
            found |= {one.name: inside(one, shape, rind).ravel() for one in solution.children("DataArray_t")}
    return found


def inside(node: CGNSNode, shape: tuple[int, ...], rind: np.ndarray) -> np.ndarray:
    """An array without the layers around it that rind (axes, 2), last index of CGNS first, tells of."""
    values = node.value()
    whole = tuple(int(length + layers.sum()) for length, layers in zip(shape, rind, strict=True))
    if values.dtype.kind not in "iuf" or values.shape != whole:
        raise FileError(
            node.path, f"{node.name} holds {values.dtype} {values.shape}: expected numbers {whole}", DAMAGED
        )
    return values[tuple(slice(int(low), int(low) + length) for (low, _), length in zip(rind, shape, strict=True))]


def rind_of(node: CGNSNode, axes: int) -> np.ndarray:
    """How many layers lie before and after the arrays of a node, (axes, 2), last index of CGNS first."""
    found = node.child("Rind_t")
    values = found.numbers().ravel() if found is not None else np.zeros(2 * axes, np.int64)
    if values.size != 2 * axes or values.min() < 0:
        raise FileError(node.path, f"{node.name} has the rind {values.tolist()}", DAMAGED)
    return values.reshape(axes, 2)[::-1]


def location_of(node: CGNSNode) -> str:
    """Where data or members of a node are: "Vertex" unless it says otherwise."""
    found = node.child("GridLocation_t")
    return found.text() if found is not None else "Vertex"


def conditions(node: CGNSNode) -> list[tuple[str, CGNSNode]]:
    """Boundary conditions of a zone and their names: those of their families where they have any."""
    return [
        (family(condition) or condition.name, condition)
        for parent in node.children("ZoneBC_t")
        for condition in parent.children("BC_t")
    ]


def add(sets: dict[str, np.ndarray], name: str, members: np.ndarray) -> None:
    """Add members to a set, which may be there already."""
    if len(members):
        sets[name] = np.concatenate([sets[name], members]) if name in sets else members
