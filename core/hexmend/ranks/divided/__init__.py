"""Meshes of which every rank reads and writes a part, so that none ever holds the whole."""
