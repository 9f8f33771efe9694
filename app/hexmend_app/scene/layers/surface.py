"""Surfaces of polygons, each with a colour."""

from __future__ import annotations

import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend_app.scene.geometry.coloured_polygons import COLOURS
from hexmend_app.theme.palette import rgb

#: Colour of edges; on dark faces, edges are lighter than the face instead.
EDGE = "#1b1f2a"

# Lines of VTK's fragment shader that draw an edge; emix is the coverage of the pixel by the edge.
_DIFFUSE = "diffuseColor = mix(diffuseColor, vec3(0.0), emix * edgeOpacity);"
_AMBIENT = "ambientColor = mix( ambientColor, edgeColor, emix * edgeOpacity);"

# The shader has the distances of a pixel from the three lines that bound its triangle, and the normals of the lines.
# The smallest height of the triangle, over the side opposite to the largest angle, follows from the law of sines:
#     h = (s_0 d_0 + s_1 d_1 + s_2 d_2) / max(s_0, s_1, s_2),    s_i the sine of the angle opposite to line i.
# Edges fade as the height approaches the line width; for a square with a side of four pixels, h = 2.8.
_FADE = """
vec2 n0 = edgeEqn[0].xy, n1 = edgeEqn[1].xy, n2 = edgeEqn[2].xy;
vec3 sines = abs(vec3(n1.x * n2.y - n1.y * n2.x, n2.x * n0.y - n2.y * n0.x, n0.x * n1.y - n0.y * n1.x));
vec3 outside = vec3(edist[0] - edgeEqn[0].z, edist[1] - edgeEqn[1].z, edist[2] - edgeEqn[2].z);
float height = dot(sines, outside) / max(max(sines.x, sines.y), max(sines.z, 1e-6));
emix *= smoothstep(1.0, 2.8, height / lineWidth);
vec3 face = ambientColor / max(ambientIntensity, 1e-3);
float luma = dot(face, vec3(0.30, 0.59, 0.11));
vec3 tone = mix(face + 0.33, edgeColor * smoothstep(0.1, 0.4, luma), smoothstep(0.03, 0.08, luma));
emix *= mix(2.0, 1.0, smoothstep(0.1, 0.4, luma));
"""


#: Ambient and diffuse share of the light. A face towards the viewer has the colour of the legend, exactly where the two
#: shares and the position of the light (see `hexmend_app.scene.camera.pane`) add up to 1; no face that is seen from the
#: front has less than two thirds of it, so that shades are not mistaken for other values.
_AMBIENT_SHARE, _DIFFUSE_SHARE = 0.568, 0.46

#: Lines of VTK's fragment shader for a light, without and with edges; the angle of a soft light counts beyond 90°.
_NORMALS = ("normalVCVSOutput", "normalVCGSOutput")

_HARD = "df = max(0.0, dot({normal}, -lightDirectionVC0));"

_SOFT = "df = 0.5 + 0.5 * dot({normal}, -lightDirectionVC0);"

#: Name of the point colours of fine polygons.
SHADED = "shaded"


def tone_edges(actor: vtkActor, divisions: int = 1) -> None:
    """Draw the edges of an actor lighter on dark polygons, and paler on small ones.

    Polygons may be parts of faces whose edges are divided into `divisions` each; edges fade on small faces, not parts.
    Edges stay unchanged if the shader of this version of VTK has other lines.
    """
    prop = actor.GetShaderProperty()
    fade = _FADE if divisions == 1 else _FADE.replace("height / lineWidth", f"{divisions:.1f} * height / lineWidth")
    prop.AddFragmentShaderReplacement(_DIFFUSE, False, fade + _DIFFUSE, False)
    prop.AddFragmentShaderReplacement(_AMBIENT, False, _AMBIENT.replace("edgeColor", "tone"), False)


def light_softly(actor: vtkActor) -> None:
    """Light the polygons of an actor softly.

    A light of the size of half a sphere contributes (1 + cos t) / 2 at an angle t between its middle and the normal of
    a face, instead of max(0, cos t). One light in the shader thus replaces a kit of a key light and fill lights. Light
    is harder if the shader of this version of VTK has other lines.
    """
    prop = actor.GetProperty()
    prop.SetAmbient(_AMBIENT_SHARE)
    prop.SetDiffuse(_DIFFUSE_SHARE)
    for normal in _NORMALS:
        hard, soft = (line.format(normal=normal) for line in (_HARD, _SOFT))
        actor.GetShaderProperty().AddFragmentShaderReplacement(hard, False, soft, False)


class Surface:
    """Actor of polygons that are replaced, moved and recoloured.

    Parameters
    ----------
    renderer : vtkRenderer
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, pixel_ratio: float = 1.0):
        self.poly = pv.PolyData()
        self._edges, self._without_edges, self._divisions = True, False, 1
        self.actor = vtkActor()
        self.actor.PickableOff()
        prop = self.actor.GetProperty()
        prop.SetEdgeColor(rgb(EDGE))
        prop.SetEdgeOpacity(0.5)
        prop.SetLineWidth(pixel_ratio)
        prop.SetInterpolationToPhong()  # applies to polygons with normals
        tone_edges(self.actor)
        light_softly(self.actor)
        renderer.AddActor(self.actor)
        self._flat, self._fine = vtkPolyDataMapper(), vtkPolyDataMapper()
        self._flat.SetScalarModeToUseCellFieldData()
        self._fine.SetScalarModeToUsePointFieldData()
        for mapper, colours in ((self._flat, COLOURS), (self._fine, SHADED)):
            mapper.SelectColorArray(colours)
            mapper.SetColorModeToDirectScalars()
            mapper.ScalarVisibilityOn()
        self._update_edges()
        self.actor.SetVisibility(False)

    def replace(self, poly: pv.PolyData) -> None:
        """Replace the polygons, made by `hexmend_app.scene.geometry.coloured_polygons.coloured`."""
        self.poly = poly
        self._flat.SetInputData(poly)
        self.actor.SetMapper(self._flat)
        self.actor.SetVisibility(poly.GetNumberOfCells() > 0)

    def show_proxy(self, poly: pv.PolyData | None) -> None:
        """Draw other polygons instead, without edges; None draws the polygons themselves again."""
        self._flat.SetInputData(self.poly if poly is None else poly)
        self.actor.SetMapper(self._flat)
        self._without_edges = poly is not None
        self._update_edges()

    def refine(self, poly: pv.PolyData) -> None:
        """Set the fine polygons, as made by `hexmend_app.scene.layers.shaded_surface.shaded_surface`."""
        self._fine.SetInputData(poly)

    def show_fine(self) -> None:
        """Draw the fine polygons until other polygons are set."""
        self.actor.SetMapper(self._fine)
        self._without_edges = False
        self._update_edges()

    @property
    def corners(self) -> int:
        """Total number of corners of the polygons."""
        return self.poly.GetPolys().GetNumberOfConnectivityIds()

    def hide(self) -> None:
        """Hide the surface."""
        self.actor.SetVisibility(False)

    @property
    def shown(self) -> bool:
        """True while the surface is drawn."""
        return bool(self.actor.GetVisibility())

    def show_edges(self, on: bool) -> None:
        """Show or hide the edges of the polygons."""
        self._edges = on
        self._update_edges()

    def divide_edges(self, divisions: int) -> None:
        """Set the number of parts into which the edges of faces are divided; edges fade on small faces."""
        if divisions != self._divisions:
            self._divisions = divisions
            tone_edges(self.actor, divisions)

    def _update_edges(self) -> None:
        self.actor.GetProperty().SetEdgeVisibility(self._edges and not self._without_edges)
