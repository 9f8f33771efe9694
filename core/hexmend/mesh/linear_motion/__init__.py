"""Linear constraints on the displacements of nodes: planes, lines, and nodes that move as one."""

from hexmend.mesh.linear_motion.linear_motion import LinearMotion

__all__ = ["LinearMotion"]
