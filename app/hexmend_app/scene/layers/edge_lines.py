"""Edges of polygons: visible on every colour, and faded out before they cover small faces."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkActor

#: Colour of edges; on dark colours they are lighter than these instead.
EDGE = "#1b1f2a"

# What VTK's program for the pixels of a polygon draws an edge by: how much of the pixel is on it is emix.
_LIT = "diffuseColor = mix(diffuseColor, vec3(0.0), emix * edgeOpacity);"
_TONED = "ambientColor = mix( ambientColor, edgeColor, emix * edgeOpacity);"

# A pixel knows how far it is from the three lines that bound its triangle, and these lines' normals. By the law of
# sines the triangle's least height follows: over its longest side, opposite to the largest angle,
#     h = (s_0 d_0 + s_1 d_1 + s_2 d_2) / max(s_0, s_1, s_2),    s_i the sine of the angle opposite to line i.
# Lines fade as the heights become as small as the lines are wide: of a square with a side of four pixels, h = 2.8.
_OURS = """
vec2 n0 = edgeEqn[0].xy, n1 = edgeEqn[1].xy, n2 = edgeEqn[2].xy;
vec3 sines = abs(vec3(n1.x * n2.y - n1.y * n2.x, n2.x * n0.y - n2.y * n0.x, n0.x * n1.y - n0.y * n1.x));
vec3 away = vec3(edist[0] - edgeEqn[0].z, edist[1] - edgeEqn[1].z, edist[2] - edgeEqn[2].z);
float least = dot(sines, away) / max(max(sines.x, sines.y), max(sines.z, 1e-6));
emix *= smoothstep(1.0, 2.8, least / lineWidth);
vec3 face = ambientColor / max(ambientIntensity, 1e-3);
vec3 tone = dot(face, vec3(0.30, 0.59, 0.11)) < 0.21 ? face + 0.33 : edgeColor;
"""


def tone_edges(actor: vtkActor) -> None:
    """Draw an actor's edges lighter where its polygons are dark, and paler the smaller these are in the picture.

    With another shader program of VTK, edges stay unchanged.
    """
    prop = actor.GetShaderProperty()
    prop.AddFragmentShaderReplacement(_LIT, False, _OURS + _LIT, False)
    prop.AddFragmentShaderReplacement(_TONED, False, _TONED.replace("edgeColor", "tone"), False)
