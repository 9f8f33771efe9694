"""Padding: a layer of hexes under the boundary, a set, or around hexes that no movement of nodes can mend."""

from hexmend.padding.padding import Padding, pad, padded_mesh
from hexmend.padding.regions import around_sheet, whole_sheet

__all__ = ["Padding", "around_sheet", "pad", "padded_mesh", "whole_sheet"]
