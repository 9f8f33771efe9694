"""Hexmend: quality, smoothing and untangling of hexahedral meshes."""

__version__ = "0.1.0"
