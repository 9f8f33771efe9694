"""Metrics of solvers' own checks, one a file; each registers itself in METRICS."""
