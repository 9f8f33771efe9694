"""Gmsh by its Python package: the optimisers of `gmsh.model.mesh.optimize` that move nodes of linear hexes."""

from __future__ import annotations

from benchmarks.peers.peer import PythonPeer

#: Nodes of boundary faces belong to the surface, which is fixed. Gmsh numbers nodes anew.
_PROGRAM = """
import sys
import gmsh
import numpy as np
data = np.load(sys.argv[1])
points, hexes, quads = data["points"], data["hexes"], data["quads"]
gmsh.initialize(interruptible=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("General.NumThreads", 1)
gmsh.model.add("mesh")
gmsh.model.addDiscreteEntity(2, 1)
gmsh.model.addDiscreteEntity(3, 1, [1])
surface = np.unique(quads)
inside = np.setdiff1d(hexes, surface)
gmsh.model.mesh.addNodes(2, 1, surface + 1, points[surface].ravel())
gmsh.model.mesh.addNodes(3, 1, inside + 1, points[inside].ravel())
gmsh.model.mesh.addElementsByType(1, 3, [], (quads + 1).ravel())
gmsh.model.mesh.addElementsByType(1, 5, [], (hexes + 1).ravel())
tags, _ = gmsh.model.mesh.getElementsByType(5)
inverted = (gmsh.model.mesh.getElementQualities(tags, "minSICN") <= 0).any()
if inverted:
    gmsh.model.mesh.optimize("UntangleMeshGeometry", force=True)
else:
    gmsh.model.mesh.optimize("Relocate3D", force=True, niter=10)
tags, places, _ = gmsh.model.mesh.getNodes()
order = np.argsort(tags)
_, corners = gmsh.model.mesh.getElementsByType(5)
moved = points.copy()
moved[hexes.ravel()] = places.reshape(-1, 3)[order][np.searchsorted(tags[order], corners)]
np.savez(sys.argv[2], points=moved)
"""

GMSH = PythonPeer(
    name="gmsh",
    title="Gmsh",
    note="UntangleMeshGeometry (Winslow) for a mesh with inverted hexes, else Relocate3D with 10 iterations; its other "
    "optimisers are for tetrahedra, surfaces or curved elements",
    package="gmsh",
    program=_PROGRAM,
)
