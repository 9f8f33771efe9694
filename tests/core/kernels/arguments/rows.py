"""Rows of the table of arguments, and the small mesh that they belong to."""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import local
from hexmend.kernels.floor_barrier import Floors
from hexmend.kernels.line_search import LineSearch
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.mesh import Mesh
from tests.core.grids import grid, scrambled


@dataclass(frozen=True)
class Row:
    """Arguments of a kernel that are not common ones; arrays of any length or none; the object whose method it is."""

    kernel: str
    values: dict[str, Any]
    any_length: frozenset[str]
    empty: frozenset[str]
    owner: Any


def row(kernel: str, numbered: str = "", listed: str = "", empty: str = "", of: Any = None, **values: Any) -> Row:
    """Make a row; see the package."""
    return Row(kernel, values, frozenset([*numbered.split(), *listed.split()]), frozenset(empty.split()), of)


class Case:
    """A mesh of m hexes and n nodes, k of them free, with f faces on its boundary, which slide."""

    def __init__(self, mesh: Mesh):
        self.mesh, self.n, self.m = mesh, mesh.n_nodes, mesh.n_hexes
        self.nodes = np.flatnonzero(mesh.free).astype(np.int32)
        self.k = len(self.nodes)
        self.sliding, self.sparsity = SlidingBoundary(mesh), BlockSparsity(mesh)
        self.faces = self.sliding.boundary.faces
        self.f = len(self.faces)
        self.target = TargetMatrices(np.ones((self.m, 3)))

    def common(self) -> dict[str, Any]:
        """Arguments that many kernels have."""
        topology, none = self.mesh.topology, np.full(self.m, -np.inf)
        corners, rings = topology.node_corners, topology.rings
        return {
            "points": self.mesh.points,
            "hexes": self.mesh.hexes,
            "start": corners.start,
            "corners": corners.items,
            "ring_start": rings.start,
            "ring": rings.items,
            "mesh": topology.hex_mesh,
            "neighbours": topology.face_neighbours,
            "nodes": self.nodes,
            "free": self.mesh.free,
            "keep": self.m,
            "omitted": self.m,
            "delta": 0.1,
            "norm": (2.0, 1.0),
            "offset": 1.0,
            "target": self.target,
            "floors": Floors(none, none, np.zeros(self.m, np.uint8), 0.1, 0.1, 1.0),
            "shares": self.sparsity.shares(2),
            "surface": self.sliding.sliding_surface,
            "settings": local.NodeStepSettings(local.Direction.NEWTON, 0.1, (2.0, 1.0), LineSearch(), self.target),
        }


@cache
def case() -> Case:
    """The mesh of the table."""
    return Case(scrambled(grid(3), 0.1))


@cache
def common() -> dict[str, Any]:
    """Arguments of the mesh of the table that many kernels have."""
    return case().common()


@cache
def of_another_mesh() -> dict[str, Any]:
    """Those of them that are objects, of a mesh with other numbers of nodes and hexes."""
    given = Case(scrambled(grid(2), 0.1)).common()
    return {name: given[name] for name in ("mesh", "target", "floors", "shares", "surface")}
