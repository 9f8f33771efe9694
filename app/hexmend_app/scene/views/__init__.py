"""Views in a render window."""
