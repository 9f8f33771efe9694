"""Unlit actors of one colour, their depth, and labels."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkActor, vtkBillboardTextActor3D, vtkMapper, vtkPolyDataMapper, vtkRenderer

from hexmend_app.theme.palette import rgb


def flat_actor(renderer: vtkRenderer, width: float = 1.0, opacity: float = 1.0, colour: str = "#ffffff") -> vtkActor:
    """Add a hidden, unpickable actor without data to a renderer, and return it.

    Parameters
    ----------
    renderer : vtkRenderer
    width : float
        Line width in pixels.
    opacity : float
    colour : str
        As #rrggbb.
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
    prop.SetColor(rgb(colour))
    renderer.AddActor(actor)
    return actor


def offset_depth(
    mapper: vtkMapper,
    *,
    lines: float | None = None,
    polygons: float | None = None,
    points: float | None = None,
    slope: float = 0.0,
) -> None:
    """Offset the depth of lines, polygons and points, in VTK's units; positive is behind.

    Parameters
    ----------
    mapper : vtkMapper
    lines, polygons, points : float, optional
        Offsets; None leaves that of VTK.
    slope : float
        Further offset of lines and polygons, times the slope of their depth.
    """
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    if lines is not None:
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(slope, lines)
    if polygons is not None:
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(slope, polygons)
    if points is not None:
        mapper.SetRelativeCoincidentTopologyPointOffsetParameter(points)


def label_actor(renderer: vtkRenderer, size: int) -> vtkBillboardTextActor3D:
    """Add a label at a point of the scene, white on dark and centred, to a renderer, and return it.

    Parameters
    ----------
    renderer : vtkRenderer
    size : int
        Height of the letters in pixels.
    """
    actor = vtkBillboardTextActor3D()
    actor.SetInput(" ")
    actor.PickableOff()
    prop = actor.GetTextProperty()
    prop.SetFontSize(size)
    prop.SetBold(True)
    prop.SetColor(1, 1, 1)
    prop.SetBackgroundColor(0.07, 0.08, 0.11)
    prop.SetBackgroundOpacity(0.75)
    prop.SetJustificationToCentered()
    prop.SetVerticalJustificationToCentered()
    renderer.AddActor(actor)
    return actor
