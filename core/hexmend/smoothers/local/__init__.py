"""Local methods: the energy around one node, or around a patch of nodes, is minimised at a time."""
