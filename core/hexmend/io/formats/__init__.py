"""Mesh formats, a module or package each, which registers them in FORMATS."""
