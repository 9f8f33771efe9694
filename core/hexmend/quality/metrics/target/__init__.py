"""Metrics of hexes against the target of their mesh."""
