"""Hexahedral meshes: nodes, hexes and what belongs to them."""

from hexmend.mesh.mesh import Mesh

__all__ = ["Mesh"]
