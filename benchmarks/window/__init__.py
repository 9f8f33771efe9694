"""Speed of the window."""
