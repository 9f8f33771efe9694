"""Second-order hexahedra: their mid-nodes and shape functions."""

from hexmend.mesh.second_order.mid_nodes import (
    GAUSS_POINTS,
    MID_EDGES,
    MID_NODE_POSITIONS,
    MID_NODE_WEIGHTS,
    MIRRORED_MID_NODES,
    NODE_POSITIONS,
    corners_of_mid_nodes,
    jacobian_range,
    move_mid_nodes,
)

__all__ = [
    "GAUSS_POINTS",
    "MID_EDGES",
    "MID_NODE_POSITIONS",
    "MID_NODE_WEIGHTS",
    "MIRRORED_MID_NODES",
    "NODE_POSITIONS",
    "corners_of_mid_nodes",
    "jacobian_range",
    "move_mid_nodes",
]
