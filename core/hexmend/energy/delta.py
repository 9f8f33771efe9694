"""delta: how far the barrier of (3.2) is softened while a mesh is tangled."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.quality import ElementQuality


@dataclass(frozen=True)
class FixedDelta:
    """The thesis's policy (3.2.4): one value while any hex is inverted, zero from then on.

    Parameters
    ----------
    value : float
        In the cube of the mean edge length (of the mesh or of the patch, whichever is minimised over).
    """

    value: float = 0.01

    def at(self, figures: ElementQuality) -> float:
        """Delta for a mesh of these figures."""
        return self.value if figures.n_inverted else 0.0
