"""Locked hexes."""
