"""Actors of one colour that no light changes."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer


def flat_actor(renderer: vtkRenderer, width: float = 1.0, opacity: float = 1.0) -> vtkActor:
    """One that draws nothing until it has a colour and its mapper something to draw, and is not picked.

    Parameters
    ----------
    renderer : vtkRenderer
    width : float
        Of its lines, in pixels.
    opacity : float
    """
    mapper = vtkPolyDataMapper()
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.PickableOff()
    actor.VisibilityOff()
    how = actor.GetProperty()
    how.LightingOff()
    how.SetLineWidth(width)
    how.SetOpacity(opacity)
    renderer.AddActor(actor)
    return actor
