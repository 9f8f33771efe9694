"""Medit's format: as text (.mesh) and in binary (.meshb)."""

from hexmend.io.formats.medit import ascii, binary

__all__ = ["ascii", "binary"]
