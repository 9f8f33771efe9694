"""Nested iteration: the optimum of a coarser mesh as the start of the optimum of shape."""
