"""TMOP of MFEM by the package `mfem`: the target-matrix optimisation of Knupp and others, with Newton's method."""

from __future__ import annotations

from benchmarks.peers.peer import PythonPeer

#: Metric 303 towards cubes with the eight corners as quadrature points: the sum over hexes of the mean of 1/q - 1,
#: which is the objective of `mend` with p = 1. It needs a mesh without inverted hexes; the metrics that untangle take a
#: reference to a number, which Python cannot pass.
_PROGRAM = """
import sys
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
rules = mfem.IntegrationRules(0, mfem.Quadrature1D.GaussLobatto)
rule = rules.Get(mfem.Geometry.CUBE, 1)
for k in range(mesh.GetNE()):
    at = mesh.GetElementTransformation(k)
    for j in range(rule.GetNPoints()):
        at.SetIntPoint(rule.IntPoint(j))
        if at.Weight() <= 0:
            sys.exit("it needs a mesh without inverted hexes: its metrics that untangle cannot be made from Python")
metric, target = TMOP_Metric_303(), TargetConstructor(TargetConstructor.IDEAL_SHAPE_UNIT_SIZE)
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
linear.SetAbsTol(0.0)
newton = TMOPNewtonSolver(rule, 0)
newton.SetPreconditioner(linear)
newton.SetMaxIter(200)
newton.SetRelTol(1e-8)
newton.SetAbsTol(0.0)
newton.SetOperator(form)
newton.Mult(mfem.Vector(0), nodes)
values = np.array(nodes.GetDataArray())
moved = values.reshape(3, -1).T if space.GetOrdering() == mfem.Ordering.byNODES else values.reshape(-1, 3)
np.savez(sys.argv[2], points=moved)
"""

TMOP = PythonPeer(
    name="tmop",
    title="TMOP",
    note="MFEM's metric 303 towards cubes, corners as quadrature points, Newton's method with MINRES; only meshes "
    "without inverted hexes",
    shape=True,
    package="mfem",
    program=_PROGRAM,
)
