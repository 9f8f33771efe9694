"""Feature edges and corners of a surface."""
