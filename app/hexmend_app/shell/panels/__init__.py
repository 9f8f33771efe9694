"""Places of panels."""
