"""Padding: a layer of hexes under the boundary, a set, or around hexes that no movement of nodes can mend."""

from hexmend.padding.inserted_layer import Sheet
from hexmend.padding.padded_mesh import padded_mesh
from hexmend.padding.padding import AROUND, Padding, pad
from hexmend.padding.regions import around_sheet, region_sheet, set_sheet, whole_sheet

__all__ = [
    "AROUND",
    "Padding",
    "Sheet",
    "around_sheet",
    "pad",
    "padded_mesh",
    "region_sheet",
    "set_sheet",
    "whole_sheet",
]
