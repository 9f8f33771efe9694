"""A mesh divided among the processes, or ranks, of an MPI program; each rank moves the nodes that it owns."""
