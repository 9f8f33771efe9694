"""Medit's format, in decimals (.mesh) and binary (.meshb)."""

from hexmend.io.formats.medit import ascii, binary

__all__ = ["ascii", "binary"]
