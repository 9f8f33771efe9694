"""Barriers that join an energy: of floors, of heights, of validity inside hexes, and of a fit to a surface."""
