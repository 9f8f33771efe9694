"""Energy of the quads of a sliding boundary, a term of the objective."""

from hexmend.energy.quads.surface_quads import SurfaceQuads
from hexmend.energy.quads.surface_term import SurfaceTerm

__all__ = ["SurfaceQuads", "SurfaceTerm"]
