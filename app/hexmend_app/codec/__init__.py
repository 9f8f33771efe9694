"""Conversion of typed values to plain data and back."""
