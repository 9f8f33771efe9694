"""Start of the optimum of shape from that of a coarser mesh."""
