"""Scripts that run other programs, in a Python that has their packages; Hexmend need not be installed there.

Arguments are the paths of two NumPy archives: input with `points` (n, 3), `hexes` (m, 8) and `quads` (k, 4) of the
boundary, output with `points` and `seconds`, the time of the method without reading and writing.
"""

from __future__ import annotations

#: Winslow untangling of Gmsh; nodes of boundary faces belong to the surface, which is fixed.
GMSH = """
import sys
from time import perf_counter
import gmsh
import numpy as np
data = np.load(sys.argv[1])
points, hexes, quads = data["points"], data["hexes"], data["quads"]
gmsh.initialize(interruptible=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.add("mesh")
gmsh.model.addDiscreteEntity(2, 1)
gmsh.model.addDiscreteEntity(3, 1, [1])
surface = np.unique(quads)
inside = np.setdiff1d(hexes, surface)
gmsh.model.mesh.addNodes(2, 1, surface + 1, points[surface].ravel())
gmsh.model.mesh.addNodes(3, 1, inside + 1, points[inside].ravel())
gmsh.model.mesh.addElementsByType(1, 3, [], (quads + 1).ravel())
gmsh.model.mesh.addElementsByType(1, 5, [], (hexes + 1).ravel())
began = perf_counter()
gmsh.model.mesh.optimize("UntangleMeshGeometry", force=True)
seconds = perf_counter() - began
tags, places, _ = gmsh.model.mesh.getNodes()  # it has numbered them anew
order = np.argsort(tags)
_, corners = gmsh.model.mesh.getElementsByType(5)
moved = points.copy()
moved[hexes.ravel()] = places.reshape(-1, 3)[order][np.searchsorted(tags[order], corners)]
np.savez(sys.argv[2], points=moved, seconds=seconds)
"""

#: TMOP of MFEM: shape metric 303 towards hexes of equal size. Its metrics that untangle in 3D are not available from
#: Python.
TMOP = """
import sys
from time import perf_counter
import numpy as np
import mfem.ser as mfem
from mfem._ser.tmop import TargetConstructor, TMOP_Integrator, TMOP_Metric_303
from mfem._ser.tmop_tools import TMOPNewtonSolver
data = np.load(sys.argv[1])
points, hexes, quads = data["points"], data["hexes"], data["quads"]
mesh = mfem.Mesh(3, len(points), len(hexes), len(quads), 3)
for point in points.tolist():
    mesh.AddVertex(*point)
for hex in hexes.tolist():
    mesh.AddHex(hex, 1)
for quad in quads.tolist():
    mesh.AddBdrQuad(quad, 1)
mesh.FinalizeHexMesh(0, 0, False)
space = mfem.FiniteElementSpace(mesh, mfem.H1_FECollection(1, 3), 3)
mesh.SetNodalFESpace(space)
nodes = mesh.GetNodes()
rule = mfem.IntRules.Get(mfem.Geometry.CUBE, 4)
for k in range(mesh.GetNE()):
    at = mesh.GetElementTransformation(k)
    for j in range(rule.GetNPoints()):
        at.SetIntPoint(rule.IntPoint(j))
        if at.Weight() <= 0:
            sys.exit("its metrics that untangle in 3D are not available from Python")
metric, target = TMOP_Metric_303(), TargetConstructor(TargetConstructor.IDEAL_SHAPE_EQUAL_SIZE)
target.SetNodes(nodes)
integrator = TMOP_Integrator(metric, target)
integrator.SetIntegrationRule(rule)
integrator.thisown = 0
form = mfem.NonlinearForm(space)
form.AddDomainIntegrator(integrator)
form.SetEssentialBC(mfem.intArray([1]))
linear = mfem.MINRESSolver()
linear.SetMaxIter(100)
linear.SetRelTol(1e-12)
newton = TMOPNewtonSolver(rule, 0)
newton.SetPreconditioner(linear)
newton.SetMaxIter(100)
newton.SetRelTol(1e-8)
newton.SetOperator(form)
began = perf_counter()
newton.Mult(mfem.Vector(0), nodes)
seconds = perf_counter() - began
values = np.array(nodes.GetDataArray())
moved = values.reshape(3, -1).T if space.GetOrdering() == mfem.Ordering.byNODES else values.reshape(-1, 3)
np.savez(sys.argv[2], points=moved, seconds=seconds)
"""
