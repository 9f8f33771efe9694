"""Stages of mend on a boundary that slides: which start is raised, and how nodes leave the surface and return to it."""
