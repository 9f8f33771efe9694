"""Studies: meshes x methods x parameters, each task in a process of its own, on one machine or on a cluster."""
