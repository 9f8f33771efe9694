"""Widgets of cuts that are dragged in a view."""
