"""Pictures of meshes for notebooks, registered in the entry-point group `hexmend.pictures`."""
