"""Topology of a mesh: its faces, the neighbours of nodes and hexes, and connected components."""

from hexmend.aliases import exports
from hexmend.mesh.topology.topology import CSR, Topology

__all__ = ["CSR", "Topology"]


__getattr__ = exports(__name__)
