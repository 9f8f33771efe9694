"""Replacement of the coordinates in a mesh file as it was given: everything else stays as it is, byte for byte."""
