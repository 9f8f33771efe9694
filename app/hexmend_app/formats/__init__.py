"""Formats that need VTK; they join the core through the entry-point group `hexmend.formats`."""
