"""Coordinate systems of Nastran: rectangular, cylindrical and spherical, of three points each (CORD1* and CORD2*)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.io.formats.decks.cards import Cards


class CoordinateSystems:
    """Coordinate systems of a file.

    Attributes
    ----------
    grid_points : set of int
        Numbers of the grid points that define systems.
    """

    def __init__(self) -> None:
        self.grid_points: set[int] = set()
        #: Card, row, and either grid points or the number and points of a system, by number.
        self._definitions: dict[int, tuple[Cards, int, np.ndarray]] = {}
        self._frames: dict[int, tuple[np.ndarray, np.ndarray] | None] = {}  # None while one is being computed

    def add(self, cards: Cards) -> None:
        """Add the systems of CORD1R, CORD1C and CORD1S, two a card, or CORD2R, CORD2C and CORD2S."""
        for at in range(len(cards.lines)):
            if cards.name[4] == "2":
                values = np.append(cards.integers(1, 2)[at], cards.reals(2, 11)[at])
                self._definitions[int(cards.integers(0, 1)[at, 0])] = cards, at, values
                continue
            for first in (0, 4):
                number, *points = cards.integers(first, first + 4)[at].tolist()
                if number:
                    self._definitions[number] = cards, at, np.array(points)
                    self.grid_points.update(points)

    @property
    def numbers(self) -> list[int]:
        """Numbers of all systems but the basic one, 0."""
        return list(self._definitions)

    def to_basic(self, number: int, local: np.ndarray, point_of: Callable[[int], np.ndarray]) -> np.ndarray:
        """Convert coordinates of a system to basic ones, (k, 3); `point_of` gives those of a grid point."""
        if number == 0:
            return local
        origin, axes = self._frame(number, point_of)
        kind, (a, b, c) = self._definitions[number][0].name[5], local.T
        if kind == "R":
            return origin + local @ axes
        first, second = np.deg2rad(b), np.deg2rad(c)
        if kind == "C":  # radius, angle, z
            return origin + np.column_stack([a * np.cos(first), a * np.sin(first), c]) @ axes
        flat = a * np.sin(first)  # radius, angle from z, angle around z
        return origin + np.column_stack([flat * np.cos(second), flat * np.sin(second), a * np.cos(first)]) @ axes

    def from_basic(self, number: int, points: np.ndarray, point_of: Callable[[int], np.ndarray]) -> np.ndarray:
        """Convert basic coordinates to those of a system, (k, 3); the inverse of `to_basic`."""
        if number == 0:
            return points
        origin, axes = self._frame(number, point_of)
        kind, local = self._definitions[number][0].name[5], (points - origin) @ axes.T
        x, y, z = local.T
        if kind == "R":
            return local
        around, flat = np.rad2deg(np.arctan2(y, x)), np.hypot(x, y)
        if kind == "C":
            return np.column_stack([flat, around, z])
        return np.column_stack([np.hypot(flat, z), np.rad2deg(np.arctan2(flat, z)), around])

    def _frame(self, number: int, point_of: Callable[[int], np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
        """Origin (3,) and unit vectors (3, 3), a row each, of a system in basic coordinates."""
        cards, at, values = self._definitions[number]
        if number in self._frames:
            known = self._frames[number]
            if known is None:
                raise cards.error(at, "refers to itself by its coordinate system or grid points")
            return known
        self._frames[number] = None
        if cards.name[4] == "1":
            points = np.array([point_of(one) for one in values.tolist()])
        else:
            reference, points = int(values[0]), values[1:].reshape(3, 3)
            if reference and reference not in self._definitions:
                raise cards.error(at, f"refers to the coordinate system {reference}, which the file does not have")
            points = self.to_basic(reference, points, point_of)
        origin, on_z, in_xz = points
        z = on_z - origin
        y = np.cross(z, in_xz - origin)
        if not (np.linalg.norm(z) > 0 and np.linalg.norm(y) > 0):
            raise cards.error(at, "has three points on one line: expected an origin, a point on z and one next to z")
        z, y = z / np.linalg.norm(z), y / np.linalg.norm(y)
        frame = self._frames[number] = origin, np.array([np.cross(y, z), y, z])
        return frame
