"""Frames of a small mesh in a viewport, for tests of what is seen."""

from hexmend.quality import measure
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.geometry.frame import Frame
from tests.core.grids import grid

MESH = grid(4)


def figures_of(mesh):
    return measure(mesh.points, mesh.elements, mesh.mid_nodes)


def frame_of(mesh, look=None, **tables):
    """Return a frame of a mesh, with a look or the tables of one."""
    return Frame(mesh, figures_of(mesh), look=look or Look(**tables))


def show(viewport, mesh=None, look=None):
    """Draw another mesh with the same look, or the same mesh with another look."""
    last = viewport.frame
    mesh = mesh or (last and last.mesh) or MESH
    viewport.draw(frame_of(mesh, look or (last.look if last else Look())))
