"""What a step of one node is compared with, for tests."""

import itertools

import numpy as np

from hexmend import METHODS, Mesh
from hexmend.energy import MeshEnergy
from hexmend.kernels import local
from hexmend.smoothers.global_.descent import GlobalDescent
from hexmend.smoothers.local.single_node import LocalDescent

LOCAL = [name for name, method in METHODS.items() if issubclass(method, LocalDescent)]
GLOBAL = [name for name, method in METHODS.items() if issubclass(method, GlobalDescent)]
OTHERS = [name for name in METHODS if name not in LOCAL + GLOBAL]


def after(mesh, smoother, steps=1):
    """The points after some iterations."""
    return next(itertools.islice(smoother.steps(mesh), steps, None)).points


def swept(mesh, smoother, node):
    """The points after a sweep whose only node is this one."""
    points, settings = mesh.points.copy(), smoother.step_settings(smoother.delta_at(mesh, mesh.points))
    local.sweep(points, mesh.topology.hex_mesh, np.array([0, 1], np.int32), np.array([node], np.int32), settings)
    return points


def patch_energy(mesh, step, place):
    """Sum of eta^p over the patch with its node at a place, by the energy of whole hexes."""
    points = mesh.points.copy()
    points[step.node] = place
    nodes, hexes = np.unique(mesh.hexes[step.hexes], return_inverse=True)
    part = Mesh(points[nodes] / step.unit, hexes.reshape(-1, 8))
    energy = MeshEnergy(part, step.norm)
    return energy.value(part.points, step.delta)
