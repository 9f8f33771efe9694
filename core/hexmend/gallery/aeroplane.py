"""Shape of the aeroplane in the gallery mesh `plane`: parts that are boxes in a grid, and maps to their surfaces.

The unit of length is about the fuselage's length. x runs aft from the nose, y to starboard, z up; the fuselage's axis
is y = z = 0.

A part has the `boxes` that it fills in the grid and `map_to_surface`, which maps points on these boxes to its surface.
A point that two parts share, at a wing's root, is mapped by the later one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Half the thickness of the boxes of wings and fin.
HALF_BOX = 0.0225


@dataclass(frozen=True)
class Fuselage:
    """Round body: half an ellipsoid, a cylinder, and a tail that narrows and rises."""

    radius: float = 0.075
    bow: float = 0.02  # x at which its box begins; the ellipsoid's tip is at 0
    stern: float = 0.98
    nose: float = 0.22  # the ellipsoid's length
    tail: float = 0.6  # x at which it begins to narrow
    narrowing: float = 0.5  # of the radius, at x = 1
    cone: float = 0.05  # protrusion of the last section's centre

    @property
    def boxes(self) -> tuple[np.ndarray, ...]:
        """Boxes by their lowest and highest coordinates, (2, 3) each."""
        r = self.radius
        return (np.array([[self.bow, -r, -r], [self.stern, r, r]]),)

    def section(self, x: np.ndarray) -> np.ndarray:
        """Return the radius of the section at x (n,), (n,)."""
        ellipse = np.sqrt(np.clip(1 - np.clip(1 - x / self.nose, 0, None) ** 2, 0, None))
        aft = np.clip((x - self.tail) / (1 - self.tail), 0, None)
        return self.radius * ellipse * (1 - self.narrowing * aft**2)

    def map_to_surface(self, points: np.ndarray) -> np.ndarray:
        """Map points (n, 3): squares about the axis become circles, the two ends caps."""
        x, y, z = points.T
        square = np.maximum(np.abs(y), np.abs(z)) / self.radius
        rho, distance = square * self.section(x), np.hypot(y, z)
        stretch = np.divide(rho, distance, out=np.zeros_like(rho), where=distance > 0)
        cap = self.nose * (1 - np.sqrt(np.clip(1 - (rho / self.radius) ** 2, 0, None)))
        x = np.where(np.isclose(x, self.bow), cap, x)
        x = np.where(np.isclose(x, self.stern), x + self.cone * (1 - square**2), x)
        return np.column_stack([x, stretch * y, stretch * z])


@dataclass(frozen=True)
class Wing:
    """Swept, tapered surface on the fuselage: a pair to the sides (axis 1), or one upwards (axis 2)."""

    axis: int
    leading: float  # x of the root's leading edge
    root: float  # chord
    tip: float  # chord
    sweep: float  # distance of the tip's leading edge aft of the root's
    span: float  # from the fuselage's axis to the tip
    thickness: float = 0.13  # half the maximum thickness over the chord
    rise: float = 0.0  # height of the tip above the root
    fuselage: Fuselage = Fuselage()

    edge = 0.8  # thickness of the leading and trailing edge over the maximum
    crest = 0.35  # position of the maximum thickness over the chord
    bulge = 0.1  # rounding of edges and tip over half the thickness

    @property
    def boxes(self) -> tuple[np.ndarray, ...]:
        """Boxes by their lowest and highest coordinates, (2, 3) each."""
        found = []
        for side in (1, -1) if self.axis == 1 else (1,):
            box = np.array([[self.leading, -HALF_BOX, -HALF_BOX], [self.leading + self.root, HALF_BOX, HALF_BOX]])
            box[:, self.axis] = sorted((side * self.fuselage.radius, side * self.span))
            found.append(box)
        return tuple(found)

    def profile(self, c: np.ndarray) -> np.ndarray:
        """Return the thickness over its maximum at fractions c (n,) of the chord, (n,)."""
        fore = self.edge + (1 - self.edge) * np.sqrt(np.clip(1 - (1 - c / self.crest) ** 2, 0, 1))
        aft = 1 - (1 - self.edge) * np.clip((c - self.crest) / (1 - self.crest), 0, 1) ** 1.5
        return np.where(c < self.crest, fore, aft)

    def map_to_surface(self, points: np.ndarray) -> np.ndarray:
        """Map points (n, 3): shear, taper, profile, with the root on the fuselage and rounded edges."""
        out, across = points[:, self.axis], points[:, 3 - self.axis] / HALF_BOX
        c = (points[:, 0] - self.leading) / self.root
        s = np.clip((np.abs(out) - self.fuselage.radius) / (self.span - self.fuselage.radius), 0, 1)
        chord = self.root + (self.tip - self.root) * s
        half = self.thickness * chord * self.profile(c)
        rounding = self.bulge * half * (1 - across**2)
        edge = np.isclose(c, 1) * 1.0 - np.isclose(c, 0)
        x = self.leading + self.sweep * s + c * chord + rounding * edge
        foot = np.sqrt(np.clip(self.fuselage.section(x) ** 2 - (half * across) ** 2, 0, None))
        placed = np.empty_like(points)
        placed[:, 0] = x
        placed[:, self.axis] = np.sign(out) * (foot + s * (self.span - foot) + np.isclose(s, 1) * rounding)
        placed[:, 3 - self.axis] = half * across
        placed[:, 2] += self.rise * s
        return placed


FUSELAGE = Fuselage()
WINGS = Wing(axis=1, leading=0.26, root=0.22, tip=0.14, sweep=0.11, span=0.43, rise=0.066)
TAILPLANE = Wing(axis=1, leading=0.77, root=0.14, tip=0.125, sweep=0.09, span=0.195, thickness=0.17, rise=0.031)
FIN = Wing(axis=2, leading=0.77, root=0.14, tip=0.125, sweep=0.07, span=0.18, thickness=0.19)
PARTS = (FUSELAGE, WINGS, TAILPLANE, FIN)


def map_onto_aeroplane(points: np.ndarray) -> np.ndarray:
    """Map points (n, 3) on the boxes to the aeroplane's surface, (n, 3) float64."""
    placed = points.copy()
    for part in PARTS:
        for low, high in part.boxes:
            here = ((points > low - 1e-9) & (points < high + 1e-9)).all(axis=1)
            placed[here] = part.map_to_surface(points[here])
    placed[:, 2] += 0.03 * np.clip((placed[:, 0] - FUSELAGE.tail) / (1 - FUSELAGE.tail), 0, None) ** 2
    return placed
