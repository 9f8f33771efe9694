"""Seconds and memory of whole processes against the size of the mesh."""
