"""Measurements of Hexmend: speed, memory, the thesis's experiments, other programs. Run by `python -m benchmarks`."""
