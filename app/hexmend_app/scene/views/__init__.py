"""Views of a render window."""
