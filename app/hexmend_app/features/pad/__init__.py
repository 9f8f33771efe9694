"""Padding: a layer of hexes under the boundary."""
