"""Maximise the least scaled Jacobian of a mesh by sequential linear programming."""
