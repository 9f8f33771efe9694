"""Rules of motion: what happens to interfaces between materials and to the nodes of named sets."""

from hexmend.mesh.rules.motion_rules import INTERFACES, MotionRules, NodeRules

__all__ = ["INTERFACES", "MotionRules", "NodeRules"]
