"""Shader for edges of polygons: visible on every colour, and faded out on small faces."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkActor

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
vec3 tone = dot(face, vec3(0.30, 0.59, 0.11)) < 0.21 ? face + 0.33 : edgeColor;
"""


def tone_edges(actor: vtkActor, divisions: int = 1) -> None:
    """Draw the edges of an actor lighter on dark polygons, and paler on small ones.

    Polygons may be parts of faces whose edges are divided into `divisions` each; edges fade on small faces, not parts.
    Edges stay unchanged if the shader of this version of VTK has other lines.
    """
    prop = actor.GetShaderProperty()
    fade = _FADE if divisions == 1 else _FADE.replace("height / lineWidth", f"{divisions:.1f} * height / lineWidth")
    prop.AddFragmentShaderReplacement(_DIFFUSE, False, fade + _DIFFUSE, False)
    prop.AddFragmentShaderReplacement(_AMBIENT, False, _AMBIENT.replace("edgeColor", "tone"), False)
