"""Medit's format, in decimals (.mesh) and binary (.meshb)."""

from hexmend.io.formats.medit import sections

__all__ = ["sections"]
