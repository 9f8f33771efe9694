"""Colours of hexes."""
