"""Corner tetrahedra that no movement of nodes can mend while the boundary keeps its patches and curves, with proofs.

Space for a layer at the nodes of the boundary.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from itertools import combinations

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.normals import unit_vectors
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.sliding.curved_faces import FlatPart, flat_parts
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import SOLID_KINDS, corner_tetrahedra, has_corner, kinds_of
from hexmend.quality.file_ids import hex_ids, node_ids
from hexmend.quality.measure import fixed_tetrahedra

#: Largest determinant that counts as 0, in products of the three edges, and largest change that counts as none, in
#: products of the longest edge squared and the second longest. Corners of thin hexes are positive though small.
_ROUNDING = 1e-6
#: Displacements that are tried: a determinant that is the same at all of them is constant.
_TRIALS = 4


class Reason(Enum):
    """Reason why the determinant of a corner tetrahedron cannot become positive."""

    FIXED = "its four nodes are fixed"
    PLANE = "its four nodes lie on one flat piece of the boundary"
    LINE = "three of its nodes lie on one straight edge of the boundary"
    CONSTANT = "no move of its nodes along the boundary changes its volume"


@dataclass(frozen=True)
class LockedCorner:
    """Corner tetrahedron that no movement can mend: its nodes, and the reason.

    Parameters
    ----------
    hex : int
    corner : int
        Row of `hexmend.mesh.solid_cells.SolidKind.corners`.
    nodes : tuple of int
        Its four nodes, the apex first.
    reason : Reason
    """

    hex: int
    corner: int
    nodes: tuple[int, int, int, int]
    reason: Reason

    @property
    def sentence(self) -> str:
        """The proof as a sentence."""
        return self.describe()

    def describe(self, mesh: Mesh | None = None) -> str:
        """Return the proof as a sentence, with the numbers that the file of `mesh` gives to hex and nodes."""
        others = ", ".join(map(str, self.nodes[1:]))
        kind = 0 if mesh is None else kinds_of(mesh.elements[[self.hex]])[0]
        cell = SOLID_KINDS[kind].name.capitalize() if kind else "Hex"
        place = f"{cell} {self.hex} at node {self.nodes[0]}, with its edges to {others}"
        of_hexes, of_nodes = (None, None) if mesh is None else (hex_ids(mesh), node_ids(mesh))
        if of_hexes is not None and of_nodes is not None:
            first, *rest = of_nodes[list(self.nodes)].tolist()
            place += f" (in the file {of_hexes[self.hex]} at {first}, to {', '.join(map(str, rest))})"
        return f"{place}: {self.reason.value}."


def find_locked_corners(mesh: Mesh, sliding: SlidingBoundary, hexes: np.ndarray) -> tuple[LockedCorner, ...]:
    """Find the corners of some hexes that stay inverted or flat wherever the nodes move that may.

    Nodes move that are free, and those of the boundary in the planes of their flat patches and along their straight
    curves; those of curved ones count as free. The determinant is affine in the displacement of each node: if it is
    the same at displacements taken at random, it is the same at all.

    Parameters
    ----------
    mesh : Mesh
    sliding : SlidingBoundary
        Of the mesh.
    hexes : (k,) int

    Returns
    -------
    tuple of LockedCorner
        By hex and corner.
    """
    cells = mesh.elements[hexes]
    tetrahedra = corner_tetrahedra(cells)
    parts = flat_parts(sliding.points, sliding.boundary, mesh.mean_edge_length)
    at, corner = np.nonzero(has_corner(cells) & _constant(mesh.points, tetrahedra, _projectors(sliding, parts)))
    fixed = fixed_tetrahedra(cells, sliding.mesh.fixed)
    count = {2: np.zeros(fixed.shape, dtype=np.int64), 1: np.zeros(fixed.shape, dtype=np.int64)}
    for part in parts:
        dimension = part.directions.shape[1]
        on_part = mask(part.nodes, mesh.n_nodes)[tetrahedra].sum(axis=2)
        np.maximum(count[dimension], on_part, out=count[dimension])
    found = []
    for row, k in zip(at.tolist(), corner.tolist(), strict=True):
        if fixed[row, k]:
            reason = Reason.FIXED
        elif count[2][row, k] == 4:
            reason = Reason.PLANE
        else:
            reason = Reason.LINE if count[1][row, k] >= 3 else Reason.CONSTANT
        found.append(LockedCorner(int(hexes[row]), k, tuple(tetrahedra[row, k].tolist()), reason))
    return tuple(found)


def _projectors(sliding: SlidingBoundary, parts: list[FlatPart]) -> np.ndarray:
    """Orthogonal projectors onto the directions in which each node may move, (n, 3, 3)."""
    mesh = sliding.mesh
    projectors = np.tile(np.eye(3), (mesh.n_nodes, 1, 1))
    nodes, onto = [], []
    if mesh.target is None:  # on a surface of its own nodes leave the planes of the mesh
        for part in parts:
            own = part.nodes[sliding.slides(part.nodes)]
            nodes.append(own)
            onto.append(np.tile(part.directions @ part.directions.T, (own.size, 1, 1)))
    motion = LinearMotion(np.concatenate(nodes), np.concatenate(onto)) if nodes else LinearMotion()
    projectors[motion.nodes] = motion.projectors
    given = mesh.linear_motion
    if given is not None:
        projectors[given.nodes] = given.projectors
    projectors[mesh.fixed] = 0.0
    return projectors


def _constant(points: np.ndarray, tetrahedra: np.ndarray, projectors: np.ndarray) -> np.ndarray:
    """Mark the tetrahedra (k, 8, 4) whose determinant is not positive and the same wherever the nodes are, (k, 8)."""
    x = points[tetrahedra]
    edges = x[:, :, 1:] - x[:, :, :1]
    length = np.sort(np.linalg.norm(edges, axis=-1), axis=-1)
    size, sigma = length[..., 2], np.linalg.det(edges)
    same = sigma <= _ROUNDING * length.prod(axis=-1)
    unchanged = _ROUNDING * size**2 * length[..., 1]
    random = np.random.default_rng(0)
    for _ in range(_TRIALS):
        moves = random.uniform(-1, 1, (len(points), 3))
        moves = np.einsum("nij,nj->ni", projectors, moves)[tetrahedra] * size[..., None, None]
        moved = x + moves
        change = np.abs(np.linalg.det(moved[:, :, 1:] - moved[:, :, :1]) - sigma)
        same &= change <= unchanged
    return same


#: Least sine of the angle between a direction and the planes of all faces for which there is space.
_MIN_SINE = 1e-6
#: Bound of the rounding error in the product of two unit vectors.
_PRODUCT_ROUNDING = 4 * np.finfo(np.float64).eps


def nodes_without_space(mesh: Mesh, hexes: np.ndarray) -> np.ndarray:
    """Find boundary nodes at which no direction leads below all faces of the boundary around them.

    Every hex of a layer has an edge from such a node to the copy of it. Wherever the copy is, one of these hexes is
    inverted, as long as the boundary stays.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int
        Only their nodes are examined.

    Returns
    -------
    (c,) int64
        Numbers of nodes, ascending.
    """
    x, quads = mesh.points, mesh.topology.boundary_faces
    ahead, back = np.roll(quads, -1, axis=1), np.roll(quads, 1, axis=1)
    triangle = quads[:, 2] == quads[:, 3]  # with its last node twice
    ahead[triangle, 2], back[triangle, 3] = quads[triangle, 0], quads[triangle, 1]
    normals = unit_vectors(np.cross(x[ahead] - x[quads], x[back] - x[quads])).reshape(-1, 3)
    at = quads.ravel()
    order = np.argsort(at, kind="stable")
    nodes = np.unique(mesh.elements[hexes])
    nodes = nodes[mesh.topology.boundary[nodes]]
    start, end = np.searchsorted(at, nodes, sorter=order), np.searchsorted(at, nodes, "right", sorter=order)
    sines = [inward_direction(normals[order[i:j]])[1] for i, j in zip(start, end, strict=True)]
    return nodes[np.array(sines) <= _MIN_SINE].astype(np.int64)


def inward_direction(normals: np.ndarray) -> tuple[np.ndarray, float]:
    """Find the direction that is furthest below the planes of faces at a node.

    The direction for a few of the faces is that for all of them if it is as far below the others; if not, the face
    that it is least far below joins the few, which stay below a dozen even for thousands of faces.

    Parameters
    ----------
    normals : (k, 3) float64
        Unit normals, outward.

    Returns
    -------
    direction : (3,) float64
        The best one where there is space for a layer.
    sine : float
        Least sine of its angle to a plane; there is space for a layer where it is positive.
    """
    few = [0]
    while True:
        direction, sine = _direction_of_few(normals[few])
        products = normals @ direction
        worst = int(products.argmax())
        if not (sine > 0 and products[worst] + sine > _PRODUCT_ROUNDING):
            return direction, -float(products[worst])
        few.append(worst)


def _direction_of_few(normals: np.ndarray) -> tuple[np.ndarray, float]:
    """Find the direction of `inward_direction`: it has equal products with one, two or three of the normals."""
    candidates = [-normals]
    for count in (2, 3):
        rows = np.array(list(combinations(range(len(normals)), count)), dtype=np.int64).reshape(-1, count)
        some = normals[rows]
        if count == 2:
            candidates.append(-some.sum(axis=1))
        else:
            crosses = np.cross(some, np.roll(some, -1, axis=1)).sum(axis=1)
            candidates += [crosses, -crosses]
    directions = unit_vectors(np.concatenate(candidates))
    sines = -(normals @ directions.T).max(axis=0)
    best = int(sines.argmax())
    return directions[best], float(sines[best])
