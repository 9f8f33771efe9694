"""Floors of the scaled Jacobians, of q(H) and of heights, with the highest one as an eliminated unknown."""
