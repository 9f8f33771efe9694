"""Colour maps; all modules are imported, and register their maps in `COLOUR_MAPS`."""
