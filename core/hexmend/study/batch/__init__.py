"""Studies: meshes x methods x parameters, each task in its own process, on one machine or on a cluster."""
