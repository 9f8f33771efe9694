"""View settings of the window."""
