"""Geometry that layers draw."""
