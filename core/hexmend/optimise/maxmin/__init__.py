"""Maximise the minimum scaled Jacobian of a mesh by sequential linear programming."""
