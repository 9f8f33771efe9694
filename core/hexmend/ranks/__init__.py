"""A mesh divided among the processes, or ranks, of an MPI program, each of which moves the nodes that it owns."""
