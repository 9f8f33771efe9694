"""Widgets that edit a value."""
