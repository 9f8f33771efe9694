"""Unlit actors of one colour."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer


def flat_actor(renderer: vtkRenderer, width: float = 1.0, opacity: float = 1.0) -> vtkActor:
    """Add a hidden, unpickable actor without data to a renderer, and return it.

    Parameters
    ----------
    renderer : vtkRenderer
    width : float
        Line width in pixels.
    opacity : float
    """
    mapper = vtkPolyDataMapper()
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.PickableOff()
    actor.VisibilityOff()
    prop = actor.GetProperty()
    prop.LightingOff()
    prop.SetLineWidth(width)
    prop.SetOpacity(opacity)
    renderer.AddActor(actor)
    return actor
