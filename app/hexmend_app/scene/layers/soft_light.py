"""Soft light of surfaces: a large key light and its reflection from all around, in the shader of a single light."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkActor

#: Ambient and diffuse share of the light. A face towards the viewer has the colour of the legend, exactly where the two
#: shares and the position of the light (see `hexmend_app.scene.views.pane`) add up to 1; no face that is seen from the
#: front has less than two thirds of it, so that shades are not mistaken for other values.
_AMBIENT, _DIFFUSE = 0.568, 0.46

#: Lines of VTK's fragment shader for a light, without and with edges; the angle of a soft light counts beyond 90°.
_NORMALS = ("normalVCVSOutput", "normalVCGSOutput")
_HARD = "df = max(0.0, dot({normal}, -lightDirectionVC0));"
_SOFT = "df = 0.5 + 0.5 * dot({normal}, -lightDirectionVC0);"


def light_softly(actor: vtkActor) -> None:
    """Light the polygons of an actor softly.

    A light of the size of half a sphere contributes (1 + cos t) / 2 at an angle t between its middle and the normal of
    a face, instead of max(0, cos t). One light in the shader thus replaces a kit of a key light and fill lights. Light
    is harder if the shader of this version of VTK has other lines.
    """
    prop = actor.GetProperty()
    prop.SetAmbient(_AMBIENT)
    prop.SetDiffuse(_DIFFUSE)
    for normal in _NORMALS:
        hard, soft = (line.format(normal=normal) for line in (_HARD, _SOFT))
        actor.GetShaderProperty().AddFragmentShaderReplacement(hard, False, soft, False)
