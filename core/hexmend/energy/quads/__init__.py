"""Energy of the quads of a sliding boundary, a term of the objective."""

from hexmend.energy.quads.surface_quads import SurfaceQuads, SurfaceTerm

__all__ = ["SurfaceQuads", "SurfaceTerm"]
