"""Topology of a mesh: its faces, the neighbours of nodes and hexes, and connected components."""

from hexmend.mesh.topology.topology import CSR, Topology

__all__ = ["CSR", "Topology"]
