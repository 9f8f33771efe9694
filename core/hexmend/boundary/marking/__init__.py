"""Curves that are marked by hand: chains of boundary edges that stay features whatever their angle."""

from hexmend.boundary.marking.edge_path import edge_path
from hexmend.boundary.marking.marks import curve_through, marked_segments, with_curve, without_curves

__all__ = ["curve_through", "edge_path", "marked_segments", "with_curve", "without_curves"]
