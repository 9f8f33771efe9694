"""Colour maps; every module here is imported, and registers what it defines in `COLOUR_MAPS`."""
