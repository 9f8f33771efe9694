"""Base class of gallery meshes, and their registry.

Structured hexes from which gallery meshes are assembled.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, TypeVar

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.parameters import Parametrised, parameter
from hexmend.registry import Registry, load_entry_points


@dataclass(frozen=True)
class GalleryMesh(Parametrised, ABC):
    """Generated mesh; the same parameters give the same mesh.

    Subclasses declare `size` (approximate number of hexes) and other parameters, and implement `regular`; scrambling is
    common to all.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    help: ClassVar[str]
    source: ClassVar[str]

    scramble: float = parameter(
        0.0, low=0, high=5, unit="local edge length", help="Largest random displacement of free nodes."
    )
    seed: int = parameter(0, low=0, high=2**31 - 1, help="Seed of the displacements.")

    @abstractmethod
    def regular(self) -> Mesh:
        """Build the mesh before scrambling."""

    def build(self) -> Mesh:
        """Build the mesh."""
        mesh = self.regular()
        mesh = mesh.replace(name=f"{self.name}-{mesh.n_elements}")
        return self.scrambled(mesh) if self.scramble > 0 else mesh

    def scrambled(self, mesh: Mesh) -> Mesh:
        """Displace the free nodes of the mesh at random."""
        return scramble_nodes(mesh, self.scramble, self.seed)


def scramble_nodes(mesh: Mesh, amplitude: float, seed: int) -> Mesh:
    """Displace free nodes at random, uniformly in balls.

    Parameters
    ----------
    mesh : Mesh
    amplitude : float
        Radius of each ball in mean lengths of the edges at the node.
    seed : int

    Returns
    -------
    Mesh
    """
    ring, points = mesh.topology.rings, mesh.points
    owner = np.repeat(np.arange(mesh.n_nodes), np.diff(ring.start))
    length = np.linalg.norm(points[ring.items] - points[owner], axis=1)
    mean = np.bincount(owner, length, minlength=mesh.n_nodes) / np.maximum(np.diff(ring.start), 1)
    random = np.random.default_rng(seed)
    direction = random.normal(size=points.shape)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    radius = amplitude * mean * np.cbrt(random.uniform(size=mesh.n_nodes))
    return mesh.with_points(points + np.where(mesh.free, radius, 0.0)[:, None] * direction)


G = TypeVar("G", bound=type[GalleryMesh])

#: The entry-point group of other distributions' gallery meshes; entries name a class.
GROUP = "hexmend.gallery"


def load_plugins() -> None:
    """Load the gallery meshes of other distributions."""
    load_entry_points(GROUP, "gallery mesh", _take)


def _take(name: str, found: object) -> None:
    if not (isinstance(found, type) and issubclass(found, GalleryMesh)):
        raise TypeError(f"{found!r} is not a hexmend.gallery.GalleryMesh")
    if found not in GALLERY.values():  # its module may have registered it
        gallery_mesh(found)


GALLERY: Registry[type[GalleryMesh]] = Registry("gallery mesh", load_plugins)
"""Generated meshes by name; those of other distributions are loaded when all names are asked for."""


def gallery_mesh(cls: G) -> G:
    """Register a gallery mesh under its name; a class decorator."""
    GALLERY.add(cls.name, cls)
    return cls


def box_hexes(nx: int, ny: int, nz: int) -> np.ndarray:
    """Return the hexes of a structured grid.

    Parameters
    ----------
    nx, ny, nz : int
        Number of hexes in each direction; nodes are numbered x first, then y, then z.

    Returns
    -------
    (nx ny nz, 8) int64
    """
    floor = np.arange((nx + 1) * (ny + 1)).reshape(ny + 1, nx + 1)
    return extrude(grid_quads(floor), floor.size, nz)


def grid_quads(numbers: np.ndarray) -> np.ndarray:
    """Return the quads of grids of node numbers (..., ny + 1, nx + 1), counter-clockwise, (k, 4) int64."""
    low, high = slice(None, -1), slice(1, None)
    corners = [(low, low), (low, high), (high, high), (high, low)]  # by y and x
    return np.stack([numbers[..., y, x] for y, x in corners], axis=-1).reshape(-1, 4)


def tensor_product(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the nodes of a structured grid from its planes (nx,), (ny,), (nz,), numbered x first, (nx ny nz, 3)."""
    grids = np.meshgrid(z, y, x, indexing="ij")
    return np.column_stack([grid.ravel() for grid in grids[::-1]])


def extrude(quads: np.ndarray, nodes: int, layers: int) -> np.ndarray:
    """Return the hexes of quads extruded in layers.

    Parameters
    ----------
    quads : (k, 4) int
        Counter-clockwise seen from above.
    nodes : int
        Number of nodes of the plane; node i of layer j has the number j * nodes + i.
    layers : int

    Returns
    -------
    (layers * k, 8) int64
    """
    floor = np.concatenate([quads, quads + nodes], axis=1)
    return (floor[None] + nodes * np.arange(layers)[:, None, None]).reshape(-1, 8)
