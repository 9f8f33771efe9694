"""Slices of mesh files: some of the cells and nodes, read without the others."""

from hexmend.io.slices.grid_slice import GridSlice, SlicedFile, slice_of
from hexmend.io.slices.open_slices import open_slices

__all__ = ["GridSlice", "SlicedFile", "open_slices", "slice_of"]
