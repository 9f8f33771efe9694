"""Meshes that ranks read and write in parts, so that no rank ever holds the whole."""
